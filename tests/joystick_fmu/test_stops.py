"""Mechanical stops in the FMUs: against SciPy, the reference, and the closed form of a bounce."""

from __future__ import annotations

import math
import re
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from pyjoystick.fmu import Fmu, FmuRunError
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, simulate
from pyjoystick.runs import fmu_of_joystick
from pyjoystick.support import ParameterError
from tests.hybrid import integrate
from tests.joystick_fmu.driver import model_exchange
from tests.joystick_fmu.test_friction import BARE
from tests.modelica.physics import (
    Array,
    Damping,
    J,
    branch_of,
    constant_damping,
    power_law_damping,
    shaft_torque,
    to_the_ends,
)

TIMES = np.linspace(0.0, 1.0, 501)
STOP, K, D = math.radians(20.0), 1000.0, 0.7
STOPS = {"stops.theta_stop": STOP, "stops.K": K, "stops.D": D}
#: Thrown from one stop against the other: three bounces.
START = {"theta_start": -0.3, "omega_start": -15.0}
LAWS: dict[str, tuple[JoystickParameters, Damping]] = {
    "constant": (NOMINAL.replace(STOPS), constant_damping),
    "power-law": (NOMINAL_POWER_LAW.replace(STOPS), power_law_damping),
}


def _by_scipy(damping: Damping) -> Array:
    """The angle, with every impact, every end of a contact and every kink of the springs located by SciPy."""

    def push(theta: float, omega: float) -> float:
        side = math.copysign(1.0, theta)
        return K * (side * theta - STOP) + D * side * omega

    def derivatives(_: float, state: Array, mode: tuple[int, bool]) -> list[float]:
        (theta, omega), (branch, is_pushed) = state, mode
        moment = math.copysign(push(theta, omega), theta) if is_pushed else 0.0
        return [omega, (shaft_torque(theta, omega, damping, branch) - moment) / J]

    def guards(_: float, state: Array, mode: tuple[int, bool]) -> list[float]:
        (theta, omega), (branch, is_pushed) = state, mode
        return [push(theta, omega) if is_pushed else STOP - abs(theta), *to_the_ends(theta, branch)]

    def switch(_: float, state: Array, mode: tuple[int, bool], guard: int) -> tuple[Array, tuple[int, bool]]:
        branch, is_pushed = mode
        return state, (
            (branch, not is_pushed) if guard == 0 else (branch + (1 if guard == 2 else -1), is_pushed)
        )

    start = list(START.values())
    mode = (branch_of(start[0]), False)
    return integrate(derivatives, start, mode, guards, switch, TIMES[-1], max_step=2e-3)(TIMES)[0]


@pytest.mark.parametrize("law", LAWS)
def test_the_motion_between_the_stops_is_that_of_scipy(law: str, fmus: Path) -> None:
    """Co-Simulation at tolerance 1e-8 within 1e-7 rad; the reference, which SciPy limits, within 1e-9 rad."""
    joystick, damping = LAWS[law]
    expected = _by_scipy(damping)
    with Fmu(fmus / f"{fmu_of_joystick(joystick)}.fmu") as fmu:
        found = fmu.run(TIMES, parameters=joystick.to_names() | START, tolerance=1e-8)
    assert found["theta"].min() < -STOP - 0.01 < STOP + 0.001 < found["theta"].max()
    assert np.abs(found["theta"] - expected).max() < 1e-7
    motion = simulate(joystick, time=TIMES, **START)
    assert np.abs(motion.theta - expected).max() < 1e-9
    assert np.abs(found["M_stop"] - motion.M_stop).max() < 1e-4
    assert [event.kind for event in motion.events if event.kind.endswith("stop")][:2] == ["backward stop"] * 2


def test_model_exchange(fmus: Path) -> None:
    """FMPy's CVode at 1e-10 within 1e-6 rad, as without stops."""
    joystick, _ = LAWS["constant"]
    path = fmus / "MountedJoystick.fmu"
    times, found = model_exchange(path, joystick.to_names() | START, "theta", interval=2e-3)
    assert np.abs(found["theta"] - simulate(joystick, time=times, **START).theta).max() < 1e-6


@pytest.mark.parametrize(("stiffness", "damping"), [(1000.0, 0.0), (1000.0, 0.7), (300.0, 2.0), (50.0, 1.0)])
def test_a_bounce_returns_what_the_closed_form_says(stiffness: float, damping: float, fmus: Path) -> None:
    """A handle alone against one stop: its contact is that of a mass on a spring and a damper.

    It ends where spring and damper together would begin to pull; the energy then left in the spring is lost.
    """
    speed, law = 5.0, {"stops.theta_stop": STOP, "stops.K": stiffness, "stops.D": damping}
    zeta, natural = damping / (2.0 * math.sqrt(stiffness * J)), math.sqrt(stiffness / J)
    root = math.sqrt(1.0 - zeta**2)
    phase = math.atan2(2.0 * zeta * root, 2.0 * zeta**2 - 1.0)
    returned = math.exp(-zeta / root * phase)
    contact = phase / (root * natural)
    start = {"theta_start": STOP - 0.05, "omega_start": speed}
    times = np.array([0.0, 0.05 / speed + contact + 1e-4])
    with Fmu(fmus / "MountedJoystick.fmu") as fmu:
        found = fmu.run(
            times, parameters=BARE | law | start, outputs=["omega", "E", "M_stop"], tolerance=1e-10
        )
    end = found.iloc[-1]
    assert end["omega"] == pytest.approx(-returned * speed, rel=1e-7)
    assert end["M_stop"] == 0.0
    loss = 0.5 * J * speed**2 * (1.0 - returned**2)
    assert found["E"].iloc[0] - end["E"] == pytest.approx(loss, rel=1e-6, abs=1e-9)


def test_what_the_stops_take_is_what_the_energy_loses(fmus: Path) -> None:
    """E + stops.E falls by the damping's and the stops' power, and never rises.

    The rectangle rule of the powers converges slowly at impacts, where they jump: 1e-3 of the loss.
    """
    joystick, _ = LAWS["constant"]
    times = np.linspace(0.0, 1.0, 200_001)
    names = ["E", "stops.E", "M_d", "omega", "M_stop", "stops.delta", "theta"]
    with Fmu(fmus / "MountedJoystick.fmu") as fmu:
        run = fmu.run(times, parameters=joystick.to_names() | START, outputs=names, tolerance=1e-10)
    whole = (run["E"] + run["stops.E"]).to_numpy()
    assert np.diff(whole).max() < 1e-9
    spring = K * np.maximum(run["stops.delta"], 0.0) * np.sign(run["theta"])
    power = (run["M_d"] + run["M_stop"] - spring) * run["omega"]
    assert np.trapezoid(power, times) == pytest.approx(whole[0] - whole[-1], rel=1e-3)


@pytest.mark.parametrize("law", ["", "PowerLaw"])
def test_without_stops_on_a_base_at_rest_it_is_the_joystick(fmus: Path, law: str) -> None:
    """Within the integrator's error: the number of relations decides on the sizes of steps after events."""
    start = {"theta_start": math.radians(-35.0)}
    with Fmu(fmus / f"MountedJoystick{law}.fmu") as mounted, Fmu(fmus / f"Joystick{law}.fmu") as free:
        left = mounted.run(TIMES, parameters=start, outputs=["theta", "M_stop", "M_base"])
        right = free.run(TIMES, parameters=start, outputs=["theta"])
    assert np.abs(left["theta"] - right["theta"]).max() < 1e-8
    assert (left[["M_stop", "M_base"]] == 0.0).all(axis=None)


def test_dry_friction_holds_against_the_stop(fmus: Path) -> None:
    """Pressed onto the stop by a torque and let go a little: stuck where it was, as the reference says."""
    joystick = NOMINAL.replace(STOPS | {"friction.T_c": 0.3})
    expected = simulate(joystick, time=TIMES, theta_start=0.3, torque=lambda _: 12.0)
    with Fmu(fmus / "MountedJoystick.fmu") as fmu:
        parameters = joystick.to_names() | {"theta_start": 0.3}
        found = fmu.run(TIMES, parameters=parameters, inputs={"T": 12.0}, outputs=["theta", "isStuck"])
    assert found["isStuck"].iloc[-1]
    assert found["theta"].iloc[-1] > STOP
    assert np.abs(found["theta"] - expected.theta).max() < 1e-7


@pytest.mark.parametrize(
    ("name", "value", "python_says", "fmu_says"),
    [
        (
            "theta_stop",
            -0.1,
            "must be a finite number from 0 to 1.5708 rad",
            "the allowed range is 0 to 1.57079633",
        ),
        (
            "theta_stop",
            0.5 * math.pi,
            "must not be negative and below pi/2",
            "stops.theta_stop must not be negative and below pi/2",
        ),
        ("K", 0.0, "must be positive, but is 0 N.m/rad", "stops.K must be positive"),
        ("D", -1.0, "must be a finite number, 0 N.m.s/rad or more", "the allowed range is 0 to inf"),
    ],
)
def test_impossible_stops_are_refused_by_name(
    name: str, value: float, python_says: str, fmu_says: str, joystick_fmus: Path
) -> None:
    """Python refuses what the description forbids; other tools hear it from the FMU itself."""
    path, values = joystick_fmus / "MountedJoystick.fmu", STOPS | {f"stops.{name}": value}
    with (
        Fmu(path) as fmu,
        pytest.raises((FmuRunError, ParameterError), match=re.escape(f"stops.{name}")) as refused,
    ):
        fmu.run(TIMES, parameters=values)
    assert python_says in str(refused.value)
    said: list[str] = []
    with pytest.raises(FMICallException):
        fmpy.simulate_fmu(
            str(path),
            fmi_type="CoSimulation",
            stop_time=0.01,
            start_values=values,
            logger=lambda *message: said.append(message[-1].decode()),
        )
    assert f"stops.{name}" in said[0]
    assert fmu_says in said[0]
