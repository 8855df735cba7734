"""The reference is accurate to 1e-10 rad: it converges and agrees with a second method and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import ellipk

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, simulate
from tests.pyjoystick.random_parameters import RandomCase, both_laws
from tests.pyjoystick.taylor_method import FloatArray, TorqueSeries, taylor_motion

TIME = np.linspace(0.0, 1.5, 301)
RELEASE = math.radians(-20.0)
PAPER = [
    RandomCase("paper, constant", NOMINAL, RELEASE),
    RandomCase("paper, power law", NOMINAL_POWER_LAW, RELEASE),
]
OUT_OF_CONTACT = {
    f"{side}.{spring}.x_0": 10.0 for side in ("forward", "backward") for spring in ("returnSpring",)
} | {f"{side}.balanceSpring.x_0": 20.0 for side in ("forward", "backward")}


@pytest.mark.parametrize("case", [*PAPER, *both_laws(25)], ids=lambda case: case.name)
def test_a_hundredfold_tighter_tolerance_changes_nothing_that_counts(case: RandomCase) -> None:
    default = simulate(case.parameters, time=TIME, theta_start=case.theta_start)
    tight = simulate(case.parameters, time=TIME, theta_start=case.theta_start, tolerance=1e-15)
    assert np.max(np.abs(default.theta - tight.theta)) < 1e-11
    assert [(event.kind, event.direction) for event in default.events] == [
        (event.kind, event.direction) for event in tight.events
    ]
    # Slow passages are the worst: a time is as good as the angle divided by omega.
    for event, precise in zip(default.events, tight.events, strict=True):
        assert abs(event.time - precise.time) * abs(event.omega) < 1e-11


@pytest.mark.parametrize("case", PAPER, ids=lambda case: case.name)
def test_the_error_falls_with_the_tolerance(case: RandomCase) -> None:
    """After 1.5 s it is at most a few hundred times the tolerance of a step (measured: 82 times)."""
    finest = simulate(case.parameters, time=TIME, theta_start=RELEASE, tolerance=1e-15)
    for tolerance in (1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13):
        run = simulate(case.parameters, time=TIME, theta_start=RELEASE, tolerance=tolerance)
        assert np.max(np.abs(run.theta - finest.theta)) < 300.0 * tolerance
    coarse = simulate(case.parameters, time=TIME, theta_start=RELEASE, tolerance=1e-6)
    assert np.max(np.abs(coarse.theta - finest.theta)) > 1e-9


@pytest.mark.parametrize("case", [*PAPER, *both_laws(3)], ids=lambda case: case.name)
def test_taylor_series_give_the_same_motion_and_events(case: RandomCase) -> None:
    run = simulate(case.parameters, time=TIME, theta_start=case.theta_start)
    other = taylor_motion(case.parameters, TIME, case.theta_start)
    assert np.max(np.abs(run.theta - other.theta)) < 1e-11
    assert np.max(np.abs(run.omega - other.omega)) < 1e-9
    assert len(run.events) == len(other.passages)
    for event, (time, theta) in zip(run.events, other.passages, strict=True):
        assert event.theta == pytest.approx(theta, rel=1e-12)
        assert abs(event.time - time) * abs(event.omega) < 1e-11


def sine_series(amplitude: float, rate: float) -> TorqueSeries:
    def coefficients(time: float, order: int) -> FloatArray:
        n = np.arange(order + 1)
        factorials = np.array([float(math.factorial(i)) for i in n])
        return np.asarray(amplitude * np.sin(rate * time + n * math.pi / 2.0) * rate**n / factorials)

    return coefficients


@pytest.mark.parametrize("parameters", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
@pytest.mark.parametrize("rate", [5.0, 60.0])
def test_taylor_series_give_the_same_forced_motion(parameters: JoystickParameters, rate: float) -> None:
    """The joystick is pushed out of the middle, where it rests, and back."""
    time = TIME[:201]
    run = simulate(parameters, time=time, theta_start=0.0, torque=lambda t: 2.0 * math.sin(rate * t))
    other = taylor_motion(parameters, time, 0.0, 1e-300, sine_series(2.0, rate))
    assert np.max(np.abs(run.theta)) > 0.01
    assert np.max(np.abs(run.theta - other.theta)) < 1e-10
    assert len(run.events) == len(other.passages)


def test_a_pendulum_out_of_contact_has_the_period_of_the_elliptic_integral() -> None:
    """Upside down, undamped, without contact: T = 4*K(sin(theta_0/2))/omega_0, theta_0 = 1 rad."""
    pendulum = NOMINAL.replace(OUT_OF_CONTACT | {"g": -NOMINAL.g, "damping.C": 0.0})
    run = simulate(pendulum, time=[0.0, 5.0], theta_start=1.0)
    rate = math.sqrt(pendulum.m * NOMINAL.g * pendulum.h / pendulum.J)
    period = 4.0 * float(ellipk(math.sin(0.5) ** 2)) / rate
    turns = np.array([point.time for point in run.turning_points])
    np.testing.assert_allclose(turns, 0.5 * period * np.arange(1, len(turns) + 1), rtol=1e-12)
    assert len(turns) == int(5.0 / (0.5 * period))


def test_a_small_swing_decays_as_the_linear_oscillator() -> None:
    """No clearance and no preload leave one spring a side: J*theta'' + C*theta' + (k*a^2 - m*g*h)*theta = 0.

    Equal springs on both sides; at 1e-5 rad the cam's quadratic terms, b*theta^2/2 against a*theta, are left
    out by b = 0, and its cubic ones are 1e-10 of the rest.
    """
    changes = {"b": 0.0, "damping.C": 0.05}
    for side in ("forward", "backward"):
        changes |= {
            f"{side}.returnSpring.{name}": value for name, value in (("x_0", 0.0), ("F_0", 0.0), ("k_s", 2e3))
        }
    parameters = NOMINAL.replace(changes)
    run = simulate(parameters, time=TIME, theta_start=1e-5, omega_start=2e-5)
    decay = 0.05 / (2.0 * parameters.J)
    stiffness = 2e3 * parameters.a**2 - parameters.m * parameters.g * parameters.h
    rate = math.sqrt(stiffness / parameters.J - decay**2)
    sine = (2e-5 + decay * 1e-5) / rate
    exact = np.exp(-decay * TIME) * (1e-5 * np.cos(rate * TIME) + sine * np.sin(rate * TIME))
    assert np.max(np.abs(run.theta - exact)) < 1e-14
    # Passing the middle passes four kinks at once: x_0 and x_1 of both sides.
    passages = sorted({event.time for event in run.events})
    assert len(run.events) == 5 * len(passages)
    zeros = (np.arange(len(passages)) * math.pi + math.atan2(-1e-5, sine) + math.pi) / rate
    np.testing.assert_allclose(passages, zeros, rtol=1e-9)


def test_an_undamped_motion_can_be_run_backwards() -> None:
    parameters = NOMINAL.replace({"damping.C": 0.0})
    there = simulate(parameters, time=[0.0, 1.0], theta_start=0.3, omega_start=1.0)
    back = simulate(parameters, time=[0.0, 1.0], theta_start=there.theta[-1], omega_start=-there.omega[-1])
    assert back.theta[-1] == pytest.approx(0.3, abs=1e-11)
    assert back.omega[-1] == pytest.approx(-1.0, abs=1e-9)
    assert [event.kind for event in back.events] == [event.kind for event in reversed(there.events)]
