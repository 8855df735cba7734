from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from pyjoystick.identification import (
    DampingEstimateError,
    bias_table,
    constant_bias,
    estimate_damping,
    line_bias,
)
from pyjoystick.model import NOMINAL, ActuatorAssembly, JoystickParameters, RestrainedSpring
from pyjoystick.motion import ReleasePeaks
from pyjoystick.support import SimulationError
from tests.pyjoystick.releases import reference_release

NEVER = RestrainedSpring(k_s=1.0, k_h=1.0, F_0=0.0, x_0=1.0)


def _joystick(spring: RestrainedSpring, damping: float) -> JoystickParameters:
    """A joystick with one spring a side, no weight and a flat cam."""
    side = ActuatorAssembly(return_spring=spring, balance_spring=NEVER)
    joystick = dataclasses.replace(NOMINAL, m=0.0, b=0.0, forward=side, backward=side)
    return joystick.replace({"damping.C": damping})


@pytest.mark.parametrize(
    ("spring", "exponent"),
    [
        (RestrainedSpring(k_s=1e-3, k_h=1e8, F_0=60.0, x_0=0.0), 1.0),
        (RestrainedSpring(k_s=4000.0, k_h=1.0, F_0=0.0, x_0=0.0), 2.0),
    ],
    ids=["preload alone", "linear"],
)
def test_the_factors_of_the_virial_theorem(spring: RestrainedSpring, exponent: float) -> None:
    """Of a potential |theta|^s, for light damping and small angles; geometry and damping cost the rest."""
    joystick = _joystick(spring, 0.01)
    found = estimate_damping([reference_release(joystick, -0.1)], joystick.J).constants
    assert found["displacement"].value / 0.01 == pytest.approx(4.0 / (exponent + 2.0), rel=0.02)
    assert found["velocity"].value / 0.01 == pytest.approx(2.0 * exponent / (exponent + 2.0), rel=0.02)


def test_the_paper_joystick_is_off_by_a_quarter_either_way() -> None:
    """The table of docs/damping-from-peaks.md in two rows."""
    table = bias_table(NOMINAL, [0.03, 0.045], [math.radians(-20.0)], reference_release)
    assert table["C"].tolist() == [0.03, 0.045]
    assert table["displacement"].to_numpy() == pytest.approx([1.264, 1.259], abs=0.002)
    assert table["velocity"].to_numpy() == pytest.approx([0.754, 0.745], abs=0.002)
    assert table["both"].to_numpy() == pytest.approx([1.009, 1.002], abs=0.002)


def test_the_corrected_constant_is_the_true_one() -> None:
    angle = math.radians(-20.0)
    truth = NOMINAL.replace({"damping.C": 0.052})
    estimate = estimate_damping([reference_release(truth, angle)], NOMINAL.J)
    for name, bias in constant_bias(estimate, NOMINAL, angle, reference_release).items():
        assert bias.estimate == estimate.constants[name].value
        assert bias.corrected == pytest.approx(0.052, abs=5e-6)
        assert bias.bias == bias.returned - bias.estimate
    assert abs(constant_bias(estimate, NOMINAL, angle, reference_release)["both"].bias) < 0.001


def test_an_estimate_that_no_constant_returns_is_refused() -> None:
    angle = math.radians(-20.0)
    release = reference_release(NOMINAL, angle)
    estimate = estimate_damping([release], NOMINAL.J)
    with pytest.raises(DampingEstimateError, match=r"no constant C from 0\.0227 to 0\.142"):
        constant_bias(estimate, NOMINAL, angle, lambda joystick, start: release)


def test_the_lines_are_corrected_towards_the_truth() -> None:
    """With constant C the corrected power laws are within 8 % of it at the heights of the peaks."""
    angle = math.radians(-20.0)
    estimate = estimate_damping([reference_release(NOMINAL, angle)], NOMINAL.J)
    biases = line_bias(estimate, NOMINAL, angle, reference_release)
    assert set(biases) == {"A_pos", "n_pos", "A_neg", "n_neg", "B", "m"}
    for coefficient, exponent, heights in (
        ("A_pos", "n_pos", np.radians([2.8, 14.0])),
        ("A_neg", "n_neg", np.radians([3.1, 11.0])),
        ("B", "m", np.array([3.0, 7.5])),
    ):
        corrected = biases[coefficient].corrected * heights ** biases[exponent].corrected
        assert corrected == pytest.approx(0.045, rel=0.08)
        assert biases[coefficient].estimate * heights ** biases[exponent].estimate != pytest.approx(
            0.045, rel=0.15
        )


def test_lines_that_no_joystick_can_follow_are_told() -> None:
    angle = math.radians(-20.0)
    estimate = estimate_damping([reference_release(NOMINAL, angle)], NOMINAL.J)

    def fails(joystick: JoystickParameters, start: float) -> ReleasePeaks:
        raise SimulationError(0.1, "too stiff")

    with pytest.raises(DampingEstimateError, match=r"n_pos = .*, n_neg = .* cannot be simulated.*too stiff"):
        line_bias(estimate, NOMINAL, angle, fails)


def test_lines_of_which_no_peak_is_left_are_told_as_such() -> None:
    """The peaks of the records were enough; those of a joystick that follows the lines are not."""
    release = reference_release(NOMINAL, math.radians(-20.0))
    estimate = estimate_damping([release], NOMINAL.J)
    damped = NOMINAL.replace({"damping.C": 2.0})
    with pytest.raises(
        DampingEstimateError, match=r"a joystick with n_pos = .*, n_neg = .* swings too little.*dry friction"
    ):
        line_bias(estimate, damped, 0.0, lambda *_: reference_release(damped, math.radians(-20.0)))
