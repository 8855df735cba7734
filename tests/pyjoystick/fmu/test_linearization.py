"""Linearizations of the joystick against manual derivatives and its own motion."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.linalg import expm

from pyjoystick.fmu import Fmu, Linearization, UnsupportedFmuError
from pyjoystick.fmu.instance import Instance
from pyjoystick.model import NOMINAL
from pyjoystick.support import ParameterError, UnknownInputError
from tests.joystick_fmu.analytic import jacobian
from tests.pyjoystick.fmu.doctored import doctored

OUTPUTS = ("alpha", "M_s", "E")


@pytest.fixture(scope="module")
def joystick(joystick_fmus: Path) -> Fmu:
    return Fmu(joystick_fmus / "Joystick.fmu")


def test_matrices_by_hand(joystick: Fmu) -> None:
    start = {"theta_start": 0.2, "omega_start": -1.5}
    found = joystick.linearize(parameters=start, inputs={"T": 0.4}, outputs=OUTPUTS)
    by_hand = jacobian(NOMINAL.to_names(), 0.2, -1.5, 0.4)
    slope, damping = by_hand["alpha", "theta"], by_hand["alpha", "omega"]
    pd.testing.assert_frame_equal(
        found.A,
        pd.DataFrame([[0.0, 1.0], [slope, damping]], ["theta", "omega"], ["theta", "omega"]),
        rtol=1e-12,
    )
    expected_b = pd.DataFrame([[0.0], [1.0 / NOMINAL.J]], ["theta", "omega"], ["T"])
    pd.testing.assert_frame_equal(found.B, expected_b, rtol=1e-12)
    c = [[by_hand.get((output, state), 0.0) for state in ("theta", "omega")] for output in OUTPUTS]
    pd.testing.assert_frame_equal(found.C, pd.DataFrame(c, OUTPUTS, ["theta", "omega"]), rtol=1e-12)
    d = [[by_hand.get((output, "T"), 0.0)] for output in OUTPUTS]
    pd.testing.assert_frame_equal(found.D, pd.DataFrame(d, OUTPUTS, ["T"]), rtol=1e-12)
    assert found.point["theta"] == 0.2
    assert found.point["T"] == 0.4


def test_along_a_motion(joystick: Fmu) -> None:
    """At a later time the point is that of the motion, and earlier calls leave no trace."""
    start = {"theta_start": math.radians(-20.0)}
    table = joystick.run(np.linspace(0.0, 0.1, 11), parameters=start, outputs=["theta", "omega"])
    for time in (0.1, 0.05, 0.1):
        found = joystick.linearize(time, parameters=start)
        theta, omega = table.loc[time, ["theta", "omega"]]
        assert (found.point["theta"], found.point["omega"]) == pytest.approx((theta, omega), abs=1e-8)
        by_hand = jacobian(NOMINAL.to_names(), found.point["theta"], found.point["omega"], 0.0)
        assert found.A.loc["omega", "theta"] == pytest.approx(by_hand["alpha", "theta"], rel=1e-12)


def test_poles_in_the_clearance_are_those_of_the_swing_test(joystick: Fmu) -> None:
    """Without springs and damping, theta'' = (m*g*h/J)*theta: the pendulum of the swing test upside down."""
    found = joystick.linearize(parameters={"theta_start": 1e-6, "damping.C": 0.0})
    swing = math.sqrt(NOMINAL.m * NOMINAL.g * NOMINAL.h / NOMINAL.J)
    poles = found.poles()
    assert list(poles["real"]) == pytest.approx([-swing, swing], rel=1e-9)
    assert list(poles["imaginary"]) == [0.0, 0.0]
    assert list(poles["damping"]) == pytest.approx([1.0, -1.0])
    assert swing / (2.0 * math.pi) == pytest.approx(1.25, abs=0.01)


def test_a_small_motion_is_that_of_the_linear_system(joystick: Fmu) -> None:
    """Around the angle where a constant torque holds the handle, with the springs released."""
    rest, offset = 0.06, 1e-6
    held = joystick.linearize(parameters={"theta_start": rest}).point
    torque = held["M_s"] - held["M_g"]
    linear = joystick.linearize(parameters={"theta_start": rest}, inputs={"T": torque})
    time = np.linspace(0.0, 0.3, 31)
    start = {"theta_start": rest + offset}
    motion = joystick.run(time, parameters=start, inputs={"T": torque}, tolerance=1e-12)["theta"] - rest
    expected = [offset * expm(linear.A.to_numpy() * t)[0, 0] for t in time]
    assert np.abs(motion - expected).max() < 1e-3 * offset
    pair = linear.poles()
    assert pair["frequency"].iloc[0] == pytest.approx(math.sqrt(-linear.A.loc["omega", "theta"]), rel=1e-12)
    assert 0.0 < pair["damping"].iloc[0] < 1.0


@pytest.mark.parametrize(("step", "count"), [(None, 500), (0.1, 5), (0.3, 2), (2.0, 1)])
def test_the_point_is_reached_in_communication_steps(
    joystick: Fmu, monkeypatch: pytest.MonkeyPatch, step: float | None, count: int
) -> None:
    """Some FMUs integrate with them; by default, those of the FMU's default experiment."""
    taken = []

    def advance(instance: Instance, time: float, length: float) -> None:
        taken.append((time, length))

    monkeypatch.setattr(Instance, "step", advance)
    joystick.linearize(0.5, step=step)
    starts, lengths = np.array(taken).T
    np.testing.assert_allclose(lengths, 0.5 / count)
    np.testing.assert_allclose(starts, np.arange(count) * 0.5 / count)


def test_what_is_refused(joystick: Fmu) -> None:
    with pytest.raises(ParameterError, match=r"step = 1e-09: must be at least 1e-06 s, 1000000 steps"):
        joystick.linearize(1.0, step=1e-9)
    with pytest.raises(ParameterError, match="time"):
        joystick.linearize(-0.1)
    with pytest.raises(UnknownInputError, match="torque"):
        joystick.linearize(inputs={"torque": 1.0})


def test_both_versions_give_the_same(joystick: Fmu, joystick_fmus3: Path) -> None:
    settings = {"parameters": {"theta_start": 0.2, "omega_start": -1.5}, "inputs": {"T": 0.4}}
    with Fmu(joystick_fmus3 / "Joystick.fmu") as third:
        assert third.description.directional_derivatives
        assert third.description.adjoint_derivatives
        for time in (0.0, 0.05):
            found, expected = (fmu.linearize(time, outputs=OUTPUTS, **settings) for fmu in (third, joystick))
            for name in ("A", "B", "C", "D"):
                pd.testing.assert_frame_equal(getattr(found, name), getattr(expected, name), check_exact=True)


@pytest.mark.parametrize("kind", ["Directional", "Adjoint"])
def test_a_foreign_fmu_with_arrays(echo3_path: Path, tmp_path: Path, kind: str) -> None:
    """It answers 0 for an output that is a state."""

    def declared(text: str) -> str:
        return text.replace("providesDirectionalDerivatives", f"provides{kind}Derivatives")

    with Fmu(doctored(echo3_path, tmp_path / "echo.fmu", description=declared)) as fmu:
        found = fmu.linearize(0.1, inputs={"force": 2.0})
        _check_the_oscillator(found, ["x[1]", "x[2]"], ["x[1]", "x[2]", "y"])
        assert found.point.to_dict() == {"x[1]": 0.0, "x[2]": 0.0, "force": 2.0, "y": 2.0}
        chosen = fmu.linearize(outputs=["y", "x[2]"])
        _check_the_oscillator(chosen, ["x[1]", "x[2]"], ["y", "x[2]"])
        with pytest.raises(ParameterError, match="outputs = p_again_Int8: must be a real variable"):
            fmu.linearize(outputs=["p_again_Int8"])


def test_outputs_that_are_states_or_inputs(echo2: Fmu) -> None:
    _check_the_oscillator(echo2.linearize(0.1), ["x", "v"], ["x", "v", "y", "force_again"])


def _check_the_oscillator(found: Linearization, states: list[str], outputs: list[str]) -> None:
    """X'' = -4 x - 0.5 x' + 3 force; y = 2 x' + force."""
    slopes = {
        states[0]: [1.0, 0.0, 0.0],
        states[1]: [0.0, 1.0, 0.0],
        "y": [0.0, 2.0, 1.0],
        "force_again": [0, 0, 1],
    }
    assert list(found.A.index) == list(found.A.columns) == list(found.C.columns) == states
    assert found.A.to_numpy().tolist() == [[0.0, 1.0], [-4.0, -0.5]]
    assert found.B["force"].tolist() == [0.0, 3.0]
    assert list(found.C.index) == list(found.D.index) == outputs
    assert np.column_stack([found.C, found.D]).tolist() == [slopes[name] for name in outputs]


def test_an_fmu_without_derivatives(echo2_path: Path, tmp_path: Path) -> None:
    def silent(text: str) -> str:
        return text.replace('providesDirectionalDerivative="true"', "")

    with (
        Fmu(doctored(echo2_path, tmp_path / "echo.fmu", description=silent)) as fmu,
        pytest.raises(UnsupportedFmuError, match="provides neither directional nor adjoint derivatives"),
    ):
        fmu.linearize()
