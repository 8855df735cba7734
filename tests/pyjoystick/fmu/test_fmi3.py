"""Co-Simulation FMUs of FMI 3.0: every type of variable, failures, and unsupported features."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Final, Fmu, FmuRunError, read_description
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.library import FmuLibrary
from pyjoystick.support import ParameterError
from tests.pyjoystick.fmu.awkward import ROUGH, Trouble

TIME = np.linspace(0.0, 1.0, 5)
#: Type of each output and its value after so many steps.
OUTPUTS: dict[str, tuple[type[Any], Any]] = {
    "steps": (np.int32, lambda steps: -steps),
    "u8": (np.uint8, lambda steps: 200 + steps),
    "i16": (np.int16, lambda steps: -30_000 - steps),
    "u16": (np.uint16, lambda steps: 60_000 + steps),
    "u32": (np.uint32, lambda steps: 4_000_000_000 + steps),
    "i64": (np.int64, lambda steps: -(2**53) - 1 - steps),
    "u64": (np.uint64, lambda steps: 18 * 10**18 + steps),
}


@pytest.fixture
def awkward3(awkward3_path: Path) -> Iterator[Fmu]:
    with Fmu(awkward3_path, own_process=False) as fmu:
        yield fmu


def test_a_table_has_every_type_as_it_is(awkward3: Fmu, loop: str) -> None:
    parameters = {"gain": 2.0, "label": "two words", "flag": True, "tiny": -64}
    table = awkward3.run(TIME, parameters=parameters, inputs={"u": 3.0})
    np.testing.assert_allclose(table["y"], 6.0 * TIME, rtol=1e-15)
    np.testing.assert_array_equal(table["f32"], (table["y"] / 3.0).astype(np.float32))
    assert table["f32"].dtype == np.float32
    for name, (dtype, value) in OUTPUTS.items():
        assert table[name].dtype == dtype
        assert table[name].tolist() == [value(steps) for steps in range(5)]
    assert table["twice"].tolist() == [-128] * 5
    assert table["length"].tolist() == [9] * 5
    assert table["negated"].dtype == np.bool_
    assert not table["negated"].any()


def test_a_plan_gives_the_same_as_numbers(awkward3: Fmu, loop: str) -> None:
    plan = awkward3.plan(TIME, varied=("tiny", "flag", "gain"), inputs={"u": 3.0})
    table = awkward3.run(TIME, parameters={"tiny": 5, "flag": False, "gain": 0.5}, inputs={"u": 3.0})
    np.testing.assert_array_equal(plan.run([5, 0, 0.5]), table.to_numpy(dtype=np.float64))


def test_inputs_are_held_over_a_step(awkward3: Fmu, loop: str) -> None:
    ramp = pd.DataFrame({"u": [0.0, 1.0]}, index=[0.0, 1.0])
    y = awkward3.run(TIME, inputs=ramp, outputs="y")["y"]
    np.testing.assert_allclose(y, np.concatenate([[0.0], np.cumsum(TIME[:-1] * 0.25)]), rtol=1e-15)


def test_failures(awkward3: Fmu, loop: str) -> None:
    plan = awkward3.plan(TIME, varied=("trouble", "when"), inputs={"u": 1.0}, outputs="y")
    troubles = [trouble for trouble in Trouble if trouble not in ROUGH]
    batch = plan.run_batch([(trouble, 0.4) for trouble in troubles] * 3, reductions=[Final("y")], threads=2)
    told = dict(zip(troubles, batch.messages, strict=False))
    assert (
        told[Trouble.ERROR]
        == "awkward3.fmu at t = 0.5 s: trouble at 0.5 (fmi3DoStep failed with status 3 (error))"
    )
    assert told[Trouble.DISCARD].endswith("status 2 (discard))")
    assert told[Trouble.FATAL].endswith("status 4 (fatal))")
    assert told[Trouble.REFUSED_START].startswith("awkward3.fmu at t = 0 s: 100 % refused at 0 (fmi3Exit")
    assert told[Trouble.ENDS] == "awkward3.fmu: the FMU ended the simulation at t = 0.625 s"
    reason = "fmi3DoStep came back at t = 0.625 s, before the end of the step"
    early = f"awkward3.fmu at t = 0.5 s: no message ({reason})"
    assert told[Trouble.COMES_BACK_EARLY] == told[Trouble.STOPS_SHORT] == early
    sound = (
        *(Trouble.NONE, Trouble.WARNINGS),
        *(Trouble.NO_RESET, Trouble.FATAL_RESET, Trouble.KEEPS_STATE),
    )
    assert batch.failed.tolist() == [trouble not in sound for trouble in troubles] * 3
    assert batch.reduced is not None
    np.testing.assert_allclose(batch.reduced["y.final"][~batch.failed], 1.0, rtol=1e-15)


def test_a_failing_run_raises(awkward3: Fmu, loop: str) -> None:
    """The FMU of these tests wants a tolerance of 1e-8."""
    with pytest.raises(FmuRunError, match=r"not these settings at 0 .fmi3EnterInitializationMode failed"):
        awkward3.run(TIME, tolerance=1e-6)


@pytest.fixture
def instance(awkward3_path: Path) -> Iterator[Instance]:
    """One that is stepped by hand."""
    library = FmuLibrary(read_description(awkward3_path), "CoSimulation")
    instance = library.instantiate()
    # The FMU of these tests wants to know the end of the run.
    instance.fmi.enterInitializationMode = partial(instance.fmi.enterInitializationMode, stopTime=1.0)
    yield instance
    instance.free()
    library.close()


def test_stepped_by_hand_it_gives_what_a_run_gives(awkward3: Fmu, instance: Instance) -> None:
    parameters = {"gain": 2.0, "label": "two words", "flag": True, "tiny": -64}
    table = awkward3.run(TIME, parameters=parameters, inputs={"u": 3.0})
    variables = instance.description.variables
    for _ in range(2):
        instance.initialize(0.0, 1e-8, parameters)
        instance.set([variables["u"]], [3.0])
        for i, time in enumerate(TIME):
            if i:
                instance.step(TIME[i - 1], time - TIME[i - 1])
            # 2^53 + 1 and beyond are rounded.
            expected = table.iloc[i].to_numpy(dtype=np.float64)
            assert instance.get([variables[name] for name in table]) == expected.tolist()


@pytest.mark.parametrize(
    ("trouble", "message"),
    [
        (Trouble.ERROR, r"at t = 0 s: trouble at 0 \(.*fmi3DoStep"),
        (Trouble.ENDS, "the FMU ended the simulation at t = 0.125 s"),
        (Trouble.COMES_BACK_EARLY, "fmi3DoStep came back at t = 0.125 s, before the end of the step"),
        (Trouble.STOPS_SHORT, "fmi3DoStep came back at t = 0.125 s, before the end of the step"),
    ],
)
def test_a_step_by_hand_that_fails(instance: Instance, trouble: Trouble, message: str) -> None:
    instance.initialize(0.0, 1e-8, {"trouble": trouble, "when": 0.0})
    with pytest.raises(FmuRunError, match=message), instance.reporting(0.0):
        instance.step(0.0, 0.25)


def test_arrays_and_numbers_beyond_a_type_are_refused(awkward3: Fmu) -> None:
    with pytest.raises(ParameterError, match="many = an array: must be a single number"):
        awkward3.run(TIME, parameters={"many": 1.0})
    with pytest.raises(ParameterError, match="many = an array"):
        awkward3.run(TIME, outputs="many")
    with pytest.raises(ParameterError, match=r"tiny = 128: must be an integer \(its type is Int8\)"):
        awkward3.run(TIME, parameters={"tiny": 128})
    with pytest.raises(ParameterError, match="tiny = -129"):
        awkward3.plan(TIME, varied="tiny").run([-129])
