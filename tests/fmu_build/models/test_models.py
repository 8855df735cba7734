"""Small models that are not joysticks: the FMU of each against a closed form or SciPy."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from .case import Case, largest_difference
from .oracles import CASES
from .runner import FmuOf, event_times

COMMUNICATION_STEPS = {"97 steps": 97, "13 steps": 13}


@pytest.mark.parametrize("steps", COMMUNICATION_STEPS.values(), ids=COMMUNICATION_STEPS.keys())
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_co_simulation(case: Case, steps: int, fmu_of: FmuOf) -> None:
    fmu = fmu_of(case)
    if case.inputs:
        result = fmu.run_with_inputs(case, steps)
    else:
        result = fmu.run(case, "CoSimulation", case.stop_time / steps)
    assert result["time"][-1] == pytest.approx(case.stop_time)
    difference, where = largest_difference(result["time"], result, case, case.margin)
    assert difference <= case.accuracy, where


@pytest.mark.parametrize("case", [case for case in CASES if not case.inputs], ids=lambda case: case.name)
def test_model_exchange(case: Case, fmu_of: FmuOf) -> None:
    result = fmu_of(case).run(case, "ModelExchange", case.stop_time / 97)
    assert result["time"][-1] == pytest.approx(case.stop_time)
    margin = 10 * case.me_accuracy
    difference, where = largest_difference(result["time"], result, case, margin)
    assert difference <= case.me_accuracy, where
    expected, found = case.events(case.stop_time), event_times(result)
    missed = [
        time
        for time in expected[(expected > 0) & (expected < case.stop_time - margin)]
        if np.abs(found - time).min(initial=np.inf) > margin
    ]
    assert not missed, f"{case.name}: no event at {missed}"


@pytest.mark.parametrize("case", [case for case in CASES if case.model == "StateEvents.Grazing"])
@pytest.mark.parametrize("level", [0.999, 0.9999, 0.99999])
def test_a_short_excursion_is_not_missed(case: Case, level: float, fmu_of: FmuOf) -> None:
    """The sine is above the level for as little as 9 ms, far less than a step of the integrator takes."""
    fmu = fmu_of(case)
    result = fmu.run(replace(case, parameters={"level": level}), "CoSimulation", case.stop_time / 3)
    assert list(result["hits"]) == [0, 1, 2, 3]


@pytest.mark.parametrize("case", [case for case in CASES if case.model == "TimeEvents.Neighbours"])
def test_an_event_a_rounding_error_after_another_at_a_communication_point(case: Case, fmu_of: FmuOf) -> None:
    """The step between the two, the shortest that there is, does not set the size of the next."""
    result = fmu_of(case).run(case, "CoSimulation", case.stop_time / 50)
    difference, where = largest_difference(result["time"], result, case, case.margin)
    assert difference <= case.accuracy, where


def test_there_are_many_models() -> None:
    """The claim of generality is worth what it was tried on."""
    assert len({case.model for case in CASES}) >= 50
    assert {path.stem for path in Path(__file__).parent.glob("*.mo")} == {
        case.model.partition(".")[0] for case in CASES
    }
