"""FMUs that tests in several folders run."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.pyjoystick.fmu import echo
from tests.shared_fmus import SharedFmus


@pytest.fixture(scope="session")
def mixed_path(shared_fmus: SharedFmus) -> Path:
    """An FMU with parameters and outputs of several types, and runs that may fail; see fmu/Mixed.mo."""
    return shared_fmus.fmu("Mixed", Path(__file__).parent / "fmu" / "Mixed.mo")


@pytest.fixture(scope="session")
def pair(shared_fmus: SharedFmus) -> Path:
    """The folder with First.fmu, Second.fmu, Stops.fmu and Closed.fmu, see runs/fmu_comparison/Pair.mo."""
    library = Path(__file__).parent / "runs" / "fmu_comparison" / "Pair.mo"
    names = ("First", "Second", "Stops", "Closed")
    (folder,) = {shared_fmus.fmu(f"Pair.{name}", library).parent for name in names}
    return folder


@pytest.fixture(scope="session")
def echo2_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of FMI 2.0 that gives back what it gets."""
    return echo.build(2, tmp_path_factory.mktemp("echo2"))


@pytest.fixture(scope="session")
def echo3_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same of FMI 3.0, with numbers of every type, texts and arrays."""
    return echo.build(3, tmp_path_factory.mktemp("echo3"))
