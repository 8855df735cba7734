"""Loads on the joystick's flange: rigid and elastic ones, a torque, a motor with a gear."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from fmu_build import FmiVersion
from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, simulate
from tests.joystick_fmu.driver import model_exchange
from tests.modelica.physics import Array, J, constant_damping, integrated, power_law_damping, shaft_torque
from tests.shared_fmus import SharedFmus

TIMES = np.linspace(0.0, 1.5, 301)
LOADED = Path(__file__).with_name("Loaded.mo")


def _rigid(times: Array) -> Array:
    """The load turns with the handle: it is a part of the handle's inertia."""
    return simulate(NOMINAL.replace({"J": J + 0.01}), time=times, theta_start=-0.3).theta


def _rubbing(times: Array) -> Array:
    friction = {"friction.T_c": 0.03, "friction.T_s": 0.06, "friction.omega_s": 0.2}
    return simulate(NOMINAL.replace({"J": J + 0.01} | friction), time=times, theta_start=-0.3).theta


def _driven(times: Array) -> Array:
    """A torque at the flange is a torque T: the friction holds against it, and gives way."""
    rubbing = NOMINAL.replace({"friction.T_c": 0.3})
    motion = simulate(rubbing, time=times, theta_start=0.0, torque=lambda time: 2.0 * math.sin(7.0 * time))
    assert [event.kind for event in motion.events].count("slips") >= 3
    return motion.theta


def _elastic(times: Array) -> Array:
    def derivatives(_: float, state: Array, branch: int) -> list[float]:
        theta, omega, phi, w = state
        twist = 20.0 * (phi - theta) + 0.02 * (w - omega)
        return [omega, (shaft_torque(theta, omega, power_law_damping, branch) + twist) / J, w, -twist / 0.01]

    return np.asarray(integrated(derivatives, [-0.3, 0.0, 0.1, 0.0], times)[0])


def _motorized(times: Array) -> Array:
    """The rotor turns five times as fast, its torque counts five times, its inertia 25 times."""

    def derivatives(time: float, state: Array, branch: int) -> list[float]:
        theta, omega, i = state
        torque = shaft_torque(theta, omega, constant_damping, branch) + 5.0 * 0.05 * i
        voltage = 12.0 * math.sin(7.0 * time)
        return [omega, torque / (J + 25.0 * 1e-4), (voltage - 2.0 * i - 0.05 * 5.0 * omega) / 0.01]

    return np.asarray(integrated(derivatives, [0.0, 0.0, 0.0], times)[0])


EXPECTED = {
    "RigidLoad": _rigid,
    "RubbingLoad": _rubbing,
    "Driven": _driven,
    "ElasticLoad": _elastic,
    "Motorized": _motorized,
}
RUNS: list[tuple[str, FmiVersion]] = [*((model, "2.0") for model in EXPECTED), ("RubbingLoad", "3.0")]


@pytest.mark.parametrize(("model", "fmi_version"), RUNS)
def test_co_simulation(model: str, fmi_version: FmiVersion, shared_fmus: SharedFmus) -> None:
    """At tolerance 1e-8 within 1e-7 rad, as without a load."""
    with Fmu(shared_fmus.fmu(f"Loaded.{model}", LOADED, fmi_version=fmi_version)) as fmu:
        found = fmu.run(TIMES, outputs=["joystick.theta"], tolerance=1e-8)["joystick.theta"].to_numpy()
    expected = EXPECTED[model](TIMES)
    assert np.ptp(expected) > 0.1
    assert np.abs(found - expected).max() < 1e-7


@pytest.mark.parametrize(("model", "fmi_version"), RUNS)
def test_model_exchange(model: str, fmi_version: FmiVersion, shared_fmus: SharedFmus) -> None:
    """FMPy's CVode at a tolerance of 1e-10 within 1e-6 rad, as without a load."""
    path = shared_fmus.fmu(f"Loaded.{model}", LOADED, fmi_version=fmi_version)
    times, found = model_exchange(path, {}, "joystick.theta", interval=5e-3)
    assert np.abs(found["joystick.theta"] - EXPECTED[model](times)).max() < 1e-6


def test_the_load_rests_while_friction_holds_the_joystick(shared_fmus: SharedFmus) -> None:
    """Stuck, the load has not even the acceleration of rounding errors."""
    names = ["joystick.isStuck", "joystick.M_f", "load.w", "load.a"]
    with Fmu(shared_fmus.fmu("Loaded.RubbingLoad", LOADED)) as fmu:
        found = fmu.run(np.linspace(0.0, 3.0, 601), outputs=names)
    stuck = found[found["joystick.isStuck"]]
    assert len(stuck) > 100
    assert (stuck[["load.w", "load.a"]] == 0.0).all(axis=None)


def test_the_fmu_of_a_joystick_has_no_variables_of_its_flange(fmus: Path) -> None:
    """Nothing can be connected to it there; the terminal `shaft` of FMI 3 says what it was for."""
    for name in ("Joystick", "JoystickFrictionPowerLaw", "HeldJoystick"):
        with Fmu(fmus / f"{name}.fmu") as fmu:
            assert not [each for each in fmu.description.variables if each.startswith("flange.")]
