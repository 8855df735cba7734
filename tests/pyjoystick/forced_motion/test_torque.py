"""The torque of a motion: the inverse FMUs against plain Python."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import FmuRunError, UnsupportedFmuError
from pyjoystick.forced_motion import (
    TORQUES,
    ForwardAndReturn,
    Samples,
    inverse_fmu,
    torque_by_fmu,
    torque_by_reference,
)
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, PIVOT_TO_TOP, JoystickParameters, angle_of_travel
from pyjoystick.support import ParameterError
from tests.pyjoystick.forced_motion.cases import JOYSTICKS, MOTIONS
from tests.pyjoystick.random_parameters import RandomCase, both_laws

CASES = both_laws(4)

pytestmark = pytest.mark.usefixtures("fmus_by_name")


def _difference(first: pd.DataFrame, second: pd.DataFrame) -> float:
    """Largest difference of the torque or a part of it, in parts of that part's largest value."""
    return max(
        float(np.max(np.abs(first[name].to_numpy() - second[name].to_numpy())))
        / float(np.max(np.abs(second[name].to_numpy())))
        for name in TORQUES
    )


@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_the_fmu_is_plain_python_to_1e_12(motion: ForwardAndReturn, joystick: JoystickParameters) -> None:
    """Samples lie on both sides of every kink as close as rounding allows, and at the corners twice."""
    samples = Samples.of(joystick, motion)
    assert _difference(torque_by_fmu(joystick, samples), torque_by_reference(joystick, samples)) < 1e-12


@pytest.mark.parametrize("joystick", JOYSTICKS.values(), ids=JOYSTICKS)
def test_samples_on_the_kinks_and_across_the_middle(joystick: JoystickParameters) -> None:
    """Every kink of both sides exactly, and from one side of the middle to the other in one step."""
    kinks = [
        sign * angle_of_travel(joystick, x)
        for sign, side in ((1.0, joystick.forward), (-1.0, joystick.backward))
        for x in side.kinks
    ]
    theta = np.array([*kinks, *kinks[::-1], 0.3, -0.3, 1e-12, -1e-12, 0.2])
    omega = np.linspace(-5.0, 5.0, len(theta))
    time = np.arange(len(theta), dtype=np.float64)
    samples = Samples.trapezoidal(time, theta, omega, np.linspace(-100.0, 100.0, len(theta)))
    assert _difference(torque_by_fmu(joystick, samples), torque_by_reference(joystick, samples)) < 1e-12


@pytest.mark.parametrize("omega", [3.0, -3.0])
def test_in_the_middle_itself_eq_11_has_two_values(omega: float) -> None:
    """There the coefficient jumps; the reference takes the forward one, the FMU the backward one."""
    time = np.linspace(0.0, 0.2, 5)
    samples = Samples.trapezoidal(time, omega * (time - 0.1), np.full(5, omega), np.zeros(5))
    assert samples.theta[2] == 0.0
    found = torque_by_fmu(NOMINAL_POWER_LAW, samples)["T_damping"].to_numpy()
    expected = torque_by_reference(NOMINAL_POWER_LAW, samples)["T_damping"].to_numpy()
    np.testing.assert_allclose(np.delete(found, 2), np.delete(expected, 2), rtol=1e-12)
    beside = Samples.trapezoidal(time, np.full(5, -1e-12), np.full(5, omega), np.zeros(5))
    backward = torque_by_reference(NOMINAL_POWER_LAW, beside)["T_damping"].iloc[2]
    assert found[2] == pytest.approx(backward, rel=1e-6)
    assert abs(found[2] - expected[2]) > 0.05 * abs(expected[2])


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_random_joysticks(case: RandomCase) -> None:
    joystick = case.parameters
    motion = ForwardAndReturn(amplitude=-0.3, rise=0.2)
    samples = Samples.of(joystick, motion)
    assert _difference(torque_by_fmu(joystick, samples), torque_by_reference(joystick, samples)) < 1e-12


def test_the_table_has_units_and_the_force_at_the_handle() -> None:
    samples = Samples.evenly(ForwardAndReturn(amplitude=0.3, rise=0.2), 0.01)
    table = torque_by_reference(NOMINAL, samples)
    assert table.attrs["units"]["F"] == "N"
    np.testing.assert_array_equal(table["F"], table["T"] / PIVOT_TO_TOP)
    parts = table[["T_inertia", "T_damping", "T_stiffness"]].sum(axis=1)
    np.testing.assert_allclose(parts, table["T"], rtol=0.0, atol=1e-15)
    nearer = torque_by_reference(NOMINAL, samples, pivot_to_handle=0.2)
    assert nearer["F"].iloc[3] == table["T"].iloc[3] / 0.2
    with pytest.raises(ParameterError, match="pivot_to_handle = 0"):
        torque_by_reference(NOMINAL, samples, pivot_to_handle=0)


def test_what_cannot_be_asked() -> None:
    samples = Samples.evenly(ForwardAndReturn(amplitude=0.3, rise=0.2), 0.1)
    with pytest.raises(UnsupportedFmuError, match="does not have the interface of JoystickInverse: it lacks"):
        torque_by_fmu(NOMINAL, samples, fmu="Joystick")
    flat = Samples.trapezoidal(np.arange(3.0), np.array([0.0, 0.1, 1.7]), np.zeros(3), np.zeros(3))
    with pytest.raises(FmuRunError, match="theta must stay between -pi/2 and pi/2"):
        torque_by_fmu(NOMINAL, flat)
    with pytest.raises(ParameterError, match="theta"):
        torque_by_reference(NOMINAL, flat)


def test_the_law_chooses_the_fmu(fmus_by_name: Path) -> None:
    assert inverse_fmu(NOMINAL.damping) == "JoystickInverse"
    assert inverse_fmu(NOMINAL_POWER_LAW.damping) == "JoystickInversePowerLaw"
