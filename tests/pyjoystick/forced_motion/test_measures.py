"""Peaks, work and shares; mainly that the work of the hand equals energy change and loss."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from pyjoystick.forced_motion import (
    ForwardAndReturn,
    Samples,
    Shape,
    TorqueMeasures,
    measure,
    smooth_spans,
    torque_by_fmu,
    torque_by_reference,
)
from pyjoystick.model import (
    NOMINAL,
    PIVOT_TO_TOP,
    ConstantDamping,
    JoystickParameters,
    energy,
    inverse_torque,
)
from pyjoystick.support import ParameterError
from tests.pyjoystick.forced_motion.cases import JOYSTICKS, MOTIONS

BALANCE = 1e-8  # J


def _sine(rate: float, amplitude: float, frequency: float) -> Samples:
    """1.6 s of a sine with exact derivatives."""
    turn = 2.0 * np.pi * frequency
    time = np.arange(round(1.6 * rate) + 1) / rate
    theta = amplitude * np.sin(turn * time)
    return Samples.trapezoidal(time, theta, amplitude * turn * np.cos(turn * time), -(turn**2) * theta)


@pytest.mark.parametrize(
    ("rate", "amplitude", "frequency"), [(100.0, 0.25, 1.3), (60.0, 0.2, 2.5), (60.0, 0.3, 0.8)]
)
@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
def test_the_work_of_coarse_samples(
    joystick: JoystickParameters, rate: float, amplitude: float, frequency: float
) -> None:
    """The preload, which sets in between two samples, counts with the angle at which it does."""
    coarse = _sine(rate, amplitude, frequency).refined(joystick)
    found = measure(joystick, coarse, torque_by_reference(joystick, coarse))
    fine = _sine(3200.0 * rate, amplitude, frequency)
    exact = measure(joystick, fine, torque_by_reference(joystick, fine))
    assert coarse.duration == pytest.approx(np.sum(coarse.weights), rel=1e-12)
    for name in ("work", "positive_work", "negative_work", "loss"):
        assert getattr(found, name) == pytest.approx(getattr(exact, name), rel=3e-3, abs=3e-4)
    assert found.work == pytest.approx(found.loss + found.energy_change, abs=1e-4)
    assert found.total.rms == pytest.approx(exact.total.rms, rel=2e-3)


def test_refined_samples_stay_within_the_stops() -> None:
    joystick = NOMINAL.replace({"stops.theta_stop": 0.2})
    samples = _sine(60.0, 0.2, 2.5).refined(joystick)
    assert np.abs(samples.theta).max() == 0.2


def _measured(motion: ForwardAndReturn, joystick: JoystickParameters) -> TorqueMeasures:
    samples = Samples.of(joystick, motion)
    return measure(joystick, samples, torque_by_reference(joystick, samples))


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_work_is_energy_change_and_loss_up_to_any_instant(
    motion: ForwardAndReturn, joystick: JoystickParameters
) -> None:
    """From the FMU's torque, at every end of a smooth span; the energy is the reference's own."""
    samples = Samples.of(joystick, motion)
    torque = torque_by_fmu(joystick, samples)
    work = np.cumsum(torque["T"].to_numpy() * samples.omega * samples.weights)
    loss = np.cumsum(torque["T_damping"].to_numpy() * samples.omega * samples.weights)
    stored = energy(joystick, samples.theta, samples.omega)
    ends = np.isin(samples.time, smooth_spans(joystick, motion))
    balance = work - loss - (stored - stored[0])
    assert np.count_nonzero(ends) >= 20
    assert np.abs(balance[ends]).max() < BALANCE
    assert stored.max() > 0.3  # J: the balance is not one of nothings
    assert loss[-1] > 0.03


@pytest.mark.parametrize(
    ("shape", "square"),
    [("minimum-jerk", 10.0 / 7.0), ("raised-cosine", math.pi**2 / 8.0), ("trapezoid", 5.0 / 4.0)],
)
def test_the_loss_in_closed_form(shape: Shape, square: float) -> None:
    """C times the integral of omega^2, which is a pure number of the shape times amplitude^2/time."""
    motion = ForwardAndReturn(amplitude=0.3, rise=0.15, fall=0.25, shape=shape)
    found = _measured(motion, NOMINAL)
    assert isinstance(NOMINAL.damping, ConstantDamping)
    expected = NOMINAL.damping.C * square * 0.3**2 * (1.0 / 0.15 + 1.0 / 0.25)
    assert found.loss == pytest.approx(expected, rel=1e-13)
    assert found.work == pytest.approx(expected, rel=1e-12)
    assert found.energy_change == 0.0


@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
def test_integrals_against_adaptive_quadrature(joystick: JoystickParameters) -> None:
    """SciPy's quad, span by span; the kinks of max(P, 0) cost the fixed nodes some digits."""
    motion = ForwardAndReturn(amplitude=0.3, rise=0.12)

    def at(time: float, column: str) -> float:
        now = motion.at(time)
        return float(getattr(inverse_torque(joystick, now.theta, now.omega, now.alpha), column))

    def integral(of: str) -> float:
        spans = smooth_spans(joystick, motion)
        functions = {
            "positive work": lambda t: max(0.0, at(t, "T") * float(motion.at(t).omega)),
            "impulse": lambda t: abs(at(t, "T")),
            "square": lambda t: at(t, "T") ** 2,
        }
        parts = [
            quad(functions[of], a, b, limit=200, epsabs=1e-10, epsrel=1e-8)[0] for a, b in pairwise(spans)
        ]
        return math.fsum(parts)

    found = _measured(motion, joystick)
    assert found.positive_work == pytest.approx(integral("positive work"), rel=1e-5)
    assert found.total.impulse == pytest.approx(integral("impulse"), rel=1e-4)
    assert found.total.rms**2 * found.duration == pytest.approx(integral("square"), rel=1e-7)
    assert found.positive_work + found.negative_work == pytest.approx(found.work, abs=1e-14)


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_shares_add_up_and_peaks_are_peaks(motion: ForwardAndReturn) -> None:
    found = _measured(motion, NOMINAL)
    assert math.fsum(part.share for part in found.parts.values()) == pytest.approx(1.0, rel=1e-14)
    assert math.fsum(part.work for part in found.parts.values()) == pytest.approx(found.work, abs=1e-14)
    # The samples are a hundredth of a smooth span apart: a peak between two of them is missed by less.
    torque = torque_by_reference(NOMINAL, Samples.evenly(motion, 1e-5))
    assert found.total.highest == pytest.approx(torque["T"].max(), rel=1e-4)
    assert found.total.lowest == pytest.approx(torque["T"].min(), rel=1e-4)
    assert found.peak_force == found.total.peak / PIVOT_TO_TOP
    assert found.peak_ratio("damping") == found.parts["damping"].peak / found.total.peak
    assert found.peak_ratio("inertia", "stiffness") < 1.0


def test_the_paper_statements_hold_for_quick_strokes() -> None:
    """Section 5: inertia comparable to stiffness, damping about 10 %, eq. (11)'s damping about double.

    For 20 degrees in 0.12 s: 0.7, 8 % with constant damping and 13 % with eq. (11), 1.6 times and not double.
    """
    motion = ForwardAndReturn(amplitude=math.radians(20.0), rise=0.12)
    constant, power = (_measured(motion, joystick) for joystick in JOYSTICKS.values())
    assert 0.6 < constant.peak_ratio("inertia", "stiffness") < 0.75
    assert 0.07 < constant.peak_ratio("damping") < 0.09
    assert 0.11 < power.peak_ratio("damping") < 0.14
    assert 1.5 < power.parts["damping"].peak / constant.parts["damping"].peak < 1.65


def test_rest_has_no_shares() -> None:
    still = Samples.trapezoidal(np.arange(3.0), np.zeros(3), np.zeros(3), np.zeros(3))
    found = measure(NOMINAL, still, torque_by_reference(NOMINAL, still))
    assert (found.total.peak, found.total.share, found.work) == (0.0, 0.0, 0.0)
    with pytest.raises(ParameterError, match="pivot_to_handle"):
        measure(NOMINAL, still, torque_by_reference(NOMINAL, still), pivot_to_handle=-1.0)
