from __future__ import annotations

import json
import math
from collections.abc import Iterator

import numpy as np
import pytest

from pyjoystick import NOMINAL, Fmu
from pyjoystick.forced_motion import (
    Basins,
    PeriodicAttractor,
    ShakenJoystick,
    Shaking,
    UnsettledMotion,
    attractor_report,
    basins,
    plot_attractors,
    response_json,
)
from pyjoystick.support import ParameterError


@pytest.fixture(scope="module")
def shaken() -> Iterator[ShakenJoystick]:
    with Fmu("Joystick") as fmu:
        yield ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0), tolerance=1e-10)


@pytest.fixture(scope="module")
def found(shaken: ShakenJoystick) -> Basins:
    return basins(shaken, np.radians([-20.0, -1.0, 1.0, 20.0]))


def test_both_attractors_at_4_hz_are_found(found: Basins) -> None:
    large, small = found.attractors
    assert isinstance(large, PeriodicAttractor)
    assert large.periods == 1
    assert math.degrees(large.largest) == pytest.approx(25.57, abs=0.005)
    assert isinstance(small, UnsettledMotion)
    assert small.exponent.is_chaotic
    assert math.degrees(small.largest) == pytest.approx(0.6, abs=0.05)
    assert found.labels[0].tolist() == [0, 1, 1, 0]
    assert found.share(0) + found.share(1) == 1.0


def test_the_speed_of_release_decides_as_well(shaken: ShakenJoystick) -> None:
    """A run of its own from each release, which ends on the attractor that its label names."""
    theta, omega = np.radians([-5.0, 8.0]), np.array([-6.0, 0.0, 9.0])
    found = basins(shaken, theta, omega, settling=60, iterations=20)
    assert found.labels.shape == (3, 2)
    assert found.theta.tolist() == theta.tolist()
    assert found.omega.tolist() == omega.tolist()
    seen = set()
    for i, speed in enumerate(omega):
        for j, angle in enumerate(theta):
            settled = shaken.with_periods(60).images(np.array([[angle, speed]]), 4.0)[0]
            high, low = shaken.orbit(settled, 4.0).extremes
            is_large = max(high, -low) > math.radians(20.0)
            one = found.attractors[found.labels[i, j]]
            assert is_large == isinstance(one, PeriodicAttractor)
            seen.add((j, is_large))
    # The same angle leads to either.
    assert any({(j, True), (j, False)} <= seen for j in range(len(theta)))


def test_the_exponent_is_that_of_the_tangents(shaken: ShakenJoystick, found: Basins) -> None:
    """The same by another method: the growth of a tangent under the monodromy matrices along the motion."""
    small = found.attractors[1]
    assert isinstance(small, UnsettledMotion)
    scales, smooth = shaken.scales[:2], shaken.smooth()
    rates = []
    for state in small.section[:12]:
        tangent, growth = np.ones(2), 0.0
        for i in range(66):
            here = smooth(state, 4.0)
            tangent = here.monodromy @ (tangent * scales) / scales
            length = float(np.linalg.norm(tangent))
            growth += math.log(length) if i >= 6 else 0.0
            tangent, state = tangent / length, here.image
        rates.append(growth / (60 * 0.25))
    error = math.hypot(float(np.std(rates, ddof=1)) / math.sqrt(len(rates)), small.exponent.error)
    assert abs(np.mean(rates) - small.exponent.value) < 4.0 * error


def test_no_period_is_claimed_for_chaos_and_its_end_of_trust_is_told(
    shaken: ShakenJoystick, found: Basins
) -> None:
    small = found.attractors[1]
    assert isinstance(small, UnsettledMotion)
    assert 0.3 < small.trusted < 4.0
    text = attractor_report(found, shaken)
    assert "| chaotic" in text
    assert text.count("periodic") == 1
    document = json.loads(response_json(shaken, found, None))
    assert [one["kind"] for one in document["attractors"]] == ["periodic", "chaotic"]


def test_the_figure_has_a_panel_for_each(shaken: ShakenJoystick, found: Basins) -> None:
    panels = plot_attractors(found, shaken).axes
    assert [panel.get_title() for panel in panels] == [
        "periodic, T: 50 % of the releases",
        "section once a period: 50 % of the releases",
    ]


def test_without_releases_there_is_nothing_to_do(shaken: ShakenJoystick) -> None:
    with pytest.raises(ParameterError, match="one or more of each"):
        basins(shaken, [])
