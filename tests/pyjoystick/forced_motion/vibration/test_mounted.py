"""Vibration feedthrough: against the closed form of small motions, and large ones against small ones."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu, UnsupportedFmuError
from pyjoystick.forced_motion import Direction, Hand, MountedHandle, plot_transmissibility
from pyjoystick.forced_motion.sine import sine_table
from pyjoystick.model import NOMINAL, ConstantDamping, JoystickParameters, contact_moment
from pyjoystick.support import ParameterError

HELD = math.radians(10.0)
FREQUENCIES = np.array([0.5, 2.0, 2.5, 4.0, 15.0])
TOP = 0.266
HANDS = [None, Hand(), Hand(stiffness=8.0, damping=0.1, mass=0.6, distance=0.25)]


@pytest.fixture(scope="module")
def mounted(joystick_fmus: Path) -> Iterator[Fmu]:
    with Fmu(joystick_fmus / "MountedJoystick.fmu") as fmu:
        yield fmu


def _closed_form(
    joystick: JoystickParameters, hand: Hand | None, direction: Direction = Direction.HORIZONTAL
) -> np.ndarray:
    """Theta over the base's acceleration: J*theta'' + (C + D)*theta' + (k + K - m*g*h*cos(held))*theta = M.

    M is -m*h*cos(held)*a, m*h*sin(held)*a, or with the base at phi = -a/omega^2 from upright the difference
    that this makes to the weight's moment m*g*h*sin(held + phi), less J*a.
    """
    assert isinstance(joystick.damping, ConstantDamping)
    inertia, moment = joystick.J, joystick.m * joystick.h
    damping, stiffness = joystick.damping.C, 0.0
    if hand is not None:
        inertia += hand.mass * hand.distance**2
        moment += hand.mass * hand.distance
        damping += hand.damping
        stiffness += hand.stiffness
    step = 1e-5
    springs = np.diff(contact_moment(joystick, [HELD - step, HELD + step]))[0] / (2.0 * step)
    stiffness += springs - moment * joystick.g * math.cos(HELD)
    s = 2j * np.pi * FREQUENCIES
    push = {
        Direction.HORIZONTAL: -moment * math.cos(HELD),
        Direction.VERTICAL: moment * math.sin(HELD),
        Direction.PITCH: moment * joystick.g * math.cos(HELD) / s**2 - inertia,
    }[direction]
    return np.asarray(push / (inertia * s**2 + damping * s + stiffness))


@pytest.mark.parametrize("hand", HANDS, ids=["alone", "hand", "heavy hand"])
def test_small_vibrations(hand: Hand | None, mounted: Fmu) -> None:
    """The differences of the contact moment in the closed form are good to 1e-9 of the stiffness."""
    expected = _closed_form(NOMINAL, hand)
    found = MountedHandle(mounted, NOMINAL, HELD, hand, pivot_to_top=TOP).small(FREQUENCIES)
    assert found["gain"].to_numpy() == pytest.approx(np.abs(expected), rel=1e-7)
    assert found["phase"].to_numpy() == pytest.approx(np.angle(expected), abs=1e-6)
    in_space = 1.0 - TOP * math.cos(HELD) * (2.0 * np.pi * FREQUENCIES) ** 2 * expected
    assert found["transmissibility"].to_numpy() == pytest.approx(np.abs(in_space), rel=1e-7)


@pytest.mark.parametrize("hand", HANDS, ids=["alone", "hand", "heavy hand"])
@pytest.mark.parametrize("direction", [Direction.VERTICAL, Direction.PITCH])
def test_small_vibrations_in_other_directions(direction: Direction, hand: Hand | None, mounted: Fmu) -> None:
    expected = _closed_form(NOMINAL, hand, direction)
    handle = MountedHandle(mounted, NOMINAL, HELD, hand, direction=direction, pivot_to_top=TOP)
    found = handle.small(FREQUENCIES)
    assert found["gain"].to_numpy() == pytest.approx(np.abs(expected), rel=1e-7)
    assert np.exp(1j * found["phase"].to_numpy()) == pytest.approx(expected / np.abs(expected), abs=1e-6)
    # The top rises by -TOP*sin(held) times the angle; with pitch the handle turns by what the base and it do.
    arm = 1.0 if direction is Direction.PITCH else -TOP * math.sin(HELD)
    in_space = 1.0 - arm * (2.0 * np.pi * FREQUENCIES) ** 2 * expected
    assert found["transmissibility"].to_numpy() == pytest.approx(np.abs(in_space), rel=1e-7)


@pytest.mark.parametrize("hand", HANDS, ids=["alone", "hand", "heavy hand"])
@pytest.mark.parametrize("direction", Direction)
def test_driven_by_little_it_does_the_same(direction: Direction, hand: Hand | None, mounted: Fmu) -> None:
    """0.01 m/s2 at resonance move the handle by 0.06 degrees, over which its stiffness hardly changes."""
    handle = MountedHandle(mounted, NOMINAL, HELD, hand, direction=direction)
    small, driven = handle.small(FREQUENCIES), handle.driven(FREQUENCIES, 0.01)
    response = small["gain"] * np.exp(1j * small["phase"])
    again = driven["gain"] * np.exp(1j * driven["phase"])
    assert np.abs(again / response - 1.0).max() < 1e-4
    swing = 0.5 * (driven["theta_max"] - driven["theta_min"])
    assert swing.to_numpy() == pytest.approx(0.01 * small["gain"].to_numpy(), rel=1e-3)


def test_driven_hard_it_does_something_else(mounted: Fmu) -> None:
    """5 m/s2 throw the handle across its preloads; stops keep it between them."""
    free = MountedHandle(mounted, NOMINAL, HELD)
    assert free.driven([1.0], 5.0)["gain"].iloc[0] < 0.8 * free.small([1.0])["gain"].iloc[0]
    stopped = NOMINAL.replace({"stops.theta_stop": math.radians(12.0)})
    handle = MountedHandle(mounted, stopped, HELD, Hand(stiffness=5.0, damping=0.1))
    most = handle.driven([2.0], 5.0)["theta_max"].iloc[0]
    without = MountedHandle(mounted, NOMINAL, HELD, Hand(stiffness=5.0, damping=0.1))
    assert math.radians(12.0) < most < math.radians(12.5)
    assert without.driven([2.0], 5.0)["theta_max"].iloc[0] > math.radians(13.0)


def _fundamentals(mounted: Fmu, frequency: float, acceleration: float, periods: int) -> np.ndarray:
    """Amplitude (rad) and phase of every period of one long run at `HELD`, without a hand."""
    point = mounted.linearize(parameters={"theta_start": HELD}).point
    inputs = sine_table("a_base", acceleration, frequency, periods)
    inputs = inputs.assign(T=point["M_s"] - point["M_g"])
    run = mounted.run(inputs.index, parameters={"theta_start": HELD}, inputs=inputs, outputs=["theta"])
    theta = run["theta"].to_numpy()[1:].reshape(periods, -1)
    samples = theta.shape[1]
    return np.asarray(2.0 / samples * theta @ np.exp(-2j * np.pi * np.arange(1, samples + 1) / samples))


def test_what_settles_slowly_is_waited_for(mounted: Fmu) -> None:
    """At 1.7559 Hz a large motion takes 47 periods to repeat; small ones are steady after 13."""
    handle = MountedHandle(mounted, NOMINAL, HELD)
    found = handle.driven([1.7559], 5.0)
    whole = _fundamentals(mounted, 1.7559, 5.0, 200)
    changes = np.abs(np.diff(whole) / whole[1:])
    assert (changes[12:40] > 1e-3).any()
    assert (changes[60:] < 1e-3).all()
    assert found["gain"].iloc[0] == pytest.approx(abs(whole[-1]) / 5.0, rel=1e-3)


def test_what_does_not_repeat_is_not_given(mounted: Fmu) -> None:
    """Without a hand 5 m/s2 at 1.65 Hz throw the handle about differently every time, for 400 periods."""
    whole = _fundamentals(mounted, 1.65, 5.0, 400)
    changes = np.abs(np.diff(whole) / whole[1:])
    assert (changes[200:] > 1e-3).all()
    assert MountedHandle(mounted, NOMINAL, HELD).driven([1.65], 5.0).isna().all(axis=None)


def test_a_hand_is_a_part_of_the_handle() -> None:
    held = Hand(mass=0.6, distance=0.25).on(NOMINAL)
    assert held.m * held.h == pytest.approx(NOMINAL.m * NOMINAL.h + 0.15, rel=1e-15)
    assert held.J == NOMINAL.J + 0.6 * 0.25**2
    assert Hand().on(NOMINAL) == NOMINAL


def test_what_cannot_be_right_is_refused(mounted: Fmu, joystick_fmus: Path) -> None:
    with Fmu(joystick_fmus / "Joystick.fmu") as plain, pytest.raises(UnsupportedFmuError, match="a_base"):
        MountedHandle(plain, NOMINAL, HELD)
    with pytest.raises(ParameterError, match="stick"):
        MountedHandle(mounted, NOMINAL.replace({"friction.T_c": 0.01}), HELD)
    with pytest.raises(ParameterError, match="keep it"):
        MountedHandle(mounted, NOMINAL, 0.0)  # the handle falls over within the clearance
    assert MountedHandle(mounted, NOMINAL, 0.0, Hand()).decay > 0.0
    with pytest.raises(ParameterError, match="within the stops"):
        MountedHandle(mounted, NOMINAL.replace({"stops.theta_stop": 0.1}), HELD)
    with pytest.raises(ParameterError, match="frequencies"):
        MountedHandle(mounted, NOMINAL, HELD).small([1.0, 0.0])
    with pytest.raises(ParameterError, match="upright"):
        MountedHandle(mounted, NOMINAL, 0.0, Hand(), direction=Direction.VERTICAL)
    with pytest.raises(ParameterError, match=r"at most 62\.01 rad/s2 at 1 Hz"):
        MountedHandle(mounted, NOMINAL, HELD, direction=Direction.PITCH).driven([1.0], 63.0)
    with pytest.raises(
        ParameterError, match="direction = sideways: must be one of horizontal, vertical, pitch"
    ):
        MountedHandle(mounted, NOMINAL, HELD, direction="sideways")  # type: ignore[arg-type]
    named = MountedHandle(mounted, NOMINAL, HELD, direction="pitch")  # type: ignore[arg-type]
    assert named.direction is Direction.PITCH
    with pytest.raises(ParameterError, match="stiffness"):
        Hand(stiffness=-1.0)


def test_the_figure_shows_lines_and_points(mounted: Fmu) -> None:
    handle = MountedHandle(mounted, NOMINAL, HELD, Hand())
    small, driven = handle.small(FREQUENCIES), handle.driven(FREQUENCIES[:2], 1.0)
    figure = plot_transmissibility({"hand": small}, {"hand, 1 m/s2": driven})
    upper, lower = figure.axes
    assert np.radians(upper.lines[0].get_ydata()) == pytest.approx(small["gain"].to_numpy())
    assert lower.lines[1].get_ydata() == pytest.approx(driven["transmissibility"].to_numpy())
    with pytest.raises(ParameterError):
        plot_transmissibility({})
