"""Each suspect is found, by name and size, where it is the only thing that the model lacks."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from pyjoystick.fmu import Fmu, find_fmu
from pyjoystick.identification import CONSTANT_DAMPING
from pyjoystick.identification.fitting.checks.residual_view import ResidualView
from pyjoystick.identification.fitting.checks.score_test import Finding, score_test, significant
from pyjoystick.identification.fitting.checks.suspects import suspects
from pyjoystick.identification.fitting.fit import make_problem
from pyjoystick.identification.fitting.problem.least_squares import choose_steps
from pyjoystick.model import NOMINAL, JoystickParameters, PowerLawDamping, simulate
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray

RATE = 120.0
RELEASE = 0.1037
ANGLES = tuple(math.radians(one) for one in (-20.0, -12.0, 15.0))
NOISE = math.radians(0.1)


def _records(joystick: JoystickParameters, *, omega: float = 0.0, clock: float = 1.0) -> list[Record]:
    """Releases without noise, sampled by a clock that runs so fast, perhaps already moving at the release."""
    time = np.arange(180) / RATE
    late = clock * (time - RELEASE)
    found = []
    for number, start in enumerate(ANGLES):
        theta = np.full(len(time), start)
        run = simulate(
            joystick,
            time=np.insert(late[late > 0.0], 0, 0.0),
            theta_start=start,
            omega_start=-math.copysign(omega, start),
        )
        theta[late > 0.0] = run.theta[1:]
        found.append(Record(f"run {number}", time, theta))
    return found


def _shown(change: Callable[[FloatArray], FloatArray]) -> list[Record]:
    """The records of the nominal joystick with other angles."""
    return [dataclasses.replace(one, theta=change(one.theta)) for one in _records(NOMINAL)]


def _findings(records: list[Record]) -> list[Finding]:
    """What would explain the difference to a nominal joystick, at the true values of all that is fitted."""
    settings = dataclasses.replace(CONSTANT_DAMPING, tolerance=1e-10)
    with Fmu(find_fmu("Joystick")) as fmu:
        problem = make_problem(records, settings, fmu)
        true = {"damping.C": lambda k: 0.045, "theta_start": ANGLES.__getitem__, "zero_offset": lambda k: 0.0}
        x = np.array(
            [true.get(one.name, lambda k: RELEASE)(one.record or 0) for one in problem.variables.free]
        )
        problem.weights = [np.full(len(one.time), 1.0 / NOISE) for one in records]
        problem.steps = choose_steps(problem, x).steps
        view = ResidualView(problem, x)
        return score_test(problem, view.residuals, view.jacobian, suspects(problem, x))


def _smoothed(theta: FloatArray) -> FloatArray:
    return np.asarray(sosfiltfilt(butter(4, 13.0, fs=RATE, output="sos"), theta))


# The sizes follow from the causes; small ones, because the test is of the first order.
@pytest.mark.parametrize(
    ("records", "name", "size"),
    [
        (
            _records(NOMINAL.replace({"friction.T_c": 2e-4})),
            "dry friction at the pivot",
            "T_c about 0.0002 N m",
        ),
        (
            _records(NOMINAL.replace({"friction.F_c": 0.01})),
            "dry friction at the plungers",
            "F_c about 0.01 N",
        ),
        (_records(NOMINAL.replace({"J": 1.0002 * NOMINAL.J})), "another moment of inertia", "J +0.02 %"),
        (
            _records(NOMINAL.replace({"forward.returnSpring.F_0": 1.0005 * 52.7808125})),
            "other preloads or stiffnesses of the return springs",
            "",
        ),
        (
            _records(
                dataclasses.replace(
                    NOMINAL,
                    damping=PowerLawDamping(
                        alpha=1.0, A_pos=0.046, A_neg=0.044, n_pos=0.0, n_neg=0.0, B=0.0, m=0.0
                    ),
                )
            ),
            "a damping coefficient that depends on the angle, its side or the speed otherwise",
            "",
        ),
        (_records(NOMINAL, clock=1.0002), "an error of the time base", "+0.02 %"),
        (_records(NOMINAL, omega=0.3), "motion at the instant of release", "about 0.3 rad/s"),
        (_shown(lambda theta: 1.001 * theta), "an error of the angle's scale", "+0.1 %"),
        (_shown(lambda theta: np.maximum(theta, -0.75 * math.radians(20.0))), "clipping", "at about -15 deg"),
        (_shown(_smoothed), "a low-pass filter", "-3 dB near 13 Hz"),
    ],
    ids=lambda one: one.replace(" ", "-")[:30] if isinstance(one, str) else "",
)
def test_the_cause_is_named_with_its_size(
    fmus_by_name: Path, records: list[Record], name: str, size: str
) -> None:
    best, *others = _findings(records)
    assert (best.name, best.size) == (name, size)
    # What else explains a part of it explains clearly less.
    assert best.explained > 0.9
    assert all(one.explained < best.explained for one in others)


def test_noise_alone_points_at_nothing(fmus_by_name: Path) -> None:
    """At a level of 1e-2, and at that of a tenth of the findings' number or more, something."""
    random = np.random.default_rng(4)
    records = _shown(lambda theta: theta + NOISE * random.standard_normal(len(theta)))
    findings = _findings(records)
    assert significant(findings, 1e-2) == []
    tried = [one for one in findings if one.explained > 0.0]
    assert significant(findings, 1.01 * min(one.chance for one in tried) * len(tried))
