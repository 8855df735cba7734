"""The examples of PreloadedSpringsMSL as FMUs, against SciPy; needs the Modelica Standard Library."""

from __future__ import annotations

import math

import fmpy
import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from tests.modelica.library import comparison_signals, msl_examples
from tests.modelica.msl import why_not
from tests.modelica.physics import TABLE_1, Array, J, constant_damping, integrated, shaft_torque, table_force
from tests.shared_fmus import SharedFmus

pytestmark = pytest.mark.skipif(bool(why_not()), reason=why_not())
TIMES = np.linspace(0.0, 1.5, 301)
RATIO, ROTOR = 8.0, 2e-5


def _ramp(time: float, height: float, duration: float, start: float) -> float:
    return height * min(max((time - start) / duration, 0.0), 1.0)


def _drivetrain(times: Array) -> dict[str, Array]:
    """Angle of the rotor as it appears behind the gear, where its inertia counts 64 times."""

    def derivatives(time: float, state: Array, branch: int) -> list[float]:
        theta, omega, phi, w = state
        twist = 40.0 * (phi - theta) + 0.05 * (w - omega)
        torque = RATIO * 0.2 * math.sin(4.0 * math.pi * time)
        return [
            omega,
            (shaft_torque(theta, omega, constant_damping, branch) + twist) / J,
            w,
            (torque - twist) / (RATIO**2 * ROTOR),
        ]

    theta, _, phi, _ = integrated(derivatives, [0.0, 0.0, 0.0, 0.0], times)
    return {"joystick.theta": theta, "rotor.phi": RATIO * phi}


def _force_feedback(times: Array) -> dict[str, Array]:
    """Mechanics, winding, and the integrator x of the controller u = 3*(e + x) with x' = e/T."""
    k, feedback = 0.05, 3.0

    def derivatives(time: float, state: Array, branch: int) -> list[float]:
        theta, omega, i, x = state
        hand = _ramp(time, 1.6, 0.2, 0.1) - _ramp(time, 1.6, 0.05, 1.0)
        neutral = 0.04 if time > 1.2 else 0.0
        error = feedback * (neutral - theta) / (k * RATIO) - i
        torque = shaft_torque(theta, omega, constant_damping, branch) + hand + RATIO * k * i
        voltage = 3.0 * (error + x)
        return [
            omega,
            torque / (J + RATIO**2 * ROTOR),
            (voltage - 2.5 * i - k * RATIO * omega) / 1.2e-3,
            error / 2e-3,
        ]

    theta, _, i, _ = integrated(derivatives, [0.0, 0.0, 0.0, 0.0], times)
    return {"joystick.theta": theta, "current.i": i}


def _opposing_springs(times: Array) -> dict[str, Array]:
    """Equations (6) to (8) for either side, with a clearance of 0.5 mm."""
    kinks = [-0.6e-3, -0.5e-3, 0.5e-3, 0.6e-3]

    def derivatives(_: float, state: Array, branch: int) -> list[float]:
        s, v = state
        side = 1.0 if branch > 2 else -1.0
        delta = side * s - 0.5e-3
        force = [40.0 + 2000.0 * delta, (4e5 + 2000.0) * delta, 0.0][min(branch, 4 - branch)]
        return [v, (-side * force - 3.0 * v) / 0.5]

    return {"mass.s": integrated(derivatives, [4e-3, 0.0], times, kinks=kinks)[0]}


def _actuator(times: Array) -> dict[str, Array]:
    force = table_force(3e-3 * times, *TABLE_1[1])
    return {"actuator.f": -force, "original.f": force}


EXPECTED = {
    "Drivetrain": _drivetrain,
    "ForceFeedback": _force_feedback,
    "OpposingSprings": _opposing_springs,
    "ActuatorLoadCurve": _actuator,
}
#: Angles (rad) and positions (m) as for the joystick alone; before the gear, the angle is eight times that.
#: The current (A) is 7.5 times the angle. Forces (N): 1e6 N/m, and a kink is an event within 1e-12 m.
ACCURACY = {"current.i": 1e-6, "actuator.f": 1e-6, "original.f": 1e-6, "rotor.phi": 8e-7}


def test_every_example_is_here() -> None:
    assert {name.rpartition(".")[2] for name in msl_examples()} == set(EXPECTED)


@pytest.mark.parametrize("example", EXPECTED)
def test_co_simulation(example: str, shared_fmus: SharedFmus) -> None:
    expected = EXPECTED[example](TIMES)
    with Fmu(shared_fmus.fmu(f"PreloadedSpringsMSL.Examples.{example}")) as fmu:
        found = fmu.run(TIMES, outputs=list(expected), tolerance=1e-8)
    for name, values in expected.items():
        assert np.ptp(values) > 1e-3
        assert np.abs(found[name].to_numpy() - values).max() < ACCURACY.get(name, 1e-7), name


@pytest.mark.parametrize("example", EXPECTED)
def test_model_exchange(example: str, shared_fmus: SharedFmus) -> None:
    """By FMPy's CVode, which finds events as late as its tolerance lets it: ten times as far off."""
    expected = EXPECTED[example](TIMES)
    result = fmpy.simulate_fmu(
        str(shared_fmus.fmu(f"PreloadedSpringsMSL.Examples.{example}")),
        fmi_type="ModelExchange",
        stop_time=TIMES[-1],
        output_interval=5e-3,
        relative_tolerance=1e-10,
        output=list(expected),
    )
    times, first = np.unique(result["time"], return_index=True)
    expected = EXPECTED[example](times)
    for name, values in expected.items():
        assert np.abs(result[name][first] - values).max() < 10.0 * ACCURACY.get(name, 1e-7), name


@pytest.mark.parametrize("example", msl_examples())
def test_comparison_signals_are_variables(example: str, shared_fmus: SharedFmus) -> None:
    with Fmu(shared_fmus.fmu(example)) as fmu:
        assert set(comparison_signals(example)) <= set(fmu.description.variables)
