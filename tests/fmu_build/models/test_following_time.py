"""Events that depend only on time or an input are found while states rest, whatever the step sizes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu

from tests.shared_fmus import SharedFmus

from .case import Array, Case, Values
from .oracles.discrete import MEAN_FROM_START, mean_from_start
from .oracles.time_events import pulse_case, pulses
from .runner import FmuOf

HALF_WIDTH = 0.05 * np.sqrt(np.log(2))


def pulse(t: Array) -> Values:
    on = np.abs(t - 50) < HALF_WIDTH
    v = np.clip(t - 50 + HALF_WIDTH, 0, 2 * HALF_WIDTH)
    return {"f": np.exp(-(((t - 50) / 0.05) ** 2)), "on": on, "v": v}


PULSE = Case("TimeEvents.Pulse", 100.0, pulse)
PULSE_TRAIN = pulse_case(0.3, -1.0, "default")
INPUT_PULSE = Case("TimeEvents.InputPulse", 100.0, pulse, inputs={"u": lambda t: t})


def check(result: Any) -> None:
    """The length of the pulse, and at every point what belongs together."""
    expected = pulse(np.asarray(result["time"]))
    np.testing.assert_allclose(result["v"], expected["v"], atol=1e-9)
    np.testing.assert_allclose(result["f"], expected["f"], atol=1e-9)
    np.testing.assert_array_equal(np.asarray(result["on"]) != 0, np.asarray(result["f"]) > 0.5)


@pytest.mark.parametrize("stop_is_known", [True, False])
@pytest.mark.parametrize("step", [1e-3, 1e-2, 0.1, 1.0, 7.0, 100.0])
@pytest.mark.parametrize("case", [PULSE], ids=["time"])
def test_no_step_passes_over_the_pulse(case: Case, step: float, stop_is_known: bool, fmu_of: FmuOf) -> None:
    check(fmu_of(case).run(case, "CoSimulation", step, set_stop_time=stop_is_known))


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("start", [-3.21, 0.55, 7.8])
def test_start_values_follow_the_time_of_the_start(start: float, kind: str, fmu_of: FmuOf) -> None:
    case = replace(PULSE_TRAIN, stop_time=start + 2.0, parameters={"period": 0.3, "origin": -20.0})
    result = fmu_of(case).run(case, kind, 2.0 / 97, start_time=start)
    times = np.asarray(result["time"])
    away = np.abs((times[:, None] + 20.0) % 0.3 - [0.0, 0.12, 0.3]).min(axis=1) > 1e-4
    assert away.sum() > 90
    for name, expected in pulses(times[away], 0.3, -20.0, start).items():
        # CVode's error adds up over the run, as elsewhere in these tests.
        accuracy = 1e-7 if kind == "CoSimulation" else 1e-5
        np.testing.assert_allclose(result[name][away], expected, atol=accuracy, err_msg=name)


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("start", [-3.21, 0.55, 7.8])
def test_samples_count_from_the_time_of_the_start(start: float, kind: str, fmu_of: FmuOf) -> None:
    case = replace(MEAN_FROM_START, stop_time=start + 2.2)
    result = fmu_of(case).run(case, kind, 2.2 / 97, start_time=start)
    times = np.asarray(result["time"])
    away = np.abs((times - start + 0.25) % 0.5 - 0.25) > 1e-4
    assert away.sum() > 90
    for name, expected in mean_from_start(times[away], start).items():
        accuracy = 1e-7 if kind == "CoSimulation" else 1e-5  # as above
        np.testing.assert_allclose(result[name][away], expected, atol=accuracy, err_msg=name)


@pytest.mark.parametrize("steps", [1, 13, 997])
@pytest.mark.parametrize("case", [INPUT_PULSE], ids=["input"])
def test_an_input_on_its_way_is_followed(case: Case, steps: int, fmu_of: FmuOf) -> None:
    check(fmu_of(case).run_with_inputs(case, steps))


@pytest.mark.parametrize("early_return", [True, False])
@pytest.mark.parametrize("step", [1e-2, 1.0, 100.0])
def test_fmi_3(early_return: bool, step: float, pulse_3: Path) -> None:
    result = simulate_fmu(
        pulse_3,
        fmi_type="CoSimulation",
        stop_time=100.0,
        output_interval=step,
        output=["f", "on", "v"],
        early_return_allowed=early_return,
        use_event_mode=early_return,
        relative_tolerance=1e-8,
    )
    if not early_return:
        check(result)
    assert result["v"][-1] == pytest.approx(2 * HALF_WIDTH, abs=1e-9)


@pytest.fixture(scope="module")
def pulse_3(shared_fmus: SharedFmus) -> Path:
    """The FMU of FMI 3."""
    return shared_fmus.fmu(PULSE.model, PULSE.library, fmi_version="3.0")
