"""Releases in motion: a fit searches velocities of both signs, and says if the records do not tell which."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.identification import CONSTANT_DAMPING, Free, Uncertainty, fit
from pyjoystick.identification.fitting.checks.trust import check_sign
from pyjoystick.identification.fitting.solution.search import Minimum
from pyjoystick.model import NOMINAL, simulate
from pyjoystick.motion import Record
from tests.pyjoystick.identification.fitting.made import linear_problem

SETTINGS = dataclasses.replace(
    CONSTANT_DAMPING,
    free=(*CONSTANT_DAMPING.free, Free("omega_start")),
    uncertainty=Uncertainty(profiles=()),
)


def _records(omega: float, noise: float) -> list[Record]:
    """Four releases from about -20 degrees, 60 Hz, with this velocity (rad/s) at the release."""
    random = np.random.default_rng(11)
    found = []
    for number in range(4):
        time, release = np.arange(96) / 60.0, 0.1 + random.uniform(0.0, 1.0 / 60.0)
        start = math.radians(-20.0 + random.normal(0.0, 0.3))
        late = time[time > release] - release
        theta = np.full(len(time), start)
        run = simulate(NOMINAL, time=np.insert(late, 0, 0.0), theta_start=start, omega_start=omega)
        theta[time > release] = run.theta[1:]
        found.append(Record(f"run {number}", time, theta + random.normal(0.0, noise, len(time))))
    return found


@pytest.mark.parametrize("omega", [1.0, -1.0])
def test_precise_records_determine_the_sign(fmus_by_name: Path, omega: float) -> None:
    """The first search always ended at a negative velocity."""
    found = fit(_records(omega, math.radians(0.02)), SETTINGS)
    assert found.trusted, found.failed
    assert found.value("omega_start") == pytest.approx(omega, abs=4.0 * found.error("omega_start"))


def test_a_fit_of_either_sign_fails(fmus_by_name: Path) -> None:
    found = fit(_records(1.0, math.radians(0.3)), SETTINGS)
    (check,) = (one for one in found.checks if one.name == "sign")
    assert not check.passed
    assert "explains the records almost as well as" in check.message
    assert found.value("damping.C") == pytest.approx(0.045, abs=4.0 * found.error("damping.C"))


def test_only_another_sign_within_three_standard_errors_counts() -> None:
    free = (Free("omega_start", start=1.0), Free("J", start=0.3))
    variables = linear_problem([np.eye(2)], [np.ones(2)], free).variables

    def minimum(omega: float, cost: float) -> Minimum:
        return Minimum(np.array([omega, 0.3]), cost, True, "", 1)

    best = minimum(1.0, 100.0)
    for others, passed in (
        ([], True),
        ([minimum(-1.0, 108.9)], False),
        ([minimum(-1.0, 109.1)], True),
        ([minimum(2.0, 100.1)], True),
    ):
        check = check_sign(variables, [best, *others])
        assert check is not None
        assert check.passed is passed
    assert check_sign(linear_problem([np.ones((2, 1))], [np.ones(2)], free[1:]).variables, [best]) is None
