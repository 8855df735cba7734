"""The statements of section 5 on the torque, as numbers."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pyjoystick.forced_motion import Samples
from pyjoystick.model import NOMINAL_POWER_LAW
from pyjoystick.reports import MOTION, section_5


def test_the_quick_stroke_fits_the_paper_but_for_the_damping_ratio() -> None:
    found = section_5()
    assert found.inertia_to_stiffness == pytest.approx(0.65, abs=0.01)
    assert found.damping_to_total["constant"] == pytest.approx(0.079, abs=0.001)
    assert found.damping_to_total["power-law"] == pytest.approx(0.120, abs=0.001)
    assert found.damping_ratio == pytest.approx(1.55, abs=0.01)


def test_a_falling_coefficient_would_double_the_damping() -> None:
    """Section 3.3 calls the slopes of Fig. 9 negative; n_pos is printed as positive."""
    falling = section_5(power_law=NOMINAL_POWER_LAW.replace({"damping.n_pos": -0.084}))
    assert falling.damping_ratio == pytest.approx(2.09, abs=0.01)


def test_slow_strokes_do_not_fit() -> None:
    slow = section_5(replace(MOTION, rise=0.3))
    assert slow.inertia_to_stiffness < 0.12
    assert slow.damping_to_total["constant"] < 0.05


def test_sampled_motions_give_the_same() -> None:
    found = section_5(Samples.evenly(MOTION, 1e-4))
    assert found.loss_ratio == pytest.approx(section_5().loss_ratio, rel=1e-6)
