from __future__ import annotations

import math
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW, Fmu
from pyjoystick.fmu import FmuRunError, Plan
from pyjoystick.forced_motion import NoSolutionError, ShakenJoystick, Shaking, solve
from pyjoystick.model import simulate
from pyjoystick.support import FloatArray, ParameterError, UnknownParameterError

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
    assert first.real == pytest.approx(-0.5 * C_OVER_J, rel=1e-9)
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


@pytest.fixture
def differences(joystick_fmus: Path, tmp_path: Path) -> Iterator[Fmu]:
    """The joystick with no FMU beside it that has sensitivities."""
    shutil.copy(joystick_fmus / "Joystick.fmu", tmp_path)
    with Fmu(tmp_path / "Joystick.fmu") as opened:
        yield opened


@pytest.mark.parametrize("state", [(-0.38, -5.5), (0.0005, 0.23)])
def test_derivatives_are_exact_by_sensitivities(
    shaken: ShakenJoystick, differences: Fmu, state: tuple[float, float]
) -> None:
    start, scales = np.array(state), shaken.scales[:2]
    exact = shaken.smooth()(start, 4.0)
    assert shaken.is_exact
    assert exact.error is None
    # Phase areas shrink by exp(-C T/J), whatever the springs do.
    assert np.linalg.det(exact.monodromy) == pytest.approx(math.exp(-0.25 * C_OVER_J), rel=1e-11)
    other = ShakenJoystick(differences, NOMINAL, Shaking(0.6, 4.0))
    assert not other.is_exact
    assert other.tangents() is None
    near = other.smooth()(start, 4.0)
    assert near.error is not None
    apart = np.abs(exact.monodromy - near.monodromy) * scales[None, :] / scales[:, None]
    assert np.max(apart) < 2e-8  # the noise of runs at 1e-12 over steps of 1e-5
    images, monodromies = shaken.tangents()(start[None, :], 4.0)  # type: ignore[misc]
    assert images[0] == pytest.approx(exact.image, abs=1e-7)
    assert np.max(np.abs(monodromies[0] - exact.monodromy) * scales[None, :] / scales[:, None]) < 1e-6


@pytest.mark.parametrize("free", ["frequency", "J", "damping.C", "torque"])
def test_derivatives_by_the_free_parameter(fmu: Fmu, free: str) -> None:
    """By a parameter, or in the time f t from those by J and C; the torque has none. Against differences."""
    shaken = ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0), free=free)
    start, value, step = np.array([-0.38, -5.5]), shaken.value, 1e-4
    up, down, half_up, half_down = (
        shaken.images(start[None, :], value * (1.0 + part * step))[0] for part in (1.0, -1.0, 0.5, -0.5)
    )
    wide, narrow = (up - down) / (2.0 * step * value), (half_up - half_down) / (step * value)
    expected = (4.0 * narrow - wide) / 3.0
    # The torque's own difference is one-sided, with a step of 1e-5.
    accuracy = 1e-6 if free == "torque" else 1e-7
    assert shaken.smooth()(start, value).by_parameter() == pytest.approx(expected, rel=accuracy)


def test_where_a_motion_touches_a_kink_derivatives_are_differences(
    shaken: ShakenJoystick, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The FMU has no sensitivities beyond such an event, and ends the run."""
    state = np.array([-0.38, -5.5])
    exact = shaken.smooth()(state, 4.0)
    monkeypatch.setattr(Plan, "run", _failing_with_sensitivities(Plan.run))
    found = shaken.smooth()(state, 4.0)
    assert found.error is not None
    assert found.monodromy == pytest.approx(exact.monodromy, rel=1e-6)
    images, monodromies = shaken.tangents()(state[None, :], 4.0)  # type: ignore[misc]
    assert images[0] == pytest.approx(exact.image, abs=1e-12)
    assert monodromies[0] == pytest.approx(found.monodromy, rel=1e-12)


def _failing_with_sensitivities(run: Callable[..., FloatArray]) -> Callable[..., FloatArray]:
    def failing(plan: Plan, values: FloatArray) -> FloatArray:
        if any(name.startswith("sensitivity.") for name in plan.outputs):
            raise FmuRunError(0.1, "fmi2DoStep: error", Path("Joystick.fmu"))
        return run(plan, values)

    return failing


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
