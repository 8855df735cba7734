"""The period by quadrature against undamped simulations."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.model import (
    NOMINAL,
    JoystickParameters,
    NoOscillationError,
    angle_of_travel,
    energy,
    simulate,
    undamped_oscillation,
)
from pyjoystick.motion import find_peaks
from pyjoystick.runs import free_oscillation
from pyjoystick.support import ParameterError
from tests.pyjoystick.random_parameters import RandomCase, random_cases

UNDAMPED = NOMINAL.replace({"damping.C": 0.0})
#: From 0.3 to 20 degrees, each kink of Table 1 from either side of it among them.
KINKS = [
    math.degrees(angle_of_travel(NOMINAL, x)) * factor
    for x in (*NOMINAL.forward.kinks[1:], *NOMINAL.backward.kinks[1:])
    for factor in (1.0 - 1e-6, 1.0 + 1e-6)
]
AMPLITUDES = [0.3, 0.45, 0.6, 1.0, 2.0, 5.0, 7.2, 7.5, 10.0, 15.0, 20.0]


def _simulated(parameters: JoystickParameters, release: float, expected: float) -> float:
    """When the reference comes back to the side of its release (s)."""
    run = simulate(parameters, time=[0.0, 1.3 * expected], theta_start=release)
    return run.turning_points[1].time


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("degrees", [*AMPLITUDES, *KINKS])
def test_the_reference_takes_as_long(degrees: float, side: float) -> None:
    release = math.radians(side * degrees)
    found = undamped_oscillation(UNDAMPED, release)
    # Asked for are 1e-6; both are good to rounding.
    assert _simulated(UNDAMPED, release, found.period) == pytest.approx(found.period, rel=1e-11)
    assert found.error < 1e-11 * found.period


def test_the_fmu_takes_as_long(fmus_by_name: Path) -> None:
    with Fmu("Joystick") as fmu:
        for degrees in (sign * size for size in AMPLITUDES for sign in (1.0, -1.0)):
            release = math.radians(degrees)
            period = undamped_oscillation(NOMINAL, release).period
            run = free_oscillation(
                release,
                fmu=fmu,
                parameters=UNDAMPED,
                duration=1.2 * period,
                output_interval=1e-3 * period,
                tolerance=1e-12,
            )
            peaks = find_peaks(run.index, run["theta"], run["omega"])
            assert peaks["time"].iloc[1] == pytest.approx(period, rel=1e-9), degrees


@pytest.mark.parametrize("case", random_cases(NOMINAL), ids=lambda case: case.name)
def test_other_joysticks(case: RandomCase) -> None:
    undamped = case.parameters.replace({"damping.C": 0.0})
    found = undamped_oscillation(undamped, case.theta_start)
    assert _simulated(undamped, case.theta_start, found.period) == pytest.approx(found.period, rel=1e-10)


def test_both_turning_points_have_the_same_energy() -> None:
    found = undamped_oscillation(NOMINAL, math.radians(-20.0))
    assert found.backward == math.radians(20.0)
    both = energy(NOMINAL, [found.forward, -found.backward], 0.0)
    assert both[0] == pytest.approx(both[1], rel=1e-13)


def test_the_spans_cover_the_path_once() -> None:
    found = undamped_oscillation(NOMINAL, math.radians(20.0))
    for side, reach in (("forward", found.forward), ("backward", found.backward)):
        spans = sorted((span for span in found.spans if span.side == side), key=lambda span: span.inner)
        assert [span.segment for span in spans] == [0, 1, 2, 3, 4]
        assert spans[0].inner == 0.0
        assert spans[-1].outer == reach
        assert [span.outer for span in spans[:-1]] == [span.inner for span in spans[1:]]
    assert sum(found.share(segment) for segment in range(5)) == pytest.approx(1.0, rel=1e-14)


def test_in_the_clearance_the_weight_keeps_it_from_the_middle() -> None:
    with pytest.raises(NoOscillationError, match=r"release at 0\.0017.*its weight does not let it rise"):
        undamped_oscillation(NOMINAL, math.radians(0.1))
    # Upside down there is nothing in the way: the period is that of a pendulum, but for springs.
    hanging = NOMINAL.replace({"g": -9.80665})
    swing = 2.0 * math.pi * math.sqrt(hanging.J / (hanging.m * 9.80665 * hanging.h))
    period = undamped_oscillation(hanging, math.radians(0.1)).period
    # The large-angle correction is theta^2/16.
    assert period == pytest.approx(swing * (1.0 + math.radians(0.1) ** 2 / 16.0), rel=1e-11)


def test_a_joystick_that_falls_over_does_not_oscillate() -> None:
    springs = (
        "forward.returnSpring",
        "forward.balanceSpring",
        "backward.returnSpring",
        "backward.balanceSpring",
    )
    weak = NOMINAL.replace({f"{spring}.{name}": 1.0 for spring in springs for name in ("k_s", "F_0")})
    with pytest.raises(NoOscillationError):
        undamped_oscillation(weak, math.radians(20.0))


@pytest.mark.parametrize("release", [0.0, math.pi / 2.0, math.nan])
def test_what_is_no_release_is_refused(release: float) -> None:
    with pytest.raises(ParameterError, match="release_angle"):
        undamped_oscillation(NOMINAL, release)


def test_the_limit_of_no_amplitude_is_reached_from_above() -> None:
    """Toward the angle at which the energy is that of the middle, the period grows without bound."""
    releases = np.radians([0.2, 0.19, 0.1895])
    periods = [undamped_oscillation(NOMINAL, release).period for release in releases]
    assert periods == sorted(periods)
    assert periods[-1] > 1.0


def test_the_powers_of_the_page() -> None:
    """docs/period.md: the local slope of ln(period) over ln(release angle), to the last digit."""
    page = Path(__file__).parents[4] / "docs" / "period.md"
    rows = re.findall(r"^\| (-[\d.]+) \|.*\| (-?[\d.]+) \|$", page.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(rows) == 7
    for angle, power in rows:
        change = 1e-4
        ends = [
            undamped_oscillation(NOMINAL, math.radians(float(angle) * math.exp(one))).period
            for one in (-change, change)
        ]
        assert math.log(ends[1] / ends[0]) / (2.0 * change) == pytest.approx(float(power), abs=0.0051)
