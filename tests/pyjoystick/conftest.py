"""FMUs that the tests of several parts run."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import build_fmu


@pytest.fixture(scope="session")
def mixed_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU with parameters and outputs of several types, and runs that may fail; see fmu/Mixed.mo."""
    folder = tmp_path_factory.mktemp("mixed")
    return build_fmu("Mixed", folder, library=Path(__file__).parent / "fmu" / "Mixed.mo").path


@pytest.fixture(scope="session")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with First.fmu, Second.fmu, Stops.fmu and Closed.fmu, see runs/fmu_comparison/Pair.mo."""
    folder = tmp_path_factory.mktemp("pair")
    for name in ("First", "Second", "Stops", "Closed"):
        build_fmu(
            f"Pair.{name}", folder, library=Path(__file__).parent / "runs" / "fmu_comparison" / "Pair.mo"
        )
    return folder
