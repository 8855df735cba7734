from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW, Fmu
from pyjoystick.forced_motion import NoSolutionError, ShakenJoystick, Shaking, solve
from pyjoystick.model import simulate
from pyjoystick.support import ParameterError, UnknownParameterError

C_OVER_J = 0.045 / 0.01135


@pytest.fixture(scope="module")
def fmu() -> Iterator[Fmu]:
    with Fmu("Joystick") as opened:
        yield opened


@pytest.fixture(scope="module")
def shaken(fmu: Fmu) -> ShakenJoystick:
    return ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0))


@pytest.mark.parametrize("start", [(-0.35, 0.0), (0.01, 0.3), (0.2, -4.0)])
def test_a_period_is_that_of_the_reference_under_the_sine_itself(
    shaken: ShakenJoystick, start: tuple[float, float]
) -> None:
    found = shaken.images(np.array([start]), 4.0)[0]
    reference = simulate(
        NOMINAL,
        time=np.linspace(0.0, 0.25, 3),
        theta_start=start[0],
        omega_start=start[1],
        torque=lambda time: 0.6 * math.sin(8.0 * math.pi * time),
    )
    # The reference is right to 1e-10 rad; the straight lines of the table cost 3e-11 rad and 2e-9 rad/s.
    assert found[0] == pytest.approx(reference.theta[-1], abs=5e-10)
    assert found[1] == pytest.approx(reference.omega[-1], abs=2e-8)


def test_the_large_motion_at_4_hz(shaken: ShakenJoystick) -> None:
    found = solve(shaken.smooth(), np.array([-0.38, -5.5]), 4.0, shaken.scales[:2])
    assert found.is_stable
    first, second = found.exponents(0.25)
    # Constant damping: phase areas shrink by exp(-C T/J), and a complex pair shares that evenly.
    assert first.real == pytest.approx(-0.5 * C_OVER_J, rel=1e-6)
    assert second == pytest.approx(first.conjugate())
    assert abs(first.imag) == pytest.approx(3.0274, abs=1e-4)
    high, low = shaken.orbit(found.state, 4.0).extremes
    assert math.degrees(-low) == pytest.approx(25.57, abs=0.005)
    assert -low > high


def test_the_unstable_motion_at_4_hz(shaken: ShakenJoystick) -> None:
    found = solve(shaken.smooth(), np.array([0.0005, 0.23]), 4.0, shaken.scales[:2])
    assert found.multipliers[0] == pytest.approx(-1.366, abs=1e-3)
    assert not found.is_stable
    assert np.prod(found.multipliers).real == pytest.approx(math.exp(-0.25 * C_OVER_J), rel=1e-5)
    assert math.degrees(shaken.orbit(found.state, 4.0).extremes[0]) == pytest.approx(0.41, abs=0.005)


def test_two_periods_have_the_square_of_the_monodromy(shaken: ShakenJoystick) -> None:
    once = solve(shaken.smooth(), np.array([-0.38, -5.5]), 4.0, shaken.scales[:2])
    longer = shaken.with_periods(2)
    twice = solve(longer.smooth(), once.state, 4.0, longer.scales[:2])
    assert twice.state == pytest.approx(once.state, abs=1e-9)
    expected = once.map.monodromy @ once.map.monodromy
    scale = shaken.scales[:2]
    difference = (twice.map.monodromy - expected) * scale[None, :] / scale[:, None]
    assert np.max(np.abs(difference)) < 1e-7


def test_the_power_law() -> None:
    with Fmu("JoystickPowerLaw") as fmu:
        shaken = ShakenJoystick(fmu, NOMINAL_POWER_LAW, Shaking(0.6, 4.0))
        found = solve(shaken.smooth(), np.array([-0.376, -2.4]), 4.0, shaken.scales[:2])
    exponent = found.exponents(0.25)[0]
    assert exponent.real == pytest.approx(-2.52172, abs=2e-5)
    assert abs(exponent.imag) == pytest.approx(2.52785, abs=2e-5)


def test_kinks_lie_where_the_contact_force_has_them(shaken: ShakenJoystick) -> None:
    kinks = shaken.kinks(4.0)
    assert list(kinks)[:4] == [f"forward x_{i}" for i in range(4)]
    assert math.degrees(kinks["backward x_3"]) == pytest.approx(-7.377, abs=1e-3)


def test_a_parameter_of_the_joystick_may_be_free(fmu: Fmu) -> None:
    shaken = ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0), free="damping.C")
    assert shaken.value == 0.045
    found = solve(shaken.smooth(), np.array([-0.38, -5.5]), 0.05, shaken.scales[:2])
    assert np.prod(found.multipliers).real == pytest.approx(math.exp(-0.25 * 0.05 / 0.01135), rel=1e-6)


def test_what_cannot_be_searched_is_refused(fmu: Fmu, shaken: ShakenJoystick) -> None:
    with pytest.raises(ParameterError, match=r"torque = 0.0: must be a finite number above 0 N\.m"):
        Shaking(0.0, 4.0)
    with pytest.raises(ParameterError, match="frequency"):
        Shaking(0.6, -1.0)
    with pytest.raises(UnknownParameterError, match=r"damping\.C"):
        ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0), free="damping.D")
    with pytest.raises(ParameterError, match="no derivatives"):
        ShakenJoystick(fmu, NOMINAL.replace({"friction.T_c": 0.01}), Shaking(0.6, 4.0))
    assert np.isnan(shaken.images(np.array([[1.6, 0.0], [0.0, 0.0]]), 4.0)[0]).all()
    with pytest.raises(NoSolutionError, match="a run fails"):
        solve(shaken.smooth(), np.array([1.6, 0.0]), 4.0, shaken.scales[:2])
