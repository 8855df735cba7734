"""Mechanical stops among the parameters: values, names in the FMU, files, and conflicts."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from pyjoystick.model import (
    FRICTION_NAMES,
    NOMINAL,
    NOMINAL_POWER_LAW,
    PAPER,
    STOP_NAMES,
    NoOscillationError,
    Stops,
    fmu_values,
    inverse_torque,
    read_parameter_file,
    undamped_oscillation,
    updated_text,
    values_for,
    write_parameters,
)
from pyjoystick.support import ParameterError

STOP = math.radians(20.0)
WITH = NOMINAL.replace({"stops.theta_stop": STOP, "stops.K": 800.0})


def test_no_stops_are_no_parameters_of_the_other_fmus() -> None:
    assert not NOMINAL.stops
    assert not set(STOP_NAMES) & set(NOMINAL.to_names())
    assert set(STOP_NAMES) < set(WITH.to_names())
    assert WITH.stops == Stops(theta_stop=STOP, K=800.0, D=0.7)
    assert WITH.replace({"stops.theta_stop": 0.0, "stops.K": 1000.0}) == NOMINAL
    assert WITH.replace({"J": 0.012}).stops == WITH.stops


@pytest.mark.parametrize(
    ("name", "value"),
    [("theta_stop", -0.1), ("theta_stop", 1.6), ("theta_stop", math.nan), ("K", 0.0), ("D", -1.0)],
)
def test_values_that_cannot_be(name: str, value: float) -> None:
    with pytest.raises(ParameterError) as caught:
        Stops(**{name: value})
    assert caught.value.field == name
    with pytest.raises(ParameterError, match=f"stops.{name}"):
        NOMINAL.replace({f"stops.{name}": value})


def test_a_file_keeps_them(tmp_path: Path) -> None:
    path = tmp_path / "joystick.toml"
    write_parameters(path, WITH, uncertainties={"stops.K": 50.0})
    file = read_parameter_file(path)
    assert file.joystick == WITH
    assert file.with_law("power-law").stops == WITH.stops
    assert file.uncertainties == {"stops.K": 50.0}
    assert "angle of the stops" in path.read_text()
    values = {value.name: value for value in fmu_values(file)}
    assert (values["stops.theta_stop"].value, values["stops.theta_stop"].unit) == (STOP, "rad")
    write_parameters(path, NOMINAL)
    assert read_parameter_file(path).joystick == NOMINAL
    assert "stops" not in updated_text(PAPER, NOMINAL_POWER_LAW)


def test_motions_beyond_a_stop_have_no_inverse_torque() -> None:
    """Eq. (13) has no stops, and neither has the inverse FMU."""
    within = inverse_torque(WITH, [-STOP, STOP], 0.0, 0.0)
    assert within.T.tolist() == inverse_torque(NOMINAL, [-STOP, STOP], 0.0, 0.0).T.tolist()
    with pytest.raises(ParameterError, match=r"within the stops at 0[.]349066 rad"):
        inverse_torque(WITH, [0.1, -STOP - 1e-6], 0.0, 0.0)


def test_a_swing_against_the_stops_has_no_undamped_period() -> None:
    assert undamped_oscillation(WITH, 0.3).period == undamped_oscillation(NOMINAL, 0.3).period
    with pytest.raises(NoOscillationError, match="stops"):
        undamped_oscillation(WITH, 0.36)


def test_an_fmu_with_more_parts_gets_zeros_for_them() -> None:
    """Only for names that it has: those that switch a part off."""
    off = {"stops.theta_stop": 0.0, "friction.T_c": 0.0, "friction.F_c": 0.0, "friction.T_s": 0.0}
    names = {*NOMINAL.to_names(), *STOP_NAMES, *FRICTION_NAMES}
    assert values_for(NOMINAL, names) == NOMINAL.to_names() | off
    assert values_for(NOMINAL, NOMINAL.to_names()) == NOMINAL.to_names()
    assert values_for(WITH, names) == off | WITH.to_names()
