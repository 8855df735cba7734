"""The operator's load over a shift."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.forced_motion import (
    MOVES_PER_SHIFT,
    PRELOADS,
    STIFFNESSES,
    Demand,
    ForwardAndReturn,
    MoveDistribution,
    Samples,
    demands,
    faster,
    measure,
    scaled,
    torque_by_reference,
)
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, PIVOT_TO_TOP
from pyjoystick.support import ParameterError, UnknownParameterError

MOVES = MoveDistribution().draw(5, seed=2)


@pytest.mark.usefixtures("fmus_by_name")
def test_one_move_is_the_measures_of_that_move() -> None:
    move = ForwardAndReturn(amplitude=0.25, rise=0.2, dwell=0.3)
    (found,) = demands([NOMINAL], [move])
    samples = Samples.of(NOMINAL, move)
    expected = measure(NOMINAL, samples, torque_by_reference(NOMINAL, samples))
    assert found.positive_work == pytest.approx(expected.positive_work, rel=1e-12)
    assert found.negative_work == pytest.approx(expected.negative_work, rel=1e-12)
    assert found.impulse == pytest.approx(expected.total.impulse, rel=1e-12)
    assert found.torque(100.0) == pytest.approx(expected.total.peak, rel=1e-12)
    assert found.force(100.0) == pytest.approx(expected.peak_force, rel=1e-12)
    assert found.time == pytest.approx(move.duration, rel=1e-12)
    assert found.work_per_shift() == MOVES_PER_SHIFT * found.positive_work
    assert found.impulse_per_shift(10) == pytest.approx(10 * expected.total.impulse / PIVOT_TO_TOP)


@pytest.mark.usefixtures("fmus_by_name")
def test_percentiles_are_parts_of_the_time() -> None:
    """Against the sorted magnitudes of samples that are even in time."""
    move = ForwardAndReturn(amplitude=-0.3, rise=0.25, dwell=0.1)
    (found,) = demands([NOMINAL], [move])
    even = Samples.evenly(move, 1e-5)
    magnitude = torque_by_reference(NOMINAL, even)["T"].abs()
    for percentage in (10.0, 25.0, 50.0, 90.0):
        expected = float(np.percentile(magnitude, percentage))
        assert found.torque(percentage) == pytest.approx(expected, rel=0.02)
    assert np.all(np.diff(found.levels) >= 0.0)


@pytest.mark.usefixtures("fmus_by_name")
def test_what_changes_the_load() -> None:
    """Half the preload nearly halves force and work; speed asks for higher peaks, and less impulse."""
    preload, nominal, stiff = demands(
        [scaled(NOMINAL, PRELOADS, 0.5), NOMINAL, scaled(NOMINAL, STIFFNESSES, 2.0)], MOVES
    )
    (quick,) = demands([NOMINAL], faster(MOVES, 2.0))

    def ratio(one: Demand, percentage: float) -> float:
        return one.force(percentage) / nominal.force(percentage)

    assert 0.5 < ratio(preload, 50.0) < 0.65
    assert 0.5 < preload.positive_work / nominal.positive_work < 0.65
    assert 1.0 < ratio(stiff, 50.0) < ratio(stiff, 90.0) < 1.6
    assert ratio(quick, 100.0) > 1.5
    assert quick.impulse < 0.9 * nominal.impulse
    assert quick.time < nominal.time


def test_moves_are_drawn_within_their_ranges() -> None:
    settings = MoveDistribution(backward=0.25)
    moves = settings.draw(400, seed=1)
    assert moves == settings.draw(400, seed=1)
    assert moves != settings.draw(400, seed=2)
    angles = np.array([move.amplitude for move in moves])
    assert math.radians(4.0) <= np.abs(angles).min() < np.abs(angles).max() <= math.radians(18.0)
    assert np.mean(angles < 0.0) == pytest.approx(0.25, abs=0.06)
    of_largest = [move.rise / math.sqrt(abs(move.amplitude) / math.radians(18.0)) for move in moves]
    assert np.median(of_largest) == pytest.approx(0.25, rel=0.05)


def test_half_the_time_for_the_strokes_alone() -> None:
    (move,) = faster([ForwardAndReturn(amplitude=0.2, rise=0.2, dwell=0.3)], 2.0)
    assert (move.rise, move.return_time, move.dwell) == (0.1, 0.1, 0.3)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"smallest": 0.0}, "smallest = 0.0"),
        ({"largest": 0.01}, "largest = 0.01: must be at least the smallest"),
        ({"stroke": 0.0}, "stroke = 0.0"),
        ({"spread": -1.0}, "spread = -1.0"),
        ({"dwell": math.nan}, "dwell = nan"),
        ({"backward": 1.5}, "backward = 1.5: must be from 0 to 1"),
    ],
)
def test_what_is_refused(settings: dict[str, float], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        MoveDistribution(**settings)


@pytest.mark.usefixtures("fmus_by_name")
def test_nothing_to_do_and_joysticks_that_the_fmu_refuses() -> None:
    with pytest.raises(ParameterError, match="an empty sequence"):
        demands([], MOVES)
    with pytest.raises(ParameterError, match="pivot_to_handle"):
        demands([NOMINAL], MOVES, pivot_to_handle=0.0)
    with pytest.raises(ParameterError, match=r"g = -9\.8: must be a finite number"):
        demands([NOMINAL.replace({"g": -9.8})], MOVES)
    with Fmu("JoystickInverse") as fmu, pytest.raises(UnknownParameterError, match=r"damping\.alpha"):
        demands([NOMINAL_POWER_LAW], MOVES, fmu=fmu)
