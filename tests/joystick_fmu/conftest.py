"""Run the tests of this folder on the FMUs of both FMI versions."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture(scope="session", params=["joystick_fmus", "joystick_fmus3"], ids=["FMI 2", "FMI 3"])
def fmus(request: pytest.FixtureRequest) -> Path:
    """The folder with the FMUs of this project."""
    folder: Path = request.getfixturevalue(request.param)
    return folder
