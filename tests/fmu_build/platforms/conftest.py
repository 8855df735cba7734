"""The joystick's FMU for all platforms."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import FmiVersion, build_fmu

MODEL = "PreloadedSprings.Joystick.Joystick"


@pytest.fixture(scope="session", params=["2.0", "3.0"])
def fmi_version(request: pytest.FixtureRequest) -> FmiVersion:
    """Every version of FMI that can be built."""
    version: FmiVersion = request.param
    return version


@pytest.fixture(scope="session")
def fmu(fmi_version: FmiVersion, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU with binaries for all platforms; tests only read it."""
    folder = tmp_path_factory.mktemp(f"fmi{fmi_version}")
    return build_fmu(MODEL, folder, fmi_version=fmi_version, platforms=["all"]).path
