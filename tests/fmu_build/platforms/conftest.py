"""The joystick's FMU for all platforms."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import FmiVersion
from tests.shared_fmus import SharedFmus

MODEL = "PreloadedSprings.Joystick.Joystick"


@pytest.fixture(scope="session", params=["2.0", "3.0"])
def fmi_version(request: pytest.FixtureRequest) -> FmiVersion:
    """Every version of FMI that can be built."""
    version: FmiVersion = request.param
    return version


@pytest.fixture(scope="session")
def fmu(fmi_version: FmiVersion, shared_fmus: SharedFmus) -> Path:
    """The FMU with binaries for all platforms; tests only read it."""
    return shared_fmus.fmu(MODEL, fmi_version=fmi_version, platforms=("all",), as_shipped=True)
