"""Finding an FMU by name or path."""

from __future__ import annotations

import re
import runpy
import subprocess
import sys
from importlib import resources
from pathlib import Path

import pytest

from pyjoystick.fmu import MODELS, SENSITIVITIES, FmuNotFoundError, build_folder, files, find_fmu


@pytest.fixture
def packed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the FMUs that an installed package carries, empty at first."""
    folder = tmp_path / "package" / "fmus"
    folder.mkdir(parents=True)
    monkeypatch.setattr(resources, "files", lambda package: folder.parent)
    return folder


@pytest.fixture
def built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder that ``make fmu`` writes to, empty at first."""
    folder = tmp_path / "build" / "fmi2"
    folder.mkdir(parents=True)
    monkeypatch.setattr(files, "build_folder", lambda: folder)
    return folder


def test_a_name_is_looked_up_in_the_package_before_the_checkout(packed: Path, built: Path) -> None:
    (built / "Joystick.fmu").touch()
    assert find_fmu("Joystick") == built / "Joystick.fmu"
    (packed / "Joystick.fmu").touch()
    assert find_fmu("Joystick") == packed / "Joystick.fmu"


def test_a_missing_name_says_how_to_build_it(packed: Path, built: Path) -> None:
    with pytest.raises(FmuNotFoundError) as caught:
        find_fmu("JoystickInverse")
    assert "there is no FMU JoystickInverse" in str(caught.value)
    assert "`make fmu`" in str(caught.value)
    assert f"python -m fmu_build PreloadedSprings.Joystick.JoystickInverse --output {built}" in str(
        caught.value
    )


def test_without_a_checkout_make_is_not_proposed(packed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "build_folder", lambda: None)
    with pytest.raises(FmuNotFoundError, match=r"python -m fmu_build .* and give its path") as caught:
        find_fmu("Joystick")
    assert "make" not in str(caught.value)


def test_any_path_will_do(tmp_path: Path) -> None:
    path = tmp_path / "My own.fmu"
    path.touch()
    assert find_fmu(path) == path
    assert find_fmu(str(path)) == path


def test_a_missing_file_or_a_folder_is_told_by_path(tmp_path: Path) -> None:
    with pytest.raises(FmuNotFoundError, match=r"no FMU .*nowhere\.fmu; the file does not exist; .*Joystick"):
        find_fmu(tmp_path / "nowhere.fmu")
    with pytest.raises(FmuNotFoundError, match="it is a folder"):
        find_fmu(tmp_path)


def test_this_checkout_is_recognized() -> None:
    folder = build_folder()
    assert folder is not None
    assert folder == Path(__file__).parents[3] / "build" / "fmi2"


@pytest.mark.parametrize("file", ["Makefile", "hatch_build.py"])
def test_make_and_the_wheel_build_what_has_a_name(file: str) -> None:
    text = (Path(__file__).parents[3] / file).read_text(encoding="utf-8")
    built = re.findall(r"\b(?:Joystick|Operator|Examples)\.[A-Z]\w+", text)
    assert [f"PreloadedSprings.{model}" for model in built] == list(MODELS.values())


def test_make_and_the_wheel_ask_for_the_same_sensitivities() -> None:
    """By the file that needs none of this package's dependencies, which -I and -S leave out."""
    root = Path(__file__).parents[3]
    script = "pyjoystick/fmu/shipped.py"
    assert f"SENSITIVE := {script}" in (root / "Makefile").read_text(encoding="utf-8")
    command = [sys.executable, "-I", "-S", str(root / script)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    assert dict(line.split("=") for line in printed) == dict(SENSITIVITIES)
    assert runpy.run_path(str(root / "hatch_build.py"))["SENSITIVITIES"] == SENSITIVITIES
