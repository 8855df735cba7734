"""Stepping an FMU: same results as a run, saved states, and no steps after the end."""

from __future__ import annotations

import gc
import itertools
import math
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import (
    Fmu,
    FmuCrashError,
    FmuEndedError,
    FmuRunError,
    FmuTimeLimitError,
    Stepper,
    StepperEndedError,
    UnsupportedFmuError,
    paced,
)
from pyjoystick.support import ParameterError, UnknownInputError, UnknownVariableError
from tests.pyjoystick.fmu.awkward import Trouble
from tests.pyjoystick.fmu.doctored import doctored

STEP = 1e-3
START = {"theta_start": 0.1}
#: A torque that jumps, stays and returns to what it was (N m).
TORQUES = np.repeat(np.random.default_rng(7).normal(0.0, 0.4, 30), 5).round(2)


@pytest.fixture(scope="module")
def here(joystick_path: Path) -> Iterator[Fmu]:
    with Fmu(joystick_path) as fmu:
        yield fmu


@pytest.fixture(scope="module", params=["FMI 2", "FMI 3", "own process"])
def any_joystick(
    request: pytest.FixtureRequest, here: Fmu, joystick_fmus: Path, joystick_fmus3: Path
) -> Iterator[Fmu]:
    if request.param == "FMI 2":
        yield here
        return
    is_apart = request.param == "own process"
    with Fmu((joystick_fmus if is_apart else joystick_fmus3) / "Joystick.fmu", own_process=is_apart) as fmu:
        yield fmu


def troubled(fmu: Fmu, trouble: Trouble) -> Stepper:
    parameters = {"trouble": int(trouble), "when": 0.1}
    return fmu.start(parameters=parameters, inputs={"u": 1.0}, stop_time=1.0)


def angles(stepper: Stepper, torques: Any = TORQUES[:20]) -> list[Any]:
    return [stepper.step(STEP, T=float(torque))["theta"] for torque in torques]


def test_the_numbers_are_those_of_a_run_bit_for_bit(any_joystick: Fmu) -> None:
    """Every output at every point, those that follow the torque at once included."""
    time = np.array([*itertools.accumulate([STEP] * len(TORQUES), initial=0.0)])
    jumps = pd.DataFrame({"T": np.repeat(TORQUES, 2)}, index=np.repeat(time, 2)[1:-1])
    table = any_joystick.run(time, parameters=START, inputs=jumps)
    rows = []
    settings: dict[str, Any] = {"parameters": START, "inputs": {"T": TORQUES[0]}, "stop_time": time[-1]}
    with any_joystick.start(**settings) as stepper:
        for torque in TORQUES:
            stepper.set(T=torque)
            rows.append(stepper.outputs)
            stepper.step(STEP)
        rows.append(stepper.outputs)
        assert stepper.time == time[-1]
        assert stepper.units["theta"] == "rad"
    pd.testing.assert_frame_equal(
        pd.DataFrame(rows, index=table.index), table, check_exact=True, check_names=False
    )


def test_saved_states_are_gone_back_to_as_often_as_wanted(any_joystick: Fmu) -> None:
    with any_joystick.start(0.5, parameters=START) as stepper:
        angles(stepper)
        here = stepper.save()
        assert here.time == stepper.time == pytest.approx(0.52)
        first = angles(stepper, TORQUES[20:60])
        there = stepper.save()
        for state, torques in ((here, TORQUES[20:60]), (there, TORQUES[60:]), (here, TORQUES[20:60])):
            stepper.restore(state)
            assert stepper.time == state.time
            found = angles(stepper, torques)
            assert found == first or state is there
        del here
        gc.collect()
        stepper.restore(there)  # and what nothing refers to any more is freed
        assert stepper.get("theta") == stepper.outputs["theta"] == first[-1]


def test_what_a_state_had_been_given_is_gone_back_to_with_it(here: Fmu) -> None:
    """An input that is given the value it has is left alone, so its value must be known."""
    with here.start(parameters=START) as stepper:
        angles(stepper, [0.3])
        state = stepper.save()
        expected = angles(stepper, [0.3, 0.3])
        angles(stepper, [-0.2])
        stepper.restore(state)
        assert angles(stepper, [0.3, 0.3]) == expected


def test_a_parameter_is_tuned_on_the_way(here: Fmu) -> None:
    """Without damping the energy stays what it is."""
    with here.start(parameters=START, outputs=["E"], tolerance=1e-10) as stepper:
        before = stepper.outputs["E"]
        damped = stepper.step(0.05)["E"]
        assert damped < 0.99 * before
        assert stepper.step(0.2, {"damping.C": 0.0})["E"] == pytest.approx(damped, rel=1e-8)


def test_energy_that_a_controller_takes_out(here: Fmu) -> None:
    """A torque of -K omega, held for 0.1 ms, damps as that much more damping does, but for the step."""
    gain = 0.02
    with here.start(parameters=START) as stepper:
        for _ in range(3000):
            stepper.step(1e-4, T=-gain * stepper.outputs["omega"])
        controlled = stepper.outputs["theta"]
    damped = here.run([0.0, 0.3], parameters=START | {"damping.C": 0.045 + gain})["theta"].iloc[-1]
    free = here.run([0.0, 0.3], parameters=START)["theta"].iloc[-1]
    assert controlled == pytest.approx(damped, abs=5e-3 * abs(free - damped))


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda one: one.step(STEP, torque=1.0), UnknownInputError, "no input 'torque'; known are T"),
        (lambda one: one.step(STEP, {"theta": 1.0}), ParameterError, "only inputs and tunable parameters"),
        (lambda one: one.step(STEP, theta_start=1.0), ParameterError, "given to Fmu.start"),
        (lambda one: one.step(STEP, T=math.nan), ParameterError, "T = nan"),
        (lambda one: one.set(T="1"), ParameterError, "T = 1"),
        (lambda one: one.step(STEP, J=-1.0), ParameterError, "J = -1"),
        (lambda one: one.step(0.0), ParameterError, "length = 0"),
        (lambda one: one.step(-STEP), ParameterError, "above 0"),
        (lambda one: one.step(math.nan), ParameterError, "length = nan"),
        (lambda one: one.step(1e-20), ParameterError, "moves t = 0.02 s on"),
        (lambda one: one.step("1"), ParameterError, "length = 1"),
        (lambda one: one.step(10.0), ParameterError, "at most 0.98 s here.*stop_time = 1 s"),
        (lambda one: one.get("thet"), UnknownVariableError, "theta"),
    ],
)
def test_a_mistake_is_named_and_the_simulation_can_go_on(
    here: Fmu, call: Any, error: type[Exception], message: str
) -> None:
    with here.start(parameters=START, stop_time=1.0) as stepper, here.start(parameters=START) as other:
        angles(stepper), angles(other)
        with pytest.raises(error, match=message):
            call(stepper)
        assert angles(stepper) == angles(other)


def test_a_state_of_another_stepper_is_refused(here: Fmu) -> None:
    with (
        here.start() as stepper,
        here.start() as other,
        pytest.raises(ParameterError, match="by this stepper"),
    ):
        stepper.restore(other.save())


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"time": math.nan}, "time = nan"),
        ({"time": 1.0, "stop_time": 1.0}, "later than the start at 1 s"),
        ({"tolerance": 0.0}, "tolerance = 0"),
        ({"inputs": {"T": math.inf}}, "T = inf"),
        ({"parameters": {"T": 0.0}}, "give it as an input"),
    ],
)
def test_settings_are_checked_before_anything_starts(
    here: Fmu, settings: dict[str, Any], message: str
) -> None:
    with pytest.raises(ParameterError, match=message):
        here.start(**settings)


def test_the_instance_serves_again_after_the_end(here: Fmu) -> None:
    time = [0.0, 0.1, 0.2]
    expected = here.run(time, parameters=START)
    stepper = here.start(parameters=START)
    angles(stepper)
    state = stepper.save()
    stepper.close()
    stepper.close()
    for call in (lambda: stepper.step(STEP), lambda: stepper.outputs, lambda: stepper.restore(state)):
        with pytest.raises(StepperEndedError, match=r"ended at t = 0.02 s: it has been closed"):
            call()
    here.start()  # forgotten
    gc.collect()
    assert here._pool._taken == 0
    pd.testing.assert_frame_equal(here.run(time, parameters=START), expected, check_exact=True)


def test_a_failed_step_ends_the_simulation(any_joystick: Fmu) -> None:
    stepper = any_joystick.start(parameters=START)
    angles(stepper)
    state = stepper.save()
    with pytest.raises(FmuRunError, match=r"t = 0.02 s") as failure:
        stepper.step(STEP, T=1e200)
    assert failure.value.messages
    for call in (lambda: stepper.step(STEP), lambda: stepper.restore(state), stepper.save):
        with pytest.raises(StepperEndedError, match=r"simulation ended at t = 0.02 s"):
            call()
    assert "ended" in repr(stepper)
    stepper.close()
    with any_joystick.start(parameters=START) as again:
        assert angles(again)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("own_process", [False, None], ids=["here", "apart"])
def test_an_fmu_that_ends_or_fails(
    version: int, own_process: bool | None, awkward_path: Path, awkward3_path: Path
) -> None:
    """As in runs: what went wrong, when, and no word more to an FMU that is lost."""
    expected = {
        Trouble.ENDS: (FmuEndedError, "the FMU ended the simulation at t = 0.15 s"),
        Trouble.ERROR: (FmuRunError, "DoStep failed with status 3"),
        Trouble.FATAL: (FmuRunError, "DoStep failed with status 4"),
    }
    with Fmu(awkward_path if version == 2 else awkward3_path, own_process=own_process) as fmu:
        for trouble, (error, message) in expected.items():
            with troubled(fmu, trouble) as stepper:
                assert stepper.step(0.1)["y"] == pytest.approx(0.1)
                with pytest.raises(error, match=message):
                    stepper.step(0.1)
        with (
            troubled(fmu, Trouble.NONE) as stepper,
            pytest.raises(UnsupportedFmuError, match="cannot save its state"),
        ):
            stepper.save()


@pytest.mark.skipif(sys.platform == "win32", reason="the awkward FMU needs POSIX")
def test_a_crash_and_a_step_without_end(awkward3_path: Path) -> None:
    with Fmu(awkward3_path, time_limit=0.5) as fmu:
        for trouble, error in ((Trouble.CRASHES, FmuCrashError), (Trouble.FOREVER, FmuTimeLimitError)):
            stepper = troubled(fmu, trouble)
            stepper.step(0.1)
            with pytest.raises(error, match=r"t = 0.1 s"):
                stepper.step(0.1)
            with pytest.raises(StepperEndedError):
                stepper.set(u=2.0)
        with troubled(fmu, Trouble.NONE) as stepper:
            assert stepper.step(0.1)["y"] == pytest.approx(0.1)


def test_ctrl_c_within_a_call_ends_the_simulation(here: Fmu, monkeypatch: pytest.MonkeyPatch) -> None:
    stepper = here.start()
    with monkeypatch.context() as patch:
        patch.setattr(stepper._instance, "_get", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            stepper.step(STEP)
    with pytest.raises(StepperEndedError, match="KeyboardInterrupt in a call"):
        stepper.step(STEP)


def test_values_of_every_type(echo3: Fmu, echo2: Fmu) -> None:
    with echo3.start(parameters={"text": "Größe", "p_Int16": -7}, inputs={"u_Int16": 5}) as stepper:
        assert stepper.left_out == ("blob",)
        assert stepper.outputs["said"] == "Größe 0.0"
        assert [stepper.outputs[f"both_Int16[{i}]"] for i in (1, 2, 3)] == [-7, 5, -7]
        assert stepper.get("both_Int16[2]") == 5
        after = stepper.step(
            0.5, {"text_input": "late", "u_Int16": 6, "u_Float32": 0.5, "u_UInt64": 2**64 - 1}
        )
        assert (after["text_again"], after["both_Int16[2]"], after["both_UInt64[2]"]) == (
            "late",
            6,
            2**64 - 1,
        )
        with pytest.raises(ParameterError, match="u_UInt8 = 256"):
            stepper.set(u_UInt8=256)
    with echo2.start() as stepper:
        assert [stepper.step(0.5)["said"] for _ in range(2)] == ["step 1", "step 2"]


def test_truths_are_truths(mixed: Fmu) -> None:
    with mixed.start(inputs={"u": 0.5}) as stepper:
        assert stepper.outputs["above"] is False
        assert stepper.step(0.1, u=1.5)["above"] is True
        assert (stepper.get("n"), stepper.outputs["steps"]) == (3, -3)


def test_an_fmu_with_one_instance_a_process(joystick_path: Path, tmp_path: Path) -> None:
    """A run beside the stepper would wait for the instance for ever."""
    path = doctored(
        joystick_path,
        tmp_path / "one.fmu",
        description=lambda text: text.replace('OncePerProcess="false"', 'OncePerProcess="true"'),
    )
    with Fmu(path) as fmu, pytest.raises(UnsupportedFmuError, match="own_process=True"):
        fmu.start()
    with Fmu(path, own_process=True) as fmu, fmu.start(parameters=START) as stepper:
        assert angles(stepper)
        assert len(fmu.run([0.0, 0.1])) == 2


def test_threads_take_turns(here: Fmu) -> None:
    with here.start(parameters=START) as stepper, here.start(parameters=START) as alone:
        threads = [
            threading.Thread(target=lambda: [stepper.step(STEP) for _ in range(200)]) for _ in range(3)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert stepper.outputs == [alone.step(STEP) for _ in range(600)][-1]


@pytest.mark.parametrize("duration", [math.nan, -1.0])
def test_a_pace_ends_at_a_duration_that_is_one(duration: float) -> None:
    with pytest.raises(ParameterError, match=r"duration .* 0 or more"):
        paced(1e-6, duration)
