"""FMUs for the tests of running FMUs."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.fmu.stepping.engine import PLAIN_LOOP_VARIABLE
from tests.pyjoystick.fmu import awkward


@pytest.fixture(scope="session")
def joystick_path(joystick_fmus: Path) -> Path:
    """The FMU with constant damping."""
    return joystick_fmus / "Joystick.fmu"


@pytest.fixture(scope="session")
def awkward_library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library of the awkward FMUs of FMI 2.0."""
    return awkward.compile_library(2, tmp_path_factory.mktemp("awkward2"))


@pytest.fixture(scope="session")
def awkward_path(awkward_library: Path) -> Path:
    """The FMU of FMI 2.0 that makes trouble on request."""
    return awkward.build(2, awkward_library.with_name("awkward.fmu"), awkward_library)


@pytest.fixture(scope="session")
def awkward3_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same of FMI 3.0."""
    folder = tmp_path_factory.mktemp("awkward3")
    return awkward.build(3, folder / "awkward3.fmu", awkward.compile_library(3, folder))


@pytest.fixture(params=["compiled", "plain"])
def loop(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Which loop carries out the runs."""
    if request.param == "plain":
        monkeypatch.setenv(PLAIN_LOOP_VARIABLE, "1")
    return str(request.param)


@pytest.fixture
def awkward_fmu(awkward_path: Path) -> Iterator[Fmu]:
    with Fmu(awkward_path, own_process=False) as fmu:
        yield fmu


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


@pytest.fixture
def echo2(echo2_path: Path) -> Iterator[Fmu]:
    with Fmu(echo2_path) as fmu:
        yield fmu


@pytest.fixture
def echo3(echo3_path: Path) -> Iterator[Fmu]:
    with Fmu(echo3_path) as fmu:
        yield fmu
