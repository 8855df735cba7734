"""Plans: the same runs as `Fmu.run`, in both loops, and invalid plans."""

from __future__ import annotations

import math
import pickle
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Final, Fmu, FmuNotFoundError, FmuRunError
from pyjoystick.fmu.stepping.engine import PLAIN_LOOP_VARIABLE
from pyjoystick.support import (
    ParameterError,
    PyJoystickError,
    UnknownInputError,
    UnknownParameterError,
    UnknownVariableError,
)
from tests.pyjoystick.fmu.awkward import Trouble
from tests.pyjoystick.fmu.doctored import doctored

TIME = np.linspace(0.0, 0.5, 101)
VARIED = ("theta_start", "damping.C")
OUTPUTS = ("theta", "omega", "alpha", "forward.returnSpring.isEngaged")
TORQUE = pd.DataFrame({"T": [0.0, 1.2, 0.4, -0.6, -0.6]}, index=[0.1, 0.313, 0.4, 0.4, 0.45])


def test_a_planned_run_is_that_of_the_fmu(joystick: Fmu, loop: str) -> None:
    plan = joystick.plan(
        TIME, varied=VARIED, parameters={"J": 0.012}, inputs=TORQUE, outputs=OUTPUTS, tolerance=1e-7
    )
    values = plan.run([0.2, 0.05])
    assert values.dtype == np.float64
    assert values.shape == (101, 4)
    table = joystick.run(
        TIME,
        parameters={"theta_start": 0.2, "damping.C": 0.05, "J": 0.012},
        inputs=TORQUE,
        outputs=OUTPUTS,
        tolerance=1e-7,
    )
    np.testing.assert_array_equal(values, table.to_numpy(dtype=np.float64))
    assert set(values[:, 3]) == {0.0, 1.0}
    assert plan.outputs == OUTPUTS
    assert plan.varied == VARIED
    assert plan.units["omega"] == "rad/s"


def test_compiled_and_plain_loop_agree_bit_for_bit(
    joystick: Fmu, joystick_path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    held = doctored(
        joystick_path,
        tmp_path / "held.fmu",
        description=lambda text: text.replace('canInterpolateInputs="true"', 'canInterpolateInputs="false"'),
    )
    results = {}
    for loop in ("compiled", "plain"):
        monkeypatch.setenv(PLAIN_LOOP_VARIABLE, "1" if loop == "plain" else "")
        with Fmu(held) as without_derivatives:
            results[loop] = [
                fmu.plan(TIME, varied=VARIED, inputs=TORQUE, outputs=OUTPUTS).run([-0.3, 0.04])
                for fmu in (joystick, without_derivatives)
            ]
    for compiled, plain in zip(results["compiled"], results["plain"], strict=True):
        np.testing.assert_array_equal(compiled, plain)
    assert np.abs(results["plain"][0] - results["plain"][1]).max() > 1e-6


def test_runs_leave_no_trace(joystick: Fmu, loop: str) -> None:
    plan = joystick.plan(TIME, varied="theta_start", outputs="theta")
    first = plan.run([0.3])
    joystick.plan(TIME, parameters={"J": 0.02}, inputs={"T": 0.3}, tolerance=1e-4).run()
    plan.run([-0.1])
    np.testing.assert_array_equal(plan.run([0.3]), first)
    assert first.shape == (101, 1)


def test_variables_of_several_types(mixed: Fmu, loop: str) -> None:
    plan = mixed.plan(
        np.linspace(0.0, 1.0, 11),
        varied=("inverted", "n", "gain"),
        inputs={"u": 1.5},
        parameters={"last": 9.0},
    )
    assert plan.outputs == ("y", "integral", "steps", "above")
    values = plan.run([1, 4, -0.5])
    np.testing.assert_array_equal(values[:, 0], -0.75)
    np.testing.assert_allclose(values[:, 1], 1.5 * plan.time, rtol=1e-12)
    np.testing.assert_array_equal(values[:, 2], np.where(values[:, 1] > 1.0, 4.0, -4.0))
    np.testing.assert_array_equal(values[:, 3], 0.0)
    np.testing.assert_array_equal(plan.run([0, 4, 1])[:, 3], 1.0)


def test_text_and_inputs_that_move_and_jump(awkward_fmu: Fmu, loop: str) -> None:
    ramp = pd.DataFrame({"u": [0.0, 2.0, 4.0]}, index=[0.0, 1.0, 1.0])
    plan = awkward_fmu.plan([0.0, 0.5, 1.0, 2.0], parameters={"label": "fünf", "tiny": -3}, inputs=ramp)
    values = dict(zip(plan.outputs, plan.run().T, strict=True))
    np.testing.assert_allclose(values["y"], [0.0, 0.25, 1.0, 5.0], rtol=1e-15)
    assert values["length"][0] == len("fünf".encode())
    assert values["twice"][0] == -6.0
    assert values["negated"].tolist() == [1.0] * 4


def test_a_failing_run_says_why_and_leaves_no_trace(awkward_fmu: Fmu, loop: str) -> None:
    plan = awkward_fmu.plan(TIME, varied=("trouble", "when"), inputs={"u": 1.0})
    sound = plan.run([Trouble.NONE, 0.0])
    for trouble, reason in (
        (Trouble.ERROR, "status 3 (error)"),
        (Trouble.DISCARD, "status 2 (discard)"),
        (Trouble.FATAL, "status 4 (fatal)"),
        (Trouble.NO_STATUS, "status 17 (not a status)"),
    ):
        with pytest.raises(FmuRunError) as caught:
            plan.run([trouble, 0.2])
        assert caught.value.time == 0.2
        assert caught.value.messages == ("trouble at 0.2",)
        assert caught.value.reason == f"fmi2DoStep failed with {reason}"
        np.testing.assert_array_equal(plan.run([Trouble.NONE, 0.0]), sound)
    with pytest.raises(FmuRunError, match=r"100 % refused at 0 .fmi2ExitInitializationMode failed"):
        plan.run([Trouble.REFUSED_START, 0.0])


def test_warnings_do_not_end_a_run(awkward_fmu: Fmu, loop: str) -> None:
    plan = awkward_fmu.plan(TIME, varied="trouble", inputs={"u": 1.0})
    np.testing.assert_array_equal(plan.run([Trouble.WARNINGS]), plan.run([Trouble.NONE]))


def test_an_instance_that_cannot_be_reset_is_replaced(awkward_fmu: Fmu, loop: str) -> None:
    plan = awkward_fmu.plan(TIME, varied="trouble", inputs={"u": 1.0})
    sound = plan.run([Trouble.NONE])
    for trouble in (Trouble.NO_RESET, Trouble.FATAL_RESET):
        for _ in range(2):
            np.testing.assert_array_equal(plan.run([trouble]), sound)


@pytest.mark.parametrize(
    ("settings", "error", "message"),
    [
        ({"varied": "thetastart"}, UnknownParameterError, "did you mean theta_start"),
        (
            {"varied": "T"},
            ParameterError,
            "T = varied: must be left out of the parameters .give it as an input",
        ),
        ({"varied": ("J", "m", "J")}, ParameterError, "varied = J: must be given once"),
        ({"varied": "J", "parameters": {"J": 0.01}}, ParameterError, "varied = J: must be given once"),
        ({"parameters": {"J": math.nan}}, ParameterError, "J = nan"),
        ({"inputs": {"t": 1.0}}, UnknownInputError, "no input 't'"),
        ({"outputs": "thet"}, UnknownVariableError, "did you mean theta"),
        ({"tolerance": 0.0}, ParameterError, "tolerance = 0"),
    ],
)
def test_settings_that_are_refused(
    joystick: Fmu, settings: dict[str, Any], error: type[PyJoystickError], message: str
) -> None:
    with pytest.raises(error, match=message):
        joystick.plan(TIME, **settings)


def test_text_cannot_vary(awkward_fmu: Fmu) -> None:
    with pytest.raises(ParameterError, match="varied = label: must be a number or Boolean variable"):
        awkward_fmu.plan(TIME, varied="label")


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([1, 3], r"values = an array of shape \(2,\): must be of shape \(3,\), for inverted, n, gain"),
        ([0, 10, 0], "n = 10.0: must be an integer from 1 to 9"),
        ([0, 2.5, 0], "n = 2.5: must be an integer from 1 to 9"),
        ([0.5, 2, 0], "inverted = 0.5: must be 0 or 1"),
        ([0, 2, math.nan], "gain = nan: must be a finite number from -2 to 2"),
        ([0, 2, 2.1], "gain = 2.1: must be"),
        (["much", 2, 1], "values = "),
    ],
)
def test_values_that_are_refused(mixed: Fmu, values: list[Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        mixed.plan(TIME, varied=("inverted", "n", "gain")).run(values)


def test_numbers_beyond_the_type_of_the_fmu_are_refused(awkward_fmu: Fmu) -> None:
    for value in (2.0**31, math.inf, -math.inf):
        with pytest.raises(ParameterError, match="tiny = "):
            awkward_fmu.plan(TIME, varied="tiny").run([value])
    with pytest.raises(
        ParameterError, match=r"tiny = 2147483648: must be an integer \(its type is Integer\)"
    ):
        awkward_fmu.run(TIME, parameters={"tiny": 2**31})


def test_several_threads_may_use_one_plan(joystick: Fmu, loop: str) -> None:
    plan = joystick.plan(TIME, varied="theta_start", outputs=OUTPUTS)
    starts = np.linspace(-0.3, 0.3, 12)
    expected = [plan.run([start]) for start in starts]
    found: dict[int, np.ndarray[Any, Any]] = {}

    def work(mine: range) -> None:
        for i in mine:
            found[i] = plan.run([starts[i]]) if i % 2 else joystick_table(i)

    def joystick_table(i: int) -> np.ndarray[Any, Any]:
        table = joystick.run(TIME, parameters={"theta_start": starts[i]}, outputs=OUTPUTS)
        return table.to_numpy(dtype=np.float64)

    threads = [threading.Thread(target=work, args=(range(first, 12, 3),)) for first in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for i in range(12):
        np.testing.assert_array_equal(found[i], expected[i])


def test_a_pickled_plan_runs_the_same(joystick: Fmu) -> None:
    plan = joystick.plan(TIME, varied="theta_start", parameters={"J": 0.012}, inputs=TORQUE, outputs=OUTPUTS)
    copy = pickle.loads(pickle.dumps(plan))
    np.testing.assert_array_equal(copy.run([0.1]), plan.run([0.1]))


def test_a_pickled_fmu_opens_its_file_again(joystick_path: Path, tmp_path: Path) -> None:
    moved = doctored(joystick_path, tmp_path / "gone.fmu")
    with Fmu(moved) as fmu:
        table = fmu.run(TIME)
        pickled = pickle.dumps(fmu)
    with pickle.loads(pickled) as again:
        pd.testing.assert_frame_equal(again.run(TIME), table, check_exact=True)
    moved.unlink()
    with pytest.raises(FmuNotFoundError, match=r"gone\.fmu"):
        pickle.loads(pickled)


def test_a_pickled_fmu_is_the_one_that_was_opened(
    joystick_path: Path, mixed_path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not another of the same name in what has become the current folder."""
    for folder, file in (("here", joystick_path), ("there", mixed_path)):
        (tmp_path / folder).mkdir()
        doctored(file, tmp_path / folder / "one.fmu")
    monkeypatch.chdir(tmp_path / "here")
    with Fmu("one.fmu") as fmu:
        monkeypatch.chdir(tmp_path / "there")
        with pickle.loads(pickle.dumps(fmu)) as again:
            assert again.description.model_name == fmu.description.model_name


def test_booleans_are_no_angles_and_masked_values_are_missing(joystick: Fmu) -> None:
    plan = joystick.plan(TIME, varied="theta_start", outputs=OUTPUTS)
    with pytest.raises(ParameterError, match="must be made of numbers in rows"):
        plan.run_batch([[True]])
    with pytest.raises(ParameterError, match=r"theta_start\[1\] = nan"):
        plan.run_batch(np.ma.masked_array([[0.1], [0.2]], mask=[[False], [True]]))


@pytest.mark.parametrize(
    "values",
    [
        pd.to_timedelta([0.1], unit="s"),
        pd.to_datetime([1], unit="ns"),
        pd.to_datetime([1], unit="ns", utc=True),
        pd.Categorical(pd.to_timedelta([1], unit="ns")),
        [0.1 + 1e-3j],
        np.array([np.timedelta64(1, "s")], dtype=object),
        [True],
        pd.array([True], dtype="boolean"),
    ],
    ids=["duration", "date", "zoned", "category", "complex", "object", "bool", "boolean"],
)
def test_columns_of_tables_are_numbers(values: Any, joystick: Fmu) -> None:
    plan = joystick.plan(TIME, varied=VARIED, outputs=OUTPUTS)
    table = pd.DataFrame({"damping.C": [0.045], "theta_start": values})
    with pytest.raises(ParameterError, match="must be made of numbers in rows"):
        plan.run_batch(table)
    with pytest.raises(ParameterError, match="must be made of numbers in rows"):
        joystick.plan(TIME, varied="theta_start").run(table["theta_start"])


def test_durations_and_a_single_reduction_are_refused(joystick: Fmu) -> None:
    second = np.timedelta64(1, "s")
    with pytest.raises(ParameterError, match="theta_start = 1 second"):
        joystick.run(TIME, parameters={"theta_start": second})
    with joystick.start() as stepper, pytest.raises(ParameterError, match="length = 1 second"):
        stepper.step(second)
    plan = joystick.plan(TIME, varied="theta_start", outputs=OUTPUTS)
    with pytest.raises(ParameterError, match=r"reductions = .*must be a sequence"):
        plan.run_batch([[0.1]], reductions=Final("theta"))  # type: ignore[arg-type]


def test_each_column_of_a_table_has_its_own_type(mixed: Fmu) -> None:
    plan = mixed.plan(TIME, varied=("inverted", "gain"))
    table = pd.DataFrame({"gain": [1, 2], "inverted": [True, False]})
    assert list(plan.run_batch(table).messages) == ["", ""]


def test_a_plan_keeps_its_fmu_open(joystick_path: Path) -> None:
    plan = Fmu(joystick_path).plan(TIME, varied="theta_start")
    assert plan.run([0.1]).shape == (101, 10)


def test_a_plan_of_a_closed_fmu(joystick_path: Path) -> None:
    with Fmu(joystick_path) as fmu:
        plan = fmu.plan(TIME)
    with pytest.raises(PyJoystickError, match=r"Joystick\.fmu has been closed"):
        plan.run()


def test_an_fmu_without_parameters_or_outputs_to_ask_for(joystick: Fmu, loop: str) -> None:
    assert joystick.plan(TIME, outputs=()).run().shape == (101, 0)
