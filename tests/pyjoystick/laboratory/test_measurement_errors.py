"""The measuring chain applied to known motions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.laboratory import (
    Chain,
    ChainEffect,
    LowPass,
    StageError,
    chain_effect,
    error_budget,
    error_budget_report,
)
from pyjoystick.model import NOMINAL_POWER_LAW


@pytest.fixture(scope="module")
def budget() -> dict[str, StageError]:
    random = np.random.default_rng(6)
    stages = error_budget(NOMINAL_POWER_LAW, Chain(), release_angle=math.radians(-20.0), random=random)
    return {one.stage: one for one in stages}


def test_the_filter_is_the_largest_part_of_the_error_of_the_velocity(budget: dict[str, StageError]) -> None:
    others = [one.omega for name, one in budget.items() if name != "filter" and not name.startswith("all")]
    assert budget["filter"].omega > 2.0 * max(others)
    assert budget["all"].omega == pytest.approx(budget["filter"].omega, rel=0.05)
    assert budget["differentiation"].theta == 0.0
    assert budget["differentiation"].omega < 0.01 * budget["filter"].omega


def test_the_rest_position_in_the_clearance_moves_the_angle_alone(budget: dict[str, StageError]) -> None:
    whole, moved = budget["all"], budget["all, zero at rest"]
    assert moved.omega == pytest.approx(whole.omega, rel=1e-9)
    offset = math.sqrt(moved.theta**2 - whole.theta**2)
    # The contact begins at 0.075 mm: 0.179 degrees.
    assert offset == pytest.approx(math.radians(0.18), rel=0.2)


def test_without_noise_the_markers_add_nothing_to_the_spline() -> None:
    stages = error_budget(
        NOMINAL_POWER_LAW,
        Chain(),
        release_angle=math.radians(-20.0),
        random=np.random.default_rng(6),
        noise=0.0,
    )
    spline, markers = (next(one for one in stages if word in one.stage) for word in ("camera", "noise"))
    # The sideways motion of the synthetic top, 2 %, tilts the plane a little.
    assert markers.theta == pytest.approx(spline.theta, abs=math.radians(0.03))
    assert markers.omega == pytest.approx(spline.omega, rel=0.05)


def test_the_report_has_a_row_for_each_stage(budget: dict[str, StageError]) -> None:
    report = error_budget_report(list(budget.values()))
    assert len(report.splitlines()) == 2 + len(budget)
    assert "velocity (rad/s)" in report


def _effect(chain: Chain, camera_rate: float = 60.0) -> ChainEffect:
    return chain_effect(NOMINAL_POWER_LAW, chain, release_angle=math.radians(-20.0), camera_rate=camera_rate)


@pytest.fixture(scope="module")
def paper() -> ChainEffect:
    return _effect(Chain())


def test_the_papers_chain_underestimates_the_peaks_of_the_velocity(paper: ChainEffect) -> None:
    np.testing.assert_allclose(paper.shortfall[:4], [0.067, 0.108, 0.127, 0.163], atol=2e-3)
    assert (paper.shortfall[:10] > 0.05).all()
    assert paper.shortfall[9] == pytest.approx(0.426, abs=0.01)


def test_and_so_the_energy_seems_to_rise_where_it_truly_falls(paper: ChainEffect) -> None:
    assert paper.true_rise < 1e-12 * paper.energy_start
    assert paper.energy_rise / paper.energy_start == pytest.approx(0.059, abs=0.002)


def test_the_filter_does_it_not_the_differentiation_nor_the_camera() -> None:
    fast = _effect(Chain(), camera_rate=1000.0)
    assert fast.energy_rise / fast.energy_start == pytest.approx(0.059, abs=0.002)
    coarse = _effect(Chain(velocity_points=3))
    assert coarse.energy_rise / coarse.energy_start == pytest.approx(0.059, abs=0.003)
    open_filter = _effect(Chain(low_pass=LowPass(cutoff=100.0)), camera_rate=1000.0)
    assert np.abs(open_filter.shortfall[:10]).max() < 0.015
    assert open_filter.energy_rise / open_filter.energy_start < 2e-3


def test_a_corrected_cutoff_loses_less(paper: ChainEffect) -> None:
    corrected = _effect(Chain(low_pass=LowPass(corrected=True)))
    assert (corrected.shortfall[:10] < paper.shortfall[:10]).all()
    assert corrected.energy_rise < paper.energy_rise
    assert corrected.theta_error < paper.theta_error
