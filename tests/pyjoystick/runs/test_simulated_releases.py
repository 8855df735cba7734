from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters
from pyjoystick.runs import SimulatedReleases
from pyjoystick.support import ParameterError, UnknownParameterError
from tests.pyjoystick.releases import reference_release

RELEASE = math.radians(-20.0)


@pytest.mark.parametrize("joystick", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
def test_the_peaks_are_those_of_the_reference(fmus_by_name: Path, joystick: JoystickParameters) -> None:
    with SimulatedReleases() as simulate:
        found = simulate(joystick, RELEASE)
    expected = reference_release(joystick, RELEASE)
    assert found.release_angle == RELEASE
    assert found.displacement["value"][:9].to_numpy() == pytest.approx(
        expected.displacement["value"][:9], abs=1e-6
    )
    # Peaks of the velocity lie between kinks: their times are good to about a sample, 1 ms in the reference.
    assert found.velocity["time"][:10].to_numpy() == pytest.approx(expected.velocity["time"][:10], abs=1e-3)
    assert found.velocity["value"][:10].to_numpy() == pytest.approx(expected.velocity["value"][:10], rel=1e-3)


def test_varied_runs_are_the_single_ones(fmus_by_name: Path) -> None:
    with SimulatedReleases(duration=1.0) as simulate:
        runs = simulate.vary(NOMINAL, RELEASE, "damping.C", np.array([0.03, 0.06]))
        assert list(runs) == [0.03, 0.06]
        for value, peaks in runs.items():
            single = simulate(NOMINAL.replace({"damping.C": value}), RELEASE)
            assert peaks.displacement.equals(single.displacement)
            assert peaks.velocity.equals(single.velocity)
            assert peaks.name == f"damping.C = {value:g}"


def test_stops_that_vary_from_none_keep_their_stiffness(fmus_by_name: Path) -> None:
    joystick = NOMINAL.replace({"stops.K": 50.0, "stops.D": 0.1})
    with SimulatedReleases(duration=0.5) as simulate:
        runs = simulate.vary(joystick, RELEASE, "stops.theta_stop", np.array([0.0, 0.2]))
        single = simulate(joystick.replace({"stops.theta_stop": 0.2}), RELEASE)
        stiff = simulate(NOMINAL.replace({"stops.theta_stop": 0.2}), RELEASE)
    assert runs[0.2].displacement.equals(single.displacement)
    assert not runs[0.2].displacement.equals(stiff.displacement)


def test_what_cannot_be_is_refused(fmus_by_name: Path) -> None:
    with SimulatedReleases() as simulate:
        with pytest.raises(UnknownParameterError):
            simulate.vary(NOMINAL, RELEASE, "damping.alpha", np.array([0.5]))
        with pytest.raises(ParameterError, match=r"damping\.C"):
            simulate.vary(NOMINAL, RELEASE, "damping.C", np.array([-0.5]))
        with pytest.raises(ParameterError, match="release_angle"):
            simulate(NOMINAL, -20.0)
