"""The default experiments for comparing two FMUs."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import FmuDescription, read_description
from pyjoystick.runs import experiments_for
from pyjoystick.support import ParameterError
from tests.pyjoystick.fmu.doctored import doctored


@pytest.fixture(scope="module")
def joystick(joystick_fmus: Path) -> FmuDescription:
    return read_description(joystick_fmus / "Joystick.fmu")


@pytest.fixture(scope="module")
def inverse(joystick_fmus: Path) -> FmuDescription:
    return read_description(joystick_fmus / "JoystickInverse.fmu")


@pytest.fixture(scope="module")
def first(pair: Path) -> FmuDescription:
    return read_description(pair / "First.fmu")


def test_joysticks_are_let_go_on_both_sides_and_driven(joystick: FmuDescription) -> None:
    *releases, driven = experiments_for(joystick, joystick)
    starts = [math.degrees(float(one.parameters["theta_start"])) for one in releases]
    assert starts == pytest.approx([-20.0, -10.0, 5.0, 15.0])
    for one in releases:
        np.testing.assert_allclose(one.time, np.linspace(0.0, 1.5, 1501), rtol=1e-14)
        assert len(one.inputs) == 0
    assert driven.parameters == {}
    assert isinstance(driven.inputs, pd.DataFrame)
    assert driven.inputs["T"].max() == pytest.approx(2.0, abs=1e-3)


@pytest.mark.parametrize("name", ["joystick", "inverse"])
def test_an_angle_in_degrees_makes_no_joystick(
    name: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    path = request.getfixturevalue(name).path

    def in_degrees(text: str) -> str:
        return re.sub(r'(name="theta"[^>]*>\s*<Real[^>]*) unit="rad"', r'\1 unit="deg"', text)

    other = read_description(doctored(path, tmp_path / "deg.fmu", description=in_degrees))
    assert other.variables["theta"].unit == "deg"
    (one,) = experiments_for(other, other)
    assert one.label == "0 to 1.5 s"
    assert one.parameters == {}


def test_angles_and_lengths_can_be_chosen(joystick: FmuDescription) -> None:
    (one,) = experiments_for(
        joystick, joystick, release_angles=[0.1], duration=0.7, output_interval=0.01, settings={"J": 0.02}
    )
    assert one.parameters == {"J": 0.02, "theta_start": 0.1}
    np.testing.assert_allclose(one.time, np.linspace(0.0, 0.7, 71), rtol=1e-14)


def test_an_interval_that_does_not_divide_the_duration_is_rounded(joystick: FmuDescription) -> None:
    one = experiments_for(joystick, joystick, duration=1.0, output_interval=0.03)[0]
    np.testing.assert_allclose(one.time, np.linspace(0.0, 1.0, 34))


def test_a_torque_that_is_held_or_given_takes_the_place_of_the_sine(joystick: FmuDescription) -> None:
    held = experiments_for(joystick, joystick, settings={"T": 0.5})
    assert [one.inputs for one in held] == [{"T": 0.5}] * 4
    torque = pd.DataFrame({"T": [0.0, 1.0]}, index=[0.0, 1.0])
    (given,) = experiments_for(joystick, joystick, inputs=torque)
    assert given.parameters == {"theta_start": 0.0}
    pd.testing.assert_frame_equal(given.inputs, torque)
    assert [
        one.label for one in experiments_for(joystick, joystick, release_angles=[0.1, 0.2], inputs=torque)
    ] == [
        "5.72958 deg, driven",
        "11.4592 deg, driven",
    ]


def test_the_inverse_is_led_through_a_motion(inverse: FmuDescription) -> None:
    motions = experiments_for(inverse, inverse)
    assert len(motions) == 4
    time, motion = motions[0].time, motions[0].inputs
    assert isinstance(motion, pd.DataFrame)
    assert np.abs(motion["theta"]).max() == pytest.approx(math.radians(20.0))
    for lower, upper in (("theta", "omega"), ("omega", "alpha")):
        rate = np.gradient(motion[lower], time)[1:-1]
        assert np.abs(rate - motion[upper].to_numpy()[1:-1]).max() < 1e-4 * np.abs(motion[upper]).max()
    # The middle, where the law of damping jumps, lies between the instants.
    assert np.abs(motion["theta"]).min() > 1e-5


def test_any_other_fmu_runs_as_it_proposes(first: FmuDescription, pair: Path, tmp_path: Path) -> None:
    (one,) = experiments_for(first, first)
    np.testing.assert_allclose(one.time, np.linspace(0.0, 2.0, 501))
    path = doctored(
        pair / "Closed.fmu",
        tmp_path / "silent.fmu",
        description=lambda text: re.sub("<DefaultExperiment[^>]*/>", "", text),
    )
    silent = read_description(path)
    (other,) = experiments_for(silent, first)
    np.testing.assert_allclose(other.time, one.time)
    (nobody,) = experiments_for(silent, silent)
    np.testing.assert_allclose(nobody.time, np.linspace(0.0, 1.0, 501))
    (short,) = experiments_for(first, first, duration=0.5, output_interval=0.25)
    np.testing.assert_allclose(short.time, [0.0, 0.25, 0.5])
    late = read_description(
        doctored(
            first.path,
            tmp_path / "late.fmu",
            description=lambda text: text.replace('startTime="0.0"', 'startTime="1.0"'),
        )
    )
    (delayed,) = experiments_for(late, first)
    assert (delayed.time[0], delayed.time[-1]) == (1.0, 2.0)


def test_settings_take_the_types_of_the_variables(first: FmuDescription) -> None:
    (one,) = experiments_for(first, first, settings={"k": 3, "n": 2.0, "inverted": 1.0, "u": 0.25})
    assert one.parameters == {"k": 3.0, "n": 2, "inverted": True}
    assert [type(value) for value in one.parameters.values()] == [float, int, bool]
    assert one.inputs == {"u": 0.25}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            {"release_angles": [0.1]},
            "release_angle = 0.1 rad: must be left out for FMUs that are not joysticks",
        ),
        ({"duration": 0.0}, "duration = 0.0: must be a finite number above 0 s"),
        ({"output_interval": 0.0}, "output_interval = 0.0: must be a finite number above 0 s"),
        ({"output_interval": 3.0}, "output_interval = 3.0: must be from 2e-07 s to the duration, 2 s"),
        ({"output_interval": 1e-9}, "output_interval = 1e-09: must be from 2e-07 s to"),
        ({"settings": {"k": math.nan}}, "k = nan: must be a finite number"),
    ],
)
def test_what_is_refused(first: FmuDescription, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        experiments_for(first, first, **arguments)


def test_what_is_refused_for_joysticks(joystick: FmuDescription) -> None:
    with pytest.raises(ParameterError, match=r"release_angle = 2\.0: must be an angle"):
        experiments_for(joystick, joystick, release_angles=[2.0])
    with pytest.raises(ParameterError, match=r"theta_start = 0\.1: must be left out"):
        experiments_for(joystick, joystick, settings={"theta_start": 0.1})
