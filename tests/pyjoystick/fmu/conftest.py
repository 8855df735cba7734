"""FMUs for the tests of how FMUs are run."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from fmu_build import build_fmu
from pyjoystick.fmu import Fmu


@pytest.fixture(scope="session")
def joystick_path(joystick_fmus: Path) -> Path:
    """The FMU with constant damping."""
    return joystick_fmus / "Joystick.fmu"


@pytest.fixture(scope="session")
def mixed_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU with parameters and outputs of several types, see Mixed.mo."""
    folder = tmp_path_factory.mktemp("mixed")
    return build_fmu("Mixed", folder, library=Path(__file__).with_name("Mixed.mo")).path


@pytest.fixture
def joystick(joystick_path: Path) -> Iterator[Fmu]:
    with Fmu(joystick_path) as fmu:
        yield fmu


@pytest.fixture
def mixed(mixed_path: Path) -> Iterator[Fmu]:
    with Fmu(mixed_path) as fmu:
        yield fmu


@pytest.fixture
def unpacking_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder that FMUs are unpacked into, empty at first."""
    folder = tmp_path / "unpacked"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder
