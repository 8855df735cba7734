"""The wheel: one for all platforms, complete, reproducible, and usable without a compiler."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hatchling.build import build_wheel

import fmu_build
from pyjoystick.fmu import MODELS, SENSITIVITIES, read_description

ROOT = Path(__file__).parents[1]
PLATFORMS = {"aarch64-darwin", "aarch64-linux", "darwin64", "linux64", "win64"}
LARGEST = 12e6  # bytes
FMUS = (*(f"{name}.fmu" for name in MODELS), *(f"sensitivities/{name}.fmu" for name in SENSITIVITIES))
#: Those that a second build makes anew for all platforms and WebAssembly: one of each kind.
ANEW = ("JoystickInversePowerLaw.fmu", "sensitivities/JoystickPowerLaw.fmu")
#: What only builds need.
COMPILERS = ("rumoca", "ziglang")

# Each file is built once, by one process.
pytestmark = pytest.mark.xdist_group("wheel")


def _hatch(folder: Path, target: str, output: Path) -> Path:
    """Build a distribution with the tools of this environment, as a front end without isolation does."""
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "--target", target, "--directory", str(output)],
        cwd=folder,
        check=True,
        capture_output=True,
    )
    (path,) = output.iterdir()
    return path


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _hatch(ROOT, "sdist", tmp_path_factory.mktemp("sdist"))


@pytest.fixture(scope="module")
def wheel(sdist: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built from the source distribution, as package indexes and distributions do."""
    sources = tmp_path_factory.mktemp("sources")
    with tarfile.open(sdist) as archive:
        archive.extractall(sources, filter="data")
    (folder,) = sources.iterdir()
    return _hatch(folder, "wheel", tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of an environment with the wheel and what it depends on, which is that of the tests."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, symlinks=os.name != "nt")
    (site,) = folder.glob("lib/python*/site-packages")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    dependencies = site / "dependencies"
    dependencies.mkdir()
    for path in Path(np.__file__).parents[1].iterdir():
        if not path.name.startswith(("pyjoystick", *COMPILERS)) and path.suffix != ".pth":
            (dependencies / path.name).symlink_to(path)
    (site / "dependencies.pth").write_text(str(dependencies), encoding="utf-8")
    return folder / "bin" / "python"


def _run(python: Path, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(python), "-I", "-m", "pyjoystick", *arguments],
        cwd=folder,
        env=os.environ | {"COLUMNS": "100"},
        capture_output=True,
        text=True,
        check=False,
    )


def test_one_small_file_serves_all_platforms(wheel: Path) -> None:
    assert wheel.name.endswith("-py3-none-any.whl")
    size = wheel.stat().st_size
    assert size <= LARGEST
    for page in ("README.md", "docs/index.md", "docs/install.md"):
        assert f"same {size / 1e6:.0f} MB wheel" in (ROOT / page).read_text(), page


@pytest.mark.parametrize(
    "check",
    [
        ("twine", "check", "--strict"),
        # Same files are meant: licences, and the inputs of the default runs; and there are two packages.
        ("check_wheel_contents", "--ignore=W002,W009"),
    ],
)
def test_tools_find_nothing_wrong(check: tuple[str, ...], sdist: Path, wheel: Path) -> None:
    files = [str(wheel), *([str(sdist)] if check[0] == "twine" else [])]
    done = subprocess.run([sys.executable, "-m", *check, *files], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_wheel_has_the_files_of_the_checkout(wheel: Path) -> None:
    expected = {
        path.relative_to(ROOT).as_posix()
        for package in ("pyjoystick", "fmu_build")
        for path in (ROOT / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    expected |= {
        f"fmu_build/{path.relative_to(ROOT).as_posix()}"
        for path in (ROOT / "modelica").rglob("*")
        if path.is_file()
    }
    expected |= {f"pyjoystick/fmus/{name}" for name in FMUS}
    with zipfile.ZipFile(wheel) as archive:
        found = {name for name in archive.namelist() if ".dist-info/" not in name}
    assert found == expected


def test_two_builds_in_two_folders_give_the_same_bytes(
    wheel: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second, in the checkout, builds the FMUs of `ANEW` and takes the others from the first."""
    built = []

    def build_or_take(model: str, output: Path, **settings: Any) -> Any:
        name = f"{model.rpartition('.')[2]}.fmu"
        place = f"sensitivities/{name}" if settings["sensitivity"] else name
        if place in ANEW:
            built.append(place)
            return build_fmu(model, output, **settings)
        output.mkdir(exist_ok=True)
        (output / name).write_bytes(archive.read(f"pyjoystick/fmus/{place}"))
        return SimpleNamespace(path=output / name)

    build_fmu = fmu_build.build_fmu
    monkeypatch.setattr(fmu_build, "build_fmu", build_or_take)
    monkeypatch.setattr(sys, "path", [*sys.path])  # the build hook adds to it
    monkeypatch.chdir(ROOT)
    with zipfile.ZipFile(wheel) as archive:
        again = tmp_path / build_wheel(str(tmp_path))
    assert sorted(built) == sorted(ANEW)
    assert again.name == wheel.name
    assert again.read_bytes() == wheel.read_bytes()


@pytest.mark.parametrize("name", FMUS)
def test_the_fmus_are_those_of_make_fmu_with_more_platforms(
    name: str, wheel: Path, joystick_fmus: Path
) -> None:
    """Another process has built these, in another folder; only the list of licences differs."""
    with zipfile.ZipFile(wheel) as archive:
        packed = io.BytesIO(archive.read(f"pyjoystick/fmus/{name}"))
    with zipfile.ZipFile(packed) as found, zipfile.ZipFile(joystick_fmus / name) as expected:
        files = set(expected.namelist()) - {"documentation/licenses/license.txt"}
        assert any(file.startswith("binaries/") for file in files)
        assert [file for file in files if found.read(file) != expected.read(file)] == []


def test_every_fmu_has_all_platforms_and_a_module(wheel: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        for name in MODELS:
            path = Path(archive.extract(f"pyjoystick/fmus/{name}.fmu", tmp_path))
            assert set(read_description(path).platforms) == PLATFORMS
            with zipfile.ZipFile(path) as fmu:
                assert f"extra/org.pyjoystick/wasm32/{name}.wasm" in fmu.namelist()


def test_an_installed_wheel_runs_without_compiler_and_checkout(installed: Path, tmp_path: Path) -> None:
    done = _run(installed, tmp_path, "free-oscillation", "--plot", "run.png")
    assert done.returncode == 0, done.stderr
    assert "Joystick.fmu: free oscillation from -20 deg" in done.stdout
    assert (tmp_path / "run.png").is_file()
    done = _run(installed, tmp_path, "info", "Joystick")
    assert str(installed.parents[1].name) in done.stdout
    done = _run(installed, tmp_path, "fmu", "Joystick", "-o", "fmus")
    assert done.returncode == 0, done.stderr
    assert set(read_description(tmp_path / "fmus" / "Joystick.fmu").platforms) == PLATFORMS


def test_an_installed_wheel_writes_live_pages(installed: Path, tmp_path: Path) -> None:
    done = _run(installed, tmp_path, "explore", "-o", "joystick.html")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "joystick.html").stat().st_size > 1e5


def test_building_from_an_installed_wheel_says_what_is_missing(installed: Path, tmp_path: Path) -> None:
    done = _run(installed, tmp_path, "export", "-o", "fmus")
    assert done.returncode == 1
    assert "pip install 'pyjoystick[build]'" in done.stderr
