"""A missing FMU is built if possible."""

from __future__ import annotations

from pathlib import Path

import pytest

import fmu_build
from pyjoystick.cli import fmus
from tests.pyjoystick.cli.conftest import Command


@pytest.fixture
def empty_build_folder(command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A checkout in which nothing has been built; overrides what `command` has set."""
    folder = tmp_path / "build" / "fmi2"
    for module in ("pyjoystick.fmu.files", "pyjoystick.fmu"):
        monkeypatch.setattr(f"{module}.build_folder", lambda: folder)
    return folder


def test_a_missing_fmu_is_built_once(command: Command, empty_build_folder: Path) -> None:
    outcome = command("free-oscillation", "-d", "0.1")
    assert outcome.code == 0
    assert outcome.out.startswith("Joystick.fmu: free oscillation")
    assert [path.name for path in empty_build_folder.iterdir()] == ["Joystick.fmu"]
    (line,) = outcome.err.splitlines()
    assert line.startswith(f"built {empty_build_folder / 'Joystick.fmu'} in ")
    assert line.endswith(", as it was missing")
    assert command("free-oscillation", "-d", "0.1").err == ""


def test_without_the_tools_the_advice_is_given(
    command: Command, empty_build_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fmus, "find_spec", lambda name: None if name == "ziglang" else object())
    outcome = command("compare")
    assert (outcome.code, outcome.out) == (1, "")
    assert "build it with `make fmu` or `python -m fmu_build" in outcome.message
    assert not empty_build_folder.exists()


def test_a_build_that_fails_says_why(
    command: Command, empty_build_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise fmu_build.ToolchainError("no space left")

    monkeypatch.setattr(fmu_build, "build_fmu", fails)
    outcome = command("info", "Joystick")
    assert outcome.code == 1
    expected = "the FMU of PreloadedSprings.Joystick.Joystick could not be built: no space left"
    assert outcome.message == expected
