"""The free oscillation with FMU and reference."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.fmu import Fmu, FmuNotFoundError, FmuRunError, UnsupportedFmuError
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.motion.tables import unit_of
from pyjoystick.runs import fmu_of_joystick, free_oscillation, reference_free_oscillation, time_grid
from pyjoystick.runs.experiments import COLUMNS
from pyjoystick.support import ParameterError, PyJoystickError, UnknownParameterError
from tests.pyjoystick.random_parameters import RandomCase, both_laws

RELEASE = math.radians(-20.0)


@pytest.mark.parametrize("case", both_laws(3), ids=lambda case: case.name)
def test_fmu_and_reference_agree_in_every_column(case: RandomCase, fmus_by_name: Path) -> None:
    run = free_oscillation(case.theta_start, parameters=case.parameters)
    expected = reference_free_oscillation(case.theta_start, parameters=case.parameters)
    assert tuple(run.columns) == tuple(expected.columns) == COLUMNS
    np.testing.assert_array_equal(run.index, expected.index)
    assert np.abs(run["theta"] - expected["theta"]).max() < 1e-7
    for name in COLUMNS:
        # What an error of 1e-7 rad does to the steepest of them: 1.1e6 N/m on f_x and alpha.
        tolerance = 1e-3 * np.abs(expected[name]).max()
        assert np.abs(run[name] - expected[name]).max() <= tolerance, name


def test_both_tables_carry_the_same_units(fmus_by_name: Path) -> None:
    run = free_oscillation(RELEASE, duration=0.01)
    expected = reference_free_oscillation(RELEASE, duration=0.01)
    assert run.attrs["units"] == expected.attrs["units"]
    assert unit_of(run, "C") == "N.m.s/rad"
    for name, unit in expected.attrs["display_units"].items():
        assert run.attrs["display_units"][name] == pytest.approx(unit), name


def test_the_joystick_starts_at_rest_at_the_release_angle_and_loses_energy(fmus_by_name: Path) -> None:
    for parameters in (NOMINAL, NOMINAL_POWER_LAW):
        table = free_oscillation(RELEASE, parameters=parameters)
        assert (table["theta"].iloc[0], table["omega"].iloc[0]) == (RELEASE, 0.0)
        assert np.diff(table["E"]).max() < 1e-9
        assert table["E"].iloc[-1] < 0.01 * table["E"].iloc[0]


def test_the_damping_law_chooses_the_fmu(fmus_by_name: Path) -> None:
    assert fmu_of_joystick(NOMINAL) == "Joystick"
    assert fmu_of_joystick(NOMINAL_POWER_LAW) == "JoystickPowerLaw"
    assert fmu_of_joystick(NOMINAL.replace({"friction.T_c": 0.01})) == "JoystickFriction"
    assert fmu_of_joystick(NOMINAL_POWER_LAW.replace({"friction.F_c": 0.3})) == "JoystickFrictionPowerLaw"
    assert free_oscillation(RELEASE, duration=0.1)["C"].nunique() == 1
    assert free_oscillation(RELEASE, parameters=NOMINAL_POWER_LAW, duration=0.1)["C"].nunique() > 10


def test_parameters_by_name_change_what_they_name(fmus_by_name: Path) -> None:
    changes = {"damping.C": 0.08, "forward.returnSpring.F_0": 40.0}
    run = free_oscillation(RELEASE, parameters=changes)
    expected = reference_free_oscillation(RELEASE, parameters=NOMINAL.replace(changes))
    assert np.abs(run["theta"] - expected["theta"]).max() < 1e-7


def test_an_open_fmu_is_used_and_left_open(fmus_by_name: Path) -> None:
    with Fmu("Joystick") as fmu:
        first = free_oscillation(RELEASE, fmu=fmu, duration=0.1)
        second = free_oscillation(RELEASE, fmu=fmu, duration=0.1)
    assert first.equals(second)
    assert first.equals(free_oscillation(RELEASE, fmu=fmus_by_name / "Joystick.fmu", duration=0.1))


@pytest.mark.parametrize("run", [free_oscillation, reference_free_oscillation])
@pytest.mark.parametrize("angle", [-20.0, math.pi / 2.0, -math.pi / 2.0])
def test_degrees_given_for_radians(run: Any, angle: float) -> None:
    with pytest.raises(ParameterError, match=r"release_angle = .*in degrees\?") as caught:
        run(angle)
    assert f"{math.radians(angle):.6g} rad" in caught.value.hint


@pytest.mark.parametrize("run", [free_oscillation, reference_free_oscillation])
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"release_angle": math.nan}, "release_angle = nan"),
        ({"release_angle": "far"}, "release_angle = far"),
        ({"duration": 0.0}, "duration = 0.0: must be a finite number above 0 s"),
        ({"duration": -1.0}, "duration = -1.0: must be"),
        ({"duration": math.nan}, "duration = nan: must be"),
        ({"duration": math.inf}, "duration = inf: must be"),
        ({"duration": "1 s"}, "duration = 1 s: must be"),
        ({"output_interval": 0.0}, "output_interval = 0.0: must be a finite number above 0 s"),
        ({"output_interval": 2.0}, "output_interval = 2.0: must be at most the duration, 1.5 s"),
        ({"output_interval": 1e-9}, r"output_interval = 1e-09: must be at least 1\.5e-07 s"),
    ],
)
def test_settings_that_are_refused(run: Any, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        run(**({"release_angle": RELEASE} | arguments))


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"fmu": "nowhere.fmu"}, FmuNotFoundError, r"no FMU nowhere\.fmu"),
        ({"parameters": {"J0": 1.0}}, UnknownParameterError, "no parameter 'J0'; did you mean J"),
        ({"parameters": {"m": math.nan}}, ParameterError, "m = nan"),
        ({"parameters": {"m": -1.0}}, ParameterError, "m = -1.0: must be a finite number above 0 kg"),
        ({"parameters": {"J": 0.0}}, ParameterError, r"J = 0\.0: must be a finite number above 0 kg\.m2"),
        (
            {"parameters": {"forward.balanceSpring.x_0": 0.0}},
            FmuRunError,
            "balanceSpring.x_0 must not be less",
        ),
        ({"parameters": {"theta_start": 0.1}}, ParameterError, "starts at rest"),
        ({"parameters": {"omega_start": 0.1}}, ParameterError, "starts at rest"),
        ({"parameters": NOMINAL, "fmu": "JoystickPowerLaw"}, UnknownParameterError, r"'damping\.C'"),
        ({"tolerance": 0.0}, ParameterError, "tolerance = 0.0"),
    ],
)
def test_what_the_fmu_does_not_take(
    fmus_by_name: Path, arguments: dict[str, Any], error: type[PyJoystickError], message: str
) -> None:
    with pytest.raises(error, match=message):
        free_oscillation(RELEASE, **arguments)


def test_an_fmu_that_is_no_joystick(fmus_by_name: Path) -> None:
    with pytest.raises(
        UnsupportedFmuError, match=r"does not have the interface of Joystick: it lacks theta_start"
    ):
        free_oscillation(RELEASE, fmu="JoystickInverse")


def test_a_grid_ends_at_the_duration() -> None:
    np.testing.assert_allclose(time_grid(1.5, 0.5), [0.0, 0.5, 1.0, 1.5], rtol=1e-15)
    np.testing.assert_allclose(time_grid(1.0, 0.3), [0.0, 0.3, 0.6, 0.9, 1.0], rtol=1e-15)
    np.testing.assert_array_equal(time_grid(0.1, 0.1), [0.0, 0.1])
    for duration, interval in ((1.5, 1e-3), (1.5, 1.0 / 600.0), (0.7, 0.1), (3.0, 0.007)):
        grid = time_grid(duration, interval)
        assert grid[0] == 0.0
        assert grid[-1] == duration
        steps = np.diff(grid)
        np.testing.assert_allclose(steps[:-1], interval, rtol=1e-6)
        assert 0.0 < steps[-1] < interval * (1.0 + 1e-6)


def test_the_reference_lists_its_events() -> None:
    events = reference_free_oscillation(RELEASE, duration=0.2).attrs["events"]
    assert [event["kind"] for event in events if event["kind"] == "theta = 0"]
    assert [event["time"] for event in events] == sorted(event["time"] for event in events)
