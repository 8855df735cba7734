"""Checks of residuals with known properties; benchmarks/fit_checks measures their power on fits."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from pyjoystick.identification.fitting.checks.outliers import find_outliers
from pyjoystick.identification.fitting.checks.repeats import Repeats, find_repeats
from pyjoystick.identification.fitting.checks.residual_checks import (
    Series,
    check_clipping,
    check_outliers,
    check_repeats,
    check_whiteness,
    repeats_freedom,
    whiteness,
)
from pyjoystick.identification.fitting.problem.noise_color import Block, Memory, estimated_correlation
from pyjoystick.support import FloatArray

N = 97
WAVE = 0.6 * np.sin(np.linspace(0.0, 25.0, N))


def _noise(seed: int, count: int = 4) -> list[FloatArray]:
    return list(np.random.default_rng(seed).standard_normal((count, N)))


def _series(values: list[FloatArray]) -> list[Series]:
    return [Series(f"run {k}", one, np.zeros((N, 1))) for k, one in enumerate(values)]


def _colored(correlation: float, seed: int) -> list[FloatArray]:
    memory = Memory.of(["theta"] * N, correlation)
    return [memory.noise(one) for one in _noise(seed)]


def test_white_noise_is_white_and_a_wave_that_no_single_record_shows_is_not() -> None:
    """The chances of single records leave the wave to chance; pooled over four, they do not."""
    noise = _noise(5)
    assert whiteness(_series(noise)).chance > 0.05
    waved = [one + WAVE for one in noise]
    found = whiteness(_series(waved))
    assert found.chance < 5e-3
    assert all(whiteness(_series([one])).chance > 1e-3 for one in waved)
    check = check_whiteness(found, 0.0)
    assert not check.passed
    assert "the model lacks something" in check.message


def test_chances_of_records_are_pooled_by_fishers_method() -> None:
    """Correlations of both signs vanish in the averages; Ljung's and Box's formula and SciPy find them."""
    values = [*_colored(0.3, 1)[:2], *_colored(-0.3, 2)[:2]]
    chances = []
    for one in values:
        squares = [(one[k:] @ one[:-k] / (one @ one)) ** 2 / (N - k) for k in range(1, 6)]
        chances.append(stats.chi2.sf(N * (N + 2) * sum(squares), 5))
    pooled = stats.combine_pvalues(chances, "fisher").pvalue
    found = whiteness([Series(f"run {k}", one, np.zeros((N, 1))) for k, one in enumerate(values)])
    # The least of three chances.
    assert found.chance == pytest.approx(3.0 * pooled)


def test_residuals_without_power_say_nothing() -> None:
    noise = _noise(5, count=3)
    assert whiteness(_series([*noise, np.full(N, 1e-300)])) == whiteness(_series(noise))
    assert whiteness(_series([np.zeros(N)])).chance == 1.0


def test_white_noise_fails_as_seldom_as_is_said() -> None:
    """Once in two hundred fits, here of three lines a record; 400 sets, so at most six of them."""
    lines = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, N), 3))[0]
    failed = 0
    for seed in range(400):
        left = [one - lines @ (lines.T @ one) for one in _noise(seed)]
        found = whiteness([Series(f"run {k}", one, lines) for k, one in enumerate(left)])
        failed += not check_whiteness(found, 0.0).passed
    assert failed <= 6


def test_the_color_of_noise_is_found_behind_what_was_fitted() -> None:
    columns = np.vander(np.linspace(-1.0, 1.0, N), 3)
    basis = np.linalg.qr(columns)[0]
    found = []
    for seed in range(20):
        left = [one - basis @ (basis.T @ one) for one in _colored(0.8, seed)]
        blocks = [
            Block(["theta"] * N, one, np.kron(np.eye(4)[k], columns), np.ones(N))
            for k, one in enumerate(left)
        ]
        found.append(estimated_correlation(blocks))
    # Four records know it to 0.03, twenty sets to 0.007; three lines a record leave a bias of a twentieth.
    assert abs(np.mean(found) - 0.8) < 0.06


def test_what_repeats_have_in_common_is_no_color_of_the_noise() -> None:
    left = [one + 2.0 * WAVE for one in _noise(3)]
    labels, late = [["theta"] * N] * 4, [np.arange(N) / 60.0] * 4
    motions = [np.cos(np.arange(N) / 5.0)] * 4
    repeats = find_repeats(labels, late, motions)
    columns = np.ones((N, 1))
    alone = [Block(["theta"] * N, one, columns, np.ones(N)) for one in left]
    apart = [
        Block(["theta"] * N, one, slope, repeats.sizes(k))
        for k, (one, slope) in enumerate(
            zip(repeats.deviations(left), repeats.deviations([columns] * 4), strict=True)
        )
    ]
    assert estimated_correlation(alone) > 0.2
    assert abs(estimated_correlation(apart)) < 0.12


def test_innovations_and_noise_undo_each_other() -> None:
    memory = Memory.of(["theta"] * 50 + ["omega"] * 47, 0.7)
    (noise,) = _noise(1, 1)
    np.testing.assert_allclose(memory.innovations(memory.noise(noise)), noise, rtol=1e-12)
    # A series does not remember the one before it.
    assert memory.previous[50] == 0.0
    assert memory.innovations(noise)[50] == noise[50]


def _alike() -> Repeats:
    motions = [np.cos(np.arange(N) / 5.0)] * 4
    return find_repeats([["theta"] * N] * 4, [np.arange(N) / 60.0] * 4, motions)


def test_noise_does_not_repeat_itself_and_physics_does() -> None:
    noise = _noise(7)
    passed, failed = (
        check_repeats(_alike(), values, 1, 3) for values in (noise, [one + 2.0 * WAVE for one in noise])
    )
    assert passed is not None
    assert passed.passed
    assert failed is not None
    assert not failed.passed


def test_one_degree_of_freedom_is_enough() -> None:
    """Of two records of one sample each, a and b, the ratio is ((a + b)/(a - b))^2."""
    one = np.ones(1)
    twice = find_repeats([["theta"]] * 2, [one, one], [one, one])
    check = check_repeats(twice, [3.0 * one, 1.0 * one], 0, 0)
    assert check is not None
    # By Student's t with one degree of freedom, whose square this is: beyond 2 in 1 - 2*atan(2)/pi.
    assert check.message.startswith("mean over repeats against their scatter 4.00 (chance 0.3)")
    assert check_repeats(twice, [3.0 * one, 1.0 * one], 1, 0) is None
    assert check_repeats(twice, [one, one], 0, 0) is None


def test_degrees_of_freedom_are_the_traces_of_the_projections() -> None:
    """Two releases, of two and of three records, each record with two variables of its own."""
    count, own = 12, 2
    swing = np.cos(np.arange(count) / 3.0)
    motions = [swing, swing, -swing, -swing, -swing]
    repeats = find_repeats([["theta"] * count] * 5, [np.arange(count) / 60.0] * 5, motions)
    basis = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, count), own))[0]
    above = below = 0.0
    for k in range(5):
        for i in range(count):
            unit = [np.zeros(count) for _ in motions]
            unit[k][i] = 1.0
            left = [one - basis @ (basis.T @ one) for one in unit]
            above += float(np.sum(repeats.counts * repeats.means(left) ** 2))
            below += sum(float(one @ one) for one in repeats.deviations(left))
    assert repeats_freedom(repeats, 0, own) == (pytest.approx(above), pytest.approx(below))


def test_only_records_of_like_motions_repeat_each_other() -> None:
    swing = np.cos(np.arange(N) / 5.0)
    late = [np.arange(N) / 60.0 + shift for shift in (0.0, 0.004, -0.006, 0.0)]
    found = find_repeats([["theta"] * N] * 4, late, [swing, 1.02 * swing, swing, -swing])
    assert set(found.counts) == {3.0}
    assert set(found.places[3]) == {-1}
    assert check_repeats(find_repeats([["theta"] * N], [late[0]], [swing]), [swing], 1, 3) is None


def test_single_outliers_count_less_and_stretches_of_them_are_a_misfit() -> None:
    left = _noise(2)
    left[1][40] += 30.0
    left[3][10] -= 8.0
    found = find_outliers(left)
    assert found.few
    assert [(k, i) for k, i, _ in found.places()] == [(1, 40), (3, 10)]
    shares = found.shares()
    assert shares[1][40] == shares[3][10] == 0.0
    assert np.mean(np.concatenate(shares)) > 0.98
    check = check_outliers(found, list("abcd"), [np.arange(N) / 60.0] * 4, robust=True)
    assert check.passed
    assert "b at 0.6667 s (+" in check.message
    left[1][30:40] += 30.0
    assert not find_outliers(left).few
    clean = find_outliers(_noise(2))
    assert not clean.any


def test_clipped_noise_is_seen_and_a_hold_without_noise_is_not() -> None:
    theta = np.degrees(0.3 * np.cos(np.arange(N) / 5.0))
    noisy = theta + 0.1 * _noise(4, 1)[0]
    assert check_clipping(["a"], [noisy], [0.1]).passed
    check = check_clipping(["a", "b"], [noisy, np.minimum(noisy, 16.0)], [0.1, 0.1])
    assert not check.passed
    assert "b (" in check.message
    held = np.concatenate((np.full(10, theta[0]), theta))
    assert check_clipping(["a"], [held], [1e-9]).passed
    # Counts of an encoder are equal more often than noise; so coarse a record is not judged.
    assert check_clipping(["a"], [np.round(noisy)], [0.3]).passed
