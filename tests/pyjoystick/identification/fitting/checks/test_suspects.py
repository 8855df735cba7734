"""Each suspect is found, by name and size, if it is the only thing that the model lacks."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from pyjoystick.fmu import Fmu, find_fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    Measurement,
    Uncertainty,
    driven,
    fit,
    read_records,
    scaled_forces,
)
from pyjoystick.identification.fitting.checks.residual_view import ResidualView
from pyjoystick.identification.fitting.checks.score_test import Finding, score_test, significant
from pyjoystick.identification.fitting.checks.suspect import beyond
from pyjoystick.identification.fitting.checks.suspects import suspects
from pyjoystick.identification.fitting.problem.difference_steps import choose_steps
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.identification.fitting.solution.search import search
from pyjoystick.model import NOMINAL, JoystickParameters, PowerLawDamping, simulate
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray

DRIVEN = Path(__file__).parents[5] / "scenarios" / "data" / "synthetic_driven_1.csv"
RATE = 120.0
RELEASE = 0.1037
ANGLES = tuple(math.radians(one) for one in (-20.0, -12.0, 15.0))
NOISE = math.radians(0.1)
STRONGER = scaled_forces(NOMINAL, 1.002)


def _records(
    joystick: JoystickParameters, *, omega: float = 0.0, clock: float = 1.0, rate: float = RATE
) -> list[Record]:
    """Releases without noise, sampled by a clock that runs so fast, perhaps already moving at the release."""
    time = np.arange(rate) / rate
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
    """What would explain what is left over of a fit that knows nothing of the cause."""
    settings = dataclasses.replace(CONSTANT_DAMPING, tolerance=1e-10)
    with Fmu(find_fmu("Joystick")) as fmu:
        problem = make_problem(records, settings, fmu)
        true = {"damping.C": lambda k: 0.045, "theta_start": ANGLES.__getitem__, "zero_offset": lambda k: 0.0}
        x = np.array(
            [true.get(one.name, lambda k: RELEASE)(one.record or 0) for one in problem.variables.free]
        )
        problem = problem.with_weights(tuple(np.full(len(one.time), 1.0 / NOISE) for one in records))
        problem = dataclasses.replace(problem, steps=choose_steps(problem.model, x).steps)
        best = search(problem, x, evaluations=30, central=True).x
        view = ResidualView(problem, best)
        return score_test(problem, view.residuals, view.jacobian, suspects(problem, best))


def _smoothed() -> list[Record]:
    """Filtered as an instrument does that samples fast, and then recorded at the usual rate."""
    low_pass = butter(4, 13.0, fs=10.0 * RATE, output="sos")
    return [
        dataclasses.replace(
            one, time=one.time[::10], theta=sosfiltfilt(low_pass, one.theta)[::10], rows=one.rows[::10]
        )
        for one in _records(NOMINAL, rate=10.0 * RATE)
    ]


def _loose(play: float) -> list[Record]:
    """Seen by a sensor that moves on only when the handle has crossed the play."""
    found = []
    for one in _records(NOMINAL, rate=10.0 * RATE):
        ends = [one.theta[0] - play / 2, one.theta[0] + play / 2]
        shown = np.empty_like(one.theta)
        for k, theta in enumerate(one.theta):
            # The play moves along with the handle only at its ends.
            if theta > ends[1]:
                ends = [theta - play, theta]
            elif theta < ends[0]:
                ends = [theta, theta + play]
            shown[k] = sum(ends) / 2
        found.append(dataclasses.replace(one, time=one.time[::10], theta=shown[::10], rows=one.rows[::10]))
    return found


def _of_two_joysticks() -> list[Record]:
    """The second record is of a joystick with another C."""
    found = _records(NOMINAL)
    return [found[0], _other(damping__C=0.0451)[1], found[2]]


def _stopped(limit: float, stiffness: float) -> list[Record]:
    """Releases with a moment beside that of the springs: that of a stop along the motion without it."""
    found = []
    for one in _records(NOMINAL):
        late = np.insert(one.time[one.time > RELEASE] - RELEASE, 0, 0.0)
        fine = np.linspace(0.0, late[-1], 5000)
        alone = simulate(NOMINAL, time=fine, theta_start=one.theta[0]).theta
        moment = stiffness * np.maximum(limit - alone, 0.0)
        run = simulate(
            NOMINAL,
            time=late,
            theta_start=one.theta[0],
            torque=lambda t, fine=fine, moment=moment: float(np.interp(t, fine, moment)),
        )
        theta = one.theta.copy()
        theta[one.time > RELEASE] = run.theta[1:]
        found.append(dataclasses.replace(one, theta=theta))
    return found


def _other(**changes: float) -> list[Record]:
    return _records(NOMINAL.replace({name.replace("__", "."): value for name, value in changes.items()}))


_LAW = PowerLawDamping(alpha=1.0, A_pos=0.0451, A_neg=0.0449, n_pos=0.0, n_neg=0.0, B=0.0, m=0.0)
_CLIPPED = -0.75 * math.radians(20.0)


# The sizes are those of the causes. A moment of inertia and a time base do nearly the same.
@pytest.mark.parametrize(
    ("make", "name", "size"),
    [
        (
            lambda: _records(scaled_forces(NOMINAL, 1.002)),
            "another scale of all forces of the springs",
            "+0.2 %",
        ),
        (lambda: _other(friction__T_c=1e-3), "dry friction at the pivot", "T_c about 0.00099 N m"),
        (lambda: _other(friction__F_c=0.2), "dry friction at the plungers", "F_c about 0.19 N"),
        (lambda: _other(J=1.0002 * NOMINAL.J), "another moment of inertia", "J +0.02 %"),
        (
            lambda: _other(forward__returnSpring__F_0=1.0005 * 52.7808125),
            "other preloads or stiffnesses of the return springs",
            "forward.returnSpring.F_0 +0.049 %, forward.returnSpring.k_s +0.0021 %, "
            "backward.returnSpring.F_0 +0.00034 %, backward.returnSpring.k_s -0.0039 %",
        ),
        (
            lambda: _records(dataclasses.replace(NOMINAL, damping=_LAW)),
            "a damping coefficient that depends on the angle, its side or the speed otherwise",
            "",
        ),
        (lambda: _other(m=1.01 * NOMINAL.m), "another mass", "m +1 %"),
        (lambda: _records(NOMINAL, clock=1.0002), "an error of the time base", "+0.02 %"),
        (
            lambda: _records(NOMINAL, omega=0.5),
            "motion at the instant of release",
            "about 0.52 rad/s, of either sign",
        ),
        (lambda: _shown(lambda theta: 1.001 * theta), "an error of the angle's scale", "+0.1 %"),
        (lambda: _shown(lambda theta: np.maximum(theta, _CLIPPED)), "clipping", "at about -16 deg"),
        (_smoothed, "a low-pass filter", "-3 dB near 13 Hz"),
        (lambda: _stopped(_CLIPPED, 0.1), "a stop", "at about -15 deg"),
        (lambda: _loose(math.radians(0.06)), "backlash of the sensor", "about 0.06 deg of play"),
        (lambda: _loose(math.radians(0.2)), "backlash of the sensor", "about 0.2 deg of play"),
        (_of_two_joysticks, "records that differ in damping.C", "0.04501 in run 0, 0.0451 in run 1"),
    ],
)
def test_the_cause_is_named_with_its_size(
    fmus_by_name: Path, make: Callable[[], list[Record]], name: str, size: str
) -> None:
    findings = _findings(make())
    (found,) = (one for one in findings if one.name == name)
    best = max(one.explained for one in findings)
    assert found.size == size
    assert found.explained > 0.9
    assert found.explained >= best - 1e-3
    assert found in significant(findings, 1e-6)


@pytest.mark.parametrize("is_known", [True, False])
def test_the_clock_of_a_driven_record(fmus_by_name: Path, is_known: bool) -> None:
    """A clock that is off is named if J is known; J, C and the delay together imitate it exactly."""
    settings = driven(CONSTANT_DAMPING)
    if is_known:
        settings = dataclasses.replace(settings, free=tuple(one for one in settings.free if one.name != "J"))
    with Fmu(find_fmu("Joystick")) as fmu:
        (record,) = read_records([DRIVEN], settings, fmu.description)
        assert isinstance(record, Measurement)
        late = Measurement(record.name, 1.002 * record.time, record.columns)
        found = fit([late], settings, fmu=fmu)
    (check,) = (one for one in found.checks if one.name == "missing physics")
    assert check.passed is not is_known
    assert ("could make up for an error of the time base" in check.message) is not is_known
    assert ("an error of the time base (-0.2" in check.message) is is_known
    if not is_known:
        assert found.value("J") == pytest.approx(1.002**2 * NOMINAL.J, rel=1e-4)


def test_the_mass_of_a_driven_record(fmus_by_name: Path) -> None:
    """To first order, other springs would explain more than the mass that the fit takes as 10 % too large."""
    settings = driven(CONSTANT_DAMPING)
    settings = dataclasses.replace(settings, fixed={**settings.fixed, "m": 1.1 * NOMINAL.m})
    with Fmu(find_fmu("Joystick")) as fmu:
        found = fit(read_records([DRIVEN], settings, fmu.description), settings, fmu=fmu)
    (check,) = (one for one in found.checks if one.name == "missing physics")
    assert "not noise: another mass (m -9.1 %) would explain them best" in check.message


def test_what_shows_too_much_is_not_clipped(fmus_by_name: Path) -> None:
    """Angles beyond a limit that are a fifth larger than the motion: clipping of a negative size."""
    findings = _findings(_shown(lambda theta: theta + 0.2 * beyond(theta, _CLIPPED)))
    (clipping,) = (one for one in findings if one.name == "clipping")
    # The other side explains a tenth, because the fit follows the side that is wrong.
    assert not clipping.size.startswith("at about -")
    assert clipping.explained < 0.2


def test_noise_alone_points_at_nothing(fmus_by_name: Path) -> None:
    """The chance counts as often as there are suspects that explain anything, but for the usual ones."""
    random = np.random.default_rng(4)
    findings = _findings(_shown(lambda theta: theta + NOISE * random.standard_normal(len(theta))))
    assert significant(findings, 1e-2) == []
    tried = [one for one in findings if one.explained > 0.0]
    usual = [one.chance / 2.0 for one in tried if one.usual]
    others = [one.chance for one in tried if not one.usual]
    assert len(others) > 3
    least = min([*usual, min(others) * len(others)])
    assert significant(findings, 0.99 * least) == []
    assert len(significant(findings, 1.01 * least)) == 1


@pytest.mark.parametrize(("friction", "least", "most"), [(2.0e-3, 0.01, 0.02), (2.14e-3, 0.005, 0.01)])
def test_a_sound_fit_is_doubted_once_in_a_hundred(
    fmus_by_name: Path, friction: float, least: float, most: float
) -> None:
    """As often for dry friction alone: where noise of its sign explains as much in less than 1 %."""
    random = np.random.default_rng(4)
    records = [
        dataclasses.replace(one, theta=one.theta + NOISE * random.standard_normal(len(one.theta)))
        for one in _other(friction__T_c=friction)
    ]
    assert least < min(one.chance / 2.0 for one in _findings(records) if one.usual) < most
    found = fit(records, dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=())))
    (check,) = (one for one in found.checks if one.name == "missing physics")
    assert check.passed == (least >= 0.01)
