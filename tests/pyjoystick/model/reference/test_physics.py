"""The paper's statements about the joystick's motion, and the energy balance of any motion."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    ConstantDamping,
    JoystickParameters,
    Trajectory,
    angle_of_travel,
    energy,
    inverse_torque,
    simulate,
    swing_frequency,
)
from tests.pyjoystick.random_parameters import RandomCase, both_laws

RELEASE = math.radians(-20.0)
PAPER = [
    RandomCase("paper, constant", NOMINAL, RELEASE),
    RandomCase("paper, power law", NOMINAL_POWER_LAW, RELEASE),
]
#: Upside down and out of reach of the plungers, as in section 3.2.
SWING_TEST = NOMINAL.replace(
    {"g": -NOMINAL.g}
    | {f"{side}.returnSpring.x_0": 1.0 for side in ("forward", "backward")}
    | {f"{side}.balanceSpring.x_0": 2.0 for side in ("forward", "backward")}
)


@pytest.mark.parametrize("case", [*PAPER, *both_laws(5)], ids=lambda case: case.name)
def test_energy_never_rises_and_its_loss_is_the_work_of_damping(case: RandomCase) -> None:
    """Gauss's rule on either half between events and turning points, where C*omega^2 is smooth.

    Substituting time = s^2*(3 - 2*s) crowds the points at the ends, where eq. (11) is sharp.
    """
    first = simulate(case.parameters, time=[0.0, 1.5], theta_start=case.theta_start)
    corners = (
        {0.0, 1.5} | {event.time for event in first.events} | {turn.time for turn in first.turning_points}
    )
    ends = np.array(sorted(corners))
    nodes, weights = np.polynomial.legendre.leggauss(24)
    halves = np.concatenate((0.25 * (nodes + 1.0), 0.25 * (nodes + 3.0)))
    shares = 0.25 * np.concatenate((weights, weights)) * 6.0 * halves * (1.0 - halves)
    lengths = np.diff(ends)[:, np.newaxis]
    time = (ends[:-1, np.newaxis] + lengths * halves**2 * (3.0 - 2.0 * halves)).ravel()
    run = simulate(case.parameters, time=[0.0, *time, 1.5], theta_start=case.theta_start)
    lost = np.sum((run.C * run.omega**2)[1:-1] * (lengths * shares).ravel())
    assert run.E[0] - run.E[-1] == pytest.approx(lost, abs=1e-8)
    assert np.max(np.diff(run.E)) < 1e-13


def test_energy_falls_in_steps_with_plateaus_where_the_joystick_turns() -> None:
    """Fig. 12: over 2 ms around a turning point the loss is a small part of that around the middle."""
    run = simulate(NOMINAL_POWER_LAW, time=np.linspace(0.0, 0.3, 3001), theta_start=RELEASE)
    rate = -np.gradient(run.E, run.time)
    turns = [turn.time for turn in run.turning_points]
    middles = [event.time for event in run.events if event.kind == "theta = 0"]
    assert turns
    assert middles
    at_turns = np.interp(turns, run.time, rate)
    beside_middles = np.interp(np.array(middles) + 2e-3, run.time, rate)
    assert np.max(at_turns) < 0.01 * np.min(beside_middles)


@pytest.mark.parametrize("case", PAPER, ids=lambda case: case.name)
def test_the_period_falls_steadily_with_the_amplitude(case: RandomCase) -> None:
    """Section 2. Periods from one forward turning point to the next, for peaks above 0.03 rad."""
    run = simulate(case.parameters, time=[0.0, 1.0], theta_start=case.theta_start)
    forward = [turn for turn in run.turning_points if turn.theta > 0.03]
    periods, amplitudes = np.diff([turn.time for turn in forward]), [turn.theta for turn in forward]
    assert len(periods) >= 3
    assert np.all(np.diff(periods) < 0.0)
    assert np.all(np.diff(amplitudes) < 0.0)
    assert periods[-1] < 0.7 * periods[0]


@pytest.mark.parametrize("amplitude", [0.35, 0.2, 0.13, 0.1, 0.05, 0.009])
def test_the_undamped_period_is_that_of_the_energy_integral(amplitude: float) -> None:
    """T = integral of 2*dtheta/omega between the turning points, with omega from the energy."""
    parameters = dataclasses.replace(NOMINAL, damping=ConstantDamping(C=0.0))
    total = float(energy(parameters, amplitude, 0.0))
    lowest = brentq(
        lambda theta: float(energy(parameters, theta, 0.0)) - total, -0.6, -0.004, xtol=1e-16, rtol=1e-15
    )

    def time_from_middle(turn: float) -> float:
        """With theta = turn - sign*u^2 the integrand is smooth at the turning point."""
        side = math.copysign(1.0, turn)
        kinks = (parameters.forward if side > 0.0 else parameters.backward).kinks
        angles = [angle_of_travel(parameters, x) for x in kinks]
        ends = [math.sqrt(abs(turn) - angle) for angle in [0.0, *angles] if angle < abs(turn)]

        def integrand(u: float) -> float:
            theta = turn - side * u * u
            kinetic = total - float(energy(parameters, theta, 0.0))
            return 2.0 * u / math.sqrt(2.0 * kinetic / parameters.J)

        pieces = zip([*ends[1:], 0.0], ends, strict=True)
        return float(
            sum(quad(integrand, lower, upper, epsabs=1e-13, limit=200)[0] for lower, upper in pieces)
        )

    expected = 2.0 * (time_from_middle(amplitude) + time_from_middle(lowest))
    run = simulate(parameters, time=[0.0, 3.2 * expected], theta_start=amplitude)
    turns = run.turning_points
    assert len(turns) == 6
    for number, turn in enumerate(turns[1::2], start=1):
        # Close to the turning point the kinetic energy is a difference that leaves about ten digits.
        assert turn.time == pytest.approx(number * expected, rel=1e-8)
        assert turn.theta == pytest.approx(amplitude, abs=1e-11)
        assert turns[0].theta == pytest.approx(lowest, abs=1e-11)


def test_the_swing_test_gives_back_the_moment_of_inertia() -> None:
    """Section 3.2: J = m*g*h/(2*pi*f_n)^2 from the period of small swings, f_n about 1.25 Hz."""
    run = simulate(SWING_TEST.replace({"damping.C": 0.0}), time=[0.0, 10.0], theta_start=1e-3)
    turns = [turn.time for turn in run.turning_points]
    frequency = 0.5 / float(np.mean(np.diff(turns)))
    assert frequency == pytest.approx(1.25, abs=0.01)
    inertia = NOMINAL.m * NOMINAL.g * NOMINAL.h / (2.0 * math.pi * frequency) ** 2
    # The period of a swing of 1 mrad is 1 + theta^2/16 times that of a vanishing one.
    assert inertia == pytest.approx(NOMINAL.J, rel=2e-7)
    assert frequency == pytest.approx(swing_frequency(NOMINAL), rel=1e-7)


def test_gravity_at_the_stops_is_a_few_percent_of_the_accelerometers_peak() -> None:
    """Section 2: about 6 % of the peak acceleration at the handle's top, spikes of the impacts left aside."""
    run = simulate(NOMINAL, time=np.linspace(0.0, 0.5, 5001), theta_start=RELEASE)
    free_of_impacts = np.abs(run.x) > 3.1e-3
    peak = 0.266 * float(np.max(np.abs(run.alpha[free_of_impacts])))
    assert 0.03 < NOMINAL.g * math.sin(math.radians(20.0)) / peak < 0.09


def forward_and_return(parameters: JoystickParameters) -> Trajectory:
    """A torque, found from a smooth target, that moves the joystick forward and back within 0.25 s."""
    duration, reach = 0.25, 0.3

    def torque(time: float) -> float:
        phase = 2.0 * math.pi * time / duration
        theta = 0.5 * reach * (1.0 - math.cos(phase)) + 0.02
        omega = 0.5 * reach * math.sin(phase) * 2.0 * math.pi / duration
        alpha = 0.5 * reach * math.cos(phase) * (2.0 * math.pi / duration) ** 2
        return float(inverse_torque(parameters, theta, omega, alpha).T)

    return simulate(parameters, time=np.linspace(0.0, duration, 501), theta_start=0.02, torque=torque)


@pytest.mark.parametrize("parameters", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
def test_the_torque_of_eq_13_makes_the_motion_it_was_found_from(parameters: JoystickParameters) -> None:
    run = forward_and_return(parameters)
    target = 0.15 * (1.0 - np.cos(8.0 * math.pi * run.time)) + 0.02
    assert np.max(np.abs(run.theta - target)) < 1e-9
    torque = inverse_torque(parameters, run.theta, run.omega, run.alpha)
    np.testing.assert_allclose(torque.T, run.T, atol=1e-12)


def test_shares_of_the_torque_of_a_forward_and_return_motion() -> None:
    """Section 5: inertia comparable to stiffness, damping about a tenth, eq. (11) twice the constant."""
    run = forward_and_return(NOMINAL)
    constant = inverse_torque(NOMINAL, run.theta, run.omega, run.alpha)
    power_law = inverse_torque(NOMINAL_POWER_LAW, run.theta, run.omega, run.alpha)
    largest = {
        name: float(np.max(np.abs(getattr(power_law, name)))) for name in ("T", "T_inertia", "T_damping")
    }
    assert 0.2 < largest["T_inertia"] / float(np.max(np.abs(power_law.T_stiffness))) < 1.0
    assert 0.03 < largest["T_damping"] / largest["T"] < 0.2
    assert 1.3 < largest["T_damping"] / float(np.max(np.abs(constant.T_damping))) < 2.2
