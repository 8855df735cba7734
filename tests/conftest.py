"""Fixtures that all tests share."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import fmpy
import pytest

from fmu_build import FmiVersion
from pyjoystick.fmu import MODELS
from tests.omc import Omc, opened, why_not
from tests.shared_fmus import SharedFmus

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="session")
def shared_fmus(tmp_path_factory: pytest.TempPathFactory) -> SharedFmus:
    """FMUs that are built once, also where several processes share the tests."""
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent
    folder /= "shared_fmus"
    folder.mkdir(exist_ok=True)
    return SharedFmus(folder)


@pytest.fixture(scope="session")
def joystick_fmus(shared_fmus: SharedFmus) -> Path:
    """The folder with the FMUs of this project by the default compiler.

    Those of ``make fmu`` where they are up to date and not another compiler's, else new ones.
    """
    return _made_or_new("2.0", shared_fmus)


@pytest.fixture(scope="session")
def joystick_fmus3(shared_fmus: SharedFmus) -> Path:
    """The same of FMI 3."""
    return _made_or_new("3.0", shared_fmus)


def _made_or_new(fmi_version: FmiVersion, shared_fmus: SharedFmus) -> Path:
    made = ROOT / "build" / f"fmi{fmi_version[0]}"
    if _is_up_to_date(made):
        return made
    (folder,) = {shared_fmus.fmu(model, fmi_version=fmi_version).parent for model in MODELS.values()}
    return folder


def _is_up_to_date(folder: Path) -> bool:
    fmus = [folder / f"{name}.fmu" for name in MODELS]
    if not all(fmu.is_file() for fmu in fmus):
        return False
    if not all(_tool(fmu).startswith("pyjoystick") for fmu in fmus):
        return False
    oldest = min(fmu.stat().st_mtime for fmu in fmus)
    return all(source.stat().st_mtime <= oldest for source in _sources())


def _tool(fmu: Path) -> str:
    return str(fmpy.read_model_description(str(fmu), validate=False).generationTool)


def _sources() -> Iterator[Path]:
    for folder in ("fmu_build", "modelica"):
        for file in (ROOT / folder).rglob("*"):
            if file.is_file() and file.suffix != ".pyc":
                yield file


@pytest.fixture(scope="session")
def omc(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Omc]:
    """An OpenModelica session, for root in the script form; skips where none is installed."""
    reason = why_not()
    if reason:
        pytest.skip(reason)
    with opened(tmp_path_factory.mktemp("omc")) as session:
        yield session


@pytest.fixture
def fmus_by_name(joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Has ``Joystick`` and the other names mean the FMUs of `joystick_fmus`."""
    for module in ("pyjoystick.fmu.files", "pyjoystick.fmu"):
        monkeypatch.setattr(f"{module}.build_folder", lambda: joystick_fmus)
    return joystick_fmus
