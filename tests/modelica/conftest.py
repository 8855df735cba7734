"""The compilers with which the library's models are simulated."""

from __future__ import annotations

import pytest

from tests.modelica.library import RumocaSimulate, Simulate
from tests.modelica.openmodelica import OpenModelicaSimulate


@pytest.fixture(params=["rumoca", "openmodelica"])
def simulate(request: pytest.FixtureRequest) -> Simulate:
    """Each of the compilers in turn."""
    if request.param == "rumoca":
        return RumocaSimulate()
    return OpenModelicaSimulate(request.getfixturevalue("omc"))
