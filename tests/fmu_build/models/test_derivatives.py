"""Directional derivatives of every model, against central differences of its FMU."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from .case import Array, Case
from .differences import Differences, initial_differences, may_be_moved, probe
from .oracles import CASES
from .runner import Fmu, FmuOf

TOLERANCE = 1e-6
# Some models start where the second derivative of an energy jumps: differences are off by their step there.
TOLERANCE_AT_START = 1e-5
_MODELS = {case.model: case for case in CASES}
# Where when-clauses act at the start, or discrete variables start from parameters: no derivatives there.
_ACT_AT_START = {
    "Sampling.Guarded",
    "Sampling.HeldSine",
    "Sampling.InitialPrevious",
    "Sampling.LeftLimits",
    "Sampling.MeanFromStart",
    "Sampling.PulseTrain",
    "Sampling.SampleOrState",
    "Sampling.SampledPI",
    "Sampling.SampledReset",
    "TimeEvents.InitialWhen",
    "TimeEvents.PulseTrain",
}


def _real(fmu: Fmu) -> list[Any]:
    return [variable for variable in fmu.description.modelVariables if variable.type == "Real"]


def _unknowns(fmu: Fmu) -> list[Any]:
    computed = ("output", "local", "calculatedParameter")
    return [v for v in _real(fmu) if v.causality in computed and v.variability != "constant"]


def _check(
    found: Array, expected: Differences, unknowns: list[Any], knowns: list[Any], tolerance: float = TOLERANCE
) -> None:
    if not found.size:
        return
    assert np.mean(expected.smooth) >= 0.5, "too few derivatives to compare"
    error, row, column = expected.largest_error(found)
    place = f"d {unknowns[row].name} / d {knowns[column].name}"
    assert error <= tolerance, (
        f"{place}: {found[row, column]!r}, differences {expected.central[row, column]!r}"
    )


def _values(case: Case) -> dict[str, float]:
    inputs = {name: float(signal(np.zeros(1))[0]) for name, signal in case.inputs.items()}
    return {**case.parameters, **inputs}


@pytest.mark.parametrize("case", _MODELS.values(), ids=lambda case: case.model)
def test_derivatives_are_those_of_the_branch(case: Case, fmu_of: FmuOf) -> None:
    _check_during_the_run(case, 0.31, fmu_of(case))


@pytest.mark.parametrize("part", [0.07, 0.83])
@pytest.mark.parametrize("case", _MODELS.values(), ids=lambda case: case.model)
def test_so_are_those_of_other_times(case: Case, part: float, fmu_of: FmuOf) -> None:
    _check_during_the_run(case, part, fmu_of(case))


def _check_during_the_run(case: Case, part: float, fmu: Fmu) -> None:
    assert fmu.description.modelExchange.providesDirectionalDerivative
    with probe(fmu) as point:
        point.set(_values(case))
        point.model.exitInitializationMode()
        point.advance(part * case.stop_time, steps=200)
        unknowns = _unknowns(fmu)
        knowns = [
            variable
            for variable in _real(fmu)
            if variable in point.states
            or variable.causality in ("input", "independent")
            or (variable.causality == "parameter" and variable.variability == "tunable")
        ]
        knowns = [known for known in knowns if may_be_moved(known, float(point.read([known])[0]))]
        _check(point.jacobian(unknowns, knowns), point.differences(unknowns, knowns), unknowns, knowns)


@pytest.mark.parametrize("case", _MODELS.values(), ids=lambda case: case.model)
def test_derivatives_of_initial_values(case: Case, fmu_of: FmuOf) -> None:
    fmu = fmu_of(case)
    with probe(fmu) as point:
        point.set(_values(case))
        unknowns = _unknowns(fmu)
        knowns = [
            variable
            for variable in _real(fmu)
            if variable.causality in ("input", "parameter")
            or (variable in point.states and variable.initial == "exact")
        ]
        knowns = [known for known in knowns if may_be_moved(known, float(point.read([known])[0]))]
        if case.model in _ACT_AT_START:
            with pytest.raises(FMICallException, match="fmi2GetDirectionalDerivative"):
                point.jacobian(unknowns, knowns or [_real(fmu)[0]])
            return
        found = point.jacobian(unknowns, knowns)
    expected = initial_differences(fmu, _values(case), unknowns, knowns)
    _check(found, expected, unknowns, knowns, TOLERANCE_AT_START)
