from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.laboratory import Chain, ChainEffect, LowPass, chain_effect
from pyjoystick.model import NOMINAL_POWER_LAW


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
