"""Dry friction in the FMUs: against the reference, closed forms, and the FMUs without it."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, Trajectory, simulate
from tests.joystick_fmu.driver import fmu_path, model_exchange
from tests.pyjoystick.random_parameters import RandomCase, random_cases
from tests.shared_fmus import SharedFmus

TIMES = np.linspace(0.0, 2.0, 401)
OUTPUTS = ("theta", "omega", "alpha", "M_f", "isStuck")
#: Without weight and out of reach of the springs: friction and torque alone.
BARE = {"g": 0.0, "damping.C": 0.0} | {
    f"{side}.{spring}Spring.x_0": x
    for side in ("forward", "backward")
    for spring, x in (("return", 10.0), ("balance", 20.0))
}


def _friction(random: np.random.Generator, kind: int) -> dict[str, float]:
    """Pivot, plunger, both, Stribeck; from hardly any to what ends the motion in the first swings."""
    moment = 10.0 ** random.uniform(-3.5, -0.5)
    pivot = {"friction.T_c": moment}
    plunger = {"friction.F_c": 10.0 ** random.uniform(-1.5, 0.7)}
    static = {
        "friction.T_s": moment * random.uniform(1.2, 2.5),
        "friction.omega_s": 10.0 ** random.uniform(-2, 0),
    }
    return (pivot, plunger, pivot | plunger, pivot | static)[kind]


def _cases() -> list[RandomCase]:
    random = np.random.default_rng(16)
    plain = random_cases(NOMINAL, 4) + random_cases(NOMINAL_POWER_LAW, 4)
    return [
        RandomCase(case.name, case.parameters.replace(_friction(random, i % 4)), case.theta_start)
        for i, case in enumerate(plain)
    ]


CASES = _cases()
#: An instant of sticking or slipping is one of the reference within this (s).
INSTANT = 1e-6


def _changes(motion: Trajectory) -> list[float]:
    """The instants at which the reference begins to stick or to slip (s)."""
    return [event.time for event in motion.events if event.kind in ("sticks", "slips") and event.time > 0.0]


def _assert_it_changes_then(motion: Trajectory, found: pd.DataFrame, instants: list[float]) -> None:
    """Just before each of these instants the FMU still does what it does not do just after it."""
    for at in instants:
        before, after = found["isStuck"].loc[[at - INSTANT, at + INSTANT]]
        kind = next(event.kind for event in motion.events if event.time == at)
        assert (bool(before), bool(after)) == ((False, True) if kind == "sticks" else (True, False)), at


def _with_changes(instants: list[float]) -> np.ndarray:
    return np.unique([*TIMES, *(at + side for at in instants for side in (-INSTANT, INSTANT))])


def _run(
    fmu: Path, case: RandomCase, times: np.ndarray = TIMES, torque: pd.DataFrame | None = None
) -> pd.DataFrame:
    values = case.parameters.to_names() | {"theta_start": case.theta_start}
    with Fmu(fmu) as opened:
        return opened.run(times, parameters=values, inputs=torque, outputs=OUTPUTS)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_co_simulation_follows_the_reference(case: RandomCase, fmus: Path) -> None:
    """At tolerance 1e-8 within 1e-7 rad; stuck at the same instants, with the same moment."""
    expected = simulate(case.parameters, time=TIMES, theta_start=case.theta_start)
    instants = _changes(expected)
    everything = _run(fmu_path(fmus, case.parameters), case, _with_changes(instants))
    _assert_it_changes_then(expected, everything, instants)
    found = everything.loc[TIMES]
    assert np.abs(found["theta"] - expected.theta).max() < 1e-7
    assert (found["isStuck"] == expected.is_stuck).all()
    assert np.abs(found["M_f"] - expected.M_f).max() < 1e-6
    stuck = found[found["isStuck"]]
    assert (stuck[["omega", "alpha"]] == 0.0).all(axis=None)
    assert np.ptp(stuck["theta"]) == 0.0 if len(stuck) else expected.events[-1].kind != "sticks"


@pytest.mark.parametrize("number", range(4))
def test_a_torque_breaks_it_away_when_the_reference_does(number: int, joystick_fmus: Path) -> None:
    """Straight lines of torque: it sticks and slips again and again."""
    case = CASES[2 * number]
    random = np.random.default_rng(number)
    times, torques = np.linspace(0.0, 2.0, 9), random.uniform(-2.2, 2.2, 9)
    torques[3] = torques[4]  # it holds still in between
    expected = simulate(
        case.parameters,
        time=TIMES,
        theta_start=case.theta_start,
        torque=lambda time: float(np.interp(time, times, torques)),
        torque_breakpoints=times,
    )
    table = pd.DataFrame({"T": torques}, index=times)
    instants = _changes(expected)
    path = fmu_path(joystick_fmus, case.parameters)
    everything = _run(path, case, _with_changes(instants), torque=table)
    _assert_it_changes_then(expected, everything, instants)
    found = everything.loc[TIMES]
    assert np.abs(found["theta"] - expected.theta).max() < 1e-7
    assert (found["isStuck"] == expected.is_stuck).all()


def test_the_torques_of_that_test_make_it_stick_and_slip() -> None:
    case = CASES[0]
    held = case.parameters.replace({"friction.T_c": 0.3})
    motion = simulate(held, time=TIMES, theta_start=0.0, torque=lambda time: 2.0 * math.sin(7.0 * time))
    kinds = [event.kind for event in motion.events if event.kind in ("sticks", "slips")]
    assert kinds.count("slips") >= 4
    assert all(a != b for a, b in pairwise(kinds))


@pytest.mark.parametrize("case", [CASES[3], CASES[6]], ids=lambda case: case.name)
def test_model_exchange_follows_the_reference(case: RandomCase, fmus: Path) -> None:
    """FMPy's CVode at a tolerance of 1e-10 within 1e-6 rad, as for the FMUs without friction."""
    values = case.parameters.to_names() | {"theta_start": case.theta_start}
    path = fmu_path(fmus, case.parameters)
    times, found = model_exchange(path, values, "theta", "isStuck", interval=5e-3)
    expected = simulate(case.parameters, time=times, theta_start=case.theta_start)
    assert np.abs(found["theta"] - expected.theta).max() < 1e-6
    assert found["isStuck"][-1] == expected.is_stuck[-1]


@pytest.mark.parametrize("nominal", [NOMINAL, NOMINAL_POWER_LAW], ids=["constant", "power law"])
def test_without_friction_the_motion_is_that_of_the_plain_fmu(
    nominal: JoystickParameters, fmus: Path
) -> None:
    """Each within its own errors at a tolerance of 1e-9: the steps differ."""
    plain = fmu_path(fmus, nominal)
    with Fmu(plain) as one, Fmu(plain.with_stem(plain.stem.replace("Joystick", "JoystickFriction"))) as other:
        for degrees in (-20.0, 6.0):
            values = {"theta_start": math.radians(degrees)}
            expected = one.run(TIMES, parameters=values, outputs=("theta",), tolerance=1e-9)
            found = other.run(TIMES, parameters=values, outputs=("theta", "isStuck"), tolerance=1e-9)
            assert np.abs(found["theta"] - expected["theta"]).max() < 1e-8
            assert not found["isStuck"].any()


@pytest.mark.parametrize("moment", [0.0072, 0.05, 0.3])
def test_it_sticks_for_ever_where_it_stopped(moment: float, fmus: Path) -> None:
    joystick = NOMINAL.replace({"friction.T_c": moment})
    times = np.array([0.0, 4.0, 1e3, 1e6])
    theta = _run(fmu_path(fmus, joystick), RandomCase("", joystick, -0.3), times)["theta"].to_numpy()
    assert (theta[1:] == theta[1]).all()
    assert theta[1] != 0.0
    assert theta[1] == pytest.approx(simulate(joystick, time=times[:2], theta_start=-0.3).theta[-1], abs=1e-8)


def test_a_push_and_friction_alone_in_closed_form(fmus: Path) -> None:
    """A constant torque T for 0.2 s, then none: theta = (T - T_c)*t^2/(2*J), and a parabola to the stop."""
    joystick = NOMINAL.replace(BARE | {"friction.T_c": 0.02, "friction.F_c": 0.7})
    push, friction, inertia = 0.03, 0.02, joystick.J
    table = pd.DataFrame({"T": [push, push, 0.0, 0.0]}, index=[0.0, 0.2, 0.2, 2.0])
    found = _run(fmu_path(fmus, joystick), RandomCase("", joystick, 0.0), torque=table)
    speed, way = (push - friction) / inertia * 0.2, (push - friction) / inertia * 0.02
    stop = 0.2 + speed * inertia / friction
    late = np.clip(TIMES, 0.2, stop) - 0.2
    expected = np.where(
        TIMES < 0.2,
        0.5 * (push - friction) / inertia * TIMES**2,
        way + speed * late - 0.5 * friction / inertia * late**2,
    )
    assert np.abs(found["theta"] - expected).max() < 1e-9
    away = np.abs(TIMES - stop) > 1e-9  # whether it has stopped at that very instant is rounding
    assert (found["isStuck"] == (stop < TIMES))[away].all()
    assert found["M_f"].iloc[-1] == 0.0


def test_a_push_by_time_alone_is_not_missed(shared_fmus: SharedFmus) -> None:
    """No state moves before it, and the push lasts a fiftieth of a second in the middle of a minute."""
    joystick = NOMINAL.replace({"friction.T_c": 0.05})
    ends = [0.0, 60.0]
    expected = simulate(
        joystick,
        time=ends,
        theta_start=0.001,
        torque=lambda time: 0.2 * math.exp(-(((time - 30.0) / 0.02) ** 2)),
    )
    with Fmu(shared_fmus.fmu("Pushed", Path(__file__).with_name("Pushed.mo"))) as fmu:
        found = fmu.run(np.array(ends), outputs=("joystick.theta", "joystick.isStuck"))
    assert abs(found["joystick.theta"].iloc[-1] - expected.theta[-1]) < 1e-7
    assert abs(expected.theta[-1] - 0.001) > 1e-3
    assert found["joystick.isStuck"].iloc[-1]


def test_a_push_below_the_friction_does_not_move_it(fmus: Path) -> None:
    joystick = NOMINAL.replace(BARE | {"friction.T_c": 0.02})
    table = pd.DataFrame({"T": [0.0, 0.02, -0.02, 0.0]}, index=[0.0, 0.5, 1.0, 2.0])
    found = _run(fmu_path(fmus, joystick), RandomCase("", joystick, 0.1), torque=table)
    assert (found["theta"] == 0.1).all()
    assert found["isStuck"].all()
    assert found["M_f"].loc[0.5] == 0.02


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"friction.T_c": 0.1, "friction.T_s": 0.05}, "T_s must be 0 or at least T_c"),
        ({"friction.T_c": 0.1, "friction.T_s": 0.2}, "omega_s must be positive where T_s exceeds T_c"),
    ],
)
def test_friction_that_cannot_be_is_refused(values: dict[str, float], message: str, fmus: Path) -> None:
    with Fmu(fmus / "JoystickFriction.fmu") as fmu, pytest.raises(Exception, match=message):
        fmu.run(TIMES[:2], parameters=values)
