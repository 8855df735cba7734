"""Inputs of a run: linear pieces, jumps, constants, and invalid ones."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, inverse_torque, simulate
from pyjoystick.support import ParameterError, PyJoystickError, SeriesError, UnknownInputError
from tests.pyjoystick.fmu.doctored import doctored

TIME = np.linspace(0.0, 1.0, 41)
#: A ramp up, a kink between two outputs, a jump down at an output, and a hold.
TORQUE = pd.DataFrame({"T": [0.0, 1.2, 0.4, -0.6, -0.6]}, index=[0.1, 0.313, 0.5, 0.5, 0.7])


@pytest.fixture
def inverse(joystick_fmus: Path) -> Iterator[Fmu]:
    with Fmu(joystick_fmus / "JoystickInverse.fmu") as fmu:
        yield fmu


def filtered() -> pd.DataFrame:
    """Rows that are left of a table without a time, with their numbers."""
    rows = pd.DataFrame({"T": np.arange(9.0)})
    return rows[rows["T"].isin([0.0, 5.0])]


NO_SECONDS = ("time (msecs)", "Millisekunden", "Minuten", "time in hrs", "time/ps", "days", "clock ticks")


def named(name: str) -> pd.DataFrame:
    return pd.DataFrame({"T": [0.0, 2.0]}, index=pd.Index([0.0, 500.0], name=name))


def with_units(units: Any) -> pd.DataFrame:
    table = named("time (s)")
    table.attrs["units"] = units
    return table


def in_milliseconds(name: str | None) -> pd.DataFrame:
    table = pd.DataFrame({"T": [1.0, 2.0]}, index=pd.Index([0.0, 1000.0], name=name))
    table.attrs["units"] = {name or "time": "ms"}
    return table


def in_millinewton_metres() -> pd.DataFrame:
    table = pd.DataFrame({"T": [1000.0, 2000.0]}, index=[0.0, 1.0])
    table.attrs["units"] = {"time": "s", "T": "mN.m"}
    return table


def torque(time: float) -> float:
    """TORQUE with the right-hand value at the jump."""
    if time < 0.5:
        return float(np.interp(time, [0.1, 0.313, 0.5], [0.0, 1.2, 0.4]))
    return -0.6


def test_straight_pieces_and_jumps_are_exact(joystick: Fmu) -> None:
    table = joystick.run(TIME, inputs=TORQUE, parameters={"theta_start": 0.05}, outputs=["theta", "T"])
    expected = simulate(
        NOMINAL, time=TIME, theta_start=0.05, torque=torque, torque_breakpoints=[0.1, 0.313, 0.5, 0.7]
    )
    assert np.abs(table["theta"] - expected.theta).max() < 1e-7
    np.testing.assert_allclose(table["T"], expected.T, rtol=0.0, atol=1e-15)
    assert len(table) == len(TIME)


def test_a_constant_input(joystick: Fmu) -> None:
    table = joystick.run(TIME, inputs={"T": 0.8})
    expected = simulate(NOMINAL, time=TIME, theta_start=0.0, torque=lambda _: 0.8)
    assert np.abs(table["theta"] - expected.theta).max() < 1e-7


def test_an_fmu_that_cannot_interpolate_holds_the_input_over_a_step(
    joystick_path: Path, tmp_path: Path
) -> None:
    path = doctored(
        joystick_path,
        tmp_path / "Joystick.fmu",
        description=lambda text: text.replace('canInterpolateInputs="true"', 'canInterpolateInputs="false"'),
    )
    ramp = pd.DataFrame({"T": [0.0, 1.0]}, index=[0.0, 1.0])
    with Fmu(path) as fmu:
        table = fmu.run(TIME, inputs=ramp, outputs=["theta", "T"])
    steps = simulate(
        NOMINAL,
        time=TIME,
        theta_start=0.0,
        torque=lambda time: float(TIME[np.searchsorted(TIME, time, side="right") - 1]),
        torque_breakpoints=TIME,
    )
    assert np.abs(table["theta"] - steps.theta).max() < 1e-7
    np.testing.assert_array_equal(table["T"], TIME)


def test_outputs_that_depend_on_inputs_at_once_belong_to_the_same_instant(inverse: Fmu) -> None:
    time = np.linspace(0.0, 1.0, 101)
    motion = pd.DataFrame(
        {
            "theta": 0.3 * np.sin(9.0 * time),
            "omega": 2.7 * np.cos(9.0 * time),
            "alpha": -24.3 * np.sin(9.0 * time),
        },
        index=time,
    )
    table = inverse.run(time, inputs=motion)
    expected = inverse_torque(NOMINAL, motion["theta"], motion["omega"], motion["alpha"])
    for name in ("T", "T_inertia", "T_damping", "T_stiffness"):
        np.testing.assert_allclose(table[name], getattr(expected, name), rtol=1e-12, atol=1e-12, err_msg=name)


@pytest.mark.parametrize(
    ("inputs", "error", "message"),
    [
        ({"torque": 1.0}, UnknownInputError, "no input 'torque'; known are T"),
        ({"theta": 1.0}, UnknownInputError, "no input 'theta'"),
        ({"T": math.nan}, ParameterError, r"T = nan: must be a finite number in N\.m"),
        ({"T": "much"}, ParameterError, "T = much: must be a finite number"),
        (
            {"T": pd.Series([1.0, 2.0])},
            ParameterError,
            "T = an object of type Series: must be a number; a table",
        ),
        ({"T": [1.0, 2.0]}, ParameterError, "T = an object of type list: must be a number; a table"),
        (pd.DataFrame({"T": [1.0, math.nan]}, index=[0.0, 1.0]), ParameterError, "T = nan"),
        (pd.DataFrame({"T": []}, index=[]), ParameterError, "inputs = an empty table"),
        (pd.DataFrame({"T": [1.0, 2.0]}, index=[0.5, 0.4]), SeriesError, "is 0.4 at row 1"),
        (pd.DataFrame({"T": [1.0, 2.0]}, index=[0.5, math.nan]), SeriesError, "is nan at row 1"),
        (pd.DataFrame({"T": [1.0, 2.0]}, index=["a", "b"]), SeriesError, "must be time in s"),
        (pd.DataFrame({"T": [1.0, 2.0]}, index=[0j, 1.0 + 1.0j]), SeriesError, "must be time in s"),
        (pd.DataFrame({"T": [1.0, 2.0]}), SeriesError, "counts the rows; must be time in s"),
        (filtered(), SeriesError, 'counts the rows; .*; name the index "time" if these are seconds$'),
        (filtered().set_axis(pd.Index([0, 5], dtype=object)), SeriesError, "counts the rows"),
        (
            pd.DataFrame({"T": [1.0, 2.0]}, index=pd.to_timedelta([0, 1], unit="s")),
            SeriesError,
            r"is a TimedeltaIndex; must be time in s, as numbers: index\.total_seconds\(\)",
        ),
        (
            pd.DataFrame({"T": [1.0, 2.0]}, index=pd.to_datetime([0, 1], unit="s")),
            SeriesError,
            r"is a DatetimeIndex; must be time in s, as numbers: \(index - index\[0\]\)\.total_seconds\(\)",
        ),
        (
            pd.DataFrame({"T": [1.0, 2.0]}, index=pd.period_range("2004-01-01", periods=2, freq="s")),
            SeriesError,
            r"is a PeriodIndex; .*: index = index\.to_timestamp\(\), then \(index - index\[0\]\)\.total_s",
        ),
        (in_milliseconds("time"), ParameterError, "unit of time = ms: must be s"),
        (named("time (ms)"), SeriesError, r"is named 'time \(ms\)'; must be time in s, not ms"),
        (named("t_us"), SeriesError, "is named 't_us'; must be time in s, not us"),
        *((named(name), SeriesError, "must be time in s, not") for name in NO_SECONDS),
        (named("time (0.1 s)"), SeriesError, r"must be time in s, not 0\.1 s"),
        (named("Frame"), SeriesError, "is named 'Frame'; must be time in s, not frame"),
        (
            with_units(["N.m"]),
            ParameterError,
            r'attrs\["units"\] = an object of type list: must be a mapping',
        ),
        (in_milliseconds("instant"), ParameterError, "unit of instant = ms: must be s"),
        (in_milliseconds(None), ParameterError, "unit of time = ms: must be s"),
        (in_millinewton_metres(), ParameterError, r"unit of T = mN\.m: must be N\.m"),
        (
            pd.DataFrame([[1.0, 2.0]], columns=["T", "T"], index=[0.0]),
            ParameterError,
            "columns T, T: must be one column for T",
        ),
        (
            np.zeros((3, 2)),
            ParameterError,
            "inputs = an object of type ndarray: must be a mapping .* DataFrame",
        ),
    ],
)
def test_inputs_that_are_refused(
    joystick: Fmu, inputs: pd.DataFrame, error: type[PyJoystickError], message: str
) -> None:
    with pytest.raises(error, match=message):
        joystick.run(TIME, inputs=inputs)


def test_whole_seconds_and_a_unit_that_is_right_are_taken(joystick: Fmu) -> None:
    table = pd.DataFrame({"T": [0.0, 1.0]}, index=pd.Index([0, 1], name="time"))
    table.attrs["units"] = {"time": "s", "T": "N.m"}
    last = joystick.run(TIME, inputs=table, outputs=["T"])["T"].iloc[-1]
    assert last == 1.0


def test_constants_come_as_a_mapping(joystick: Fmu) -> None:
    """A table has no one value: its first row would be an arbitrary choice."""
    given: Any = TORQUE
    for call in (lambda: joystick.linearize(0.1, inputs=given), lambda: joystick.start(inputs=given)):
        with pytest.raises(
            ParameterError, match="inputs = an object of type DataFrame: must be a mapping from names"
        ):
            call()


def test_parameters_come_as_a_mapping(joystick: Fmu) -> None:
    with pytest.raises(
        ParameterError, match="parameters = an object of type list: must be a mapping from names to values"
    ):
        joystick.run(TIME, parameters=[0.045])  # type: ignore[arg-type]
    row: Any = pd.Series({"theta_start": 0.1, "damping.C": 0.05})
    np.testing.assert_array_equal(
        joystick.run(TIME, parameters=row)["theta"], joystick.run(TIME, parameters=dict(row))["theta"]
    )


@pytest.mark.parametrize("name", ["time", "t (s)", "Zeit [s]", "sample time (s)", "seconds", "time_s", None])
def test_names_of_times_in_seconds(joystick: Fmu, name: str | None) -> None:
    table = pd.DataFrame({"T": [0.0, 1.0]}, index=pd.Index([0.0, 0.5], name=name))
    assert joystick.run(TIME, inputs=table, outputs=["T"])["T"].max() == 1.0
