"""The FMUs of the models in this folder."""

from __future__ import annotations

import pytest
from fmpy import read_model_description

from tests.shared_fmus import SharedFmus

from .case import Case
from .runner import Fmu, FmuOf


@pytest.fixture(scope="session")
def fmu_of(shared_fmus: SharedFmus) -> FmuOf:
    """The FMU of a case's model; raises what its build raises."""

    def fmu(case: Case) -> Fmu:
        folder = shared_fmus.unpacked(case.model, case.library)
        return Fmu(folder, read_model_description(folder))

    return fmu
