"""The spring values that follow from Table 1, as printed to the digits given in the physics notes."""

from __future__ import annotations

import pytest

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, RestrainedSpring


@pytest.mark.parametrize(
    ("spring", "k_s", "k_h", "preload"),
    [
        (NOMINAL.forward.return_spring, 2625.0, 427375.0, 52.7808),
        (NOMINAL.forward.balance_spring, 2975.0, 1022400.0, 11.2464),
        (NOMINAL.backward.return_spring, 1191.0, 657809.0, 55.5849),
        (NOMINAL.backward.balance_spring, 2899.0, 1107910.0, 9.9712),
    ],
)
def test_springs_of_table_1(spring: RestrainedSpring, k_s: float, k_h: float, preload: float) -> None:
    assert spring.k_s == k_s
    assert spring.k_h == k_h
    assert pytest.approx(preload, abs=5e-5) == spring.F_0


def test_the_two_nominal_joysticks_differ_in_damping_only() -> None:
    constant, power_law = NOMINAL.to_names(), NOMINAL_POWER_LAW.to_names()
    shared = {name for name in constant if not name.startswith("damping.")}
    assert {name: power_law[name] for name in shared} == {name: constant[name] for name in shared}
    assert constant["damping.C"] == 0.045
    assert power_law["damping.alpha"] == 0.9
