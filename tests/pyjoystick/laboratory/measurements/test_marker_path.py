"""The circle through points, against points on a known circle."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from pyjoystick.laboratory.measurements.marker_path import fit_circle, motion_plane
from pyjoystick.motion import RecordError

CENTER, RADIUS = np.array([0.4, -0.2]), 0.266


def _arc(noise: float = 0.0, seed: int = 1, *, half: float = 0.4, count: int = 200) -> NDArray[np.float64]:
    """Points over an arc of `half` (rad) to either side of straight up, with noise across and along."""
    angle = np.linspace(-half, half, count)
    points = CENTER + RADIUS * np.column_stack((np.sin(angle), np.cos(angle)))
    return np.asarray(points + noise * np.random.default_rng(seed).standard_normal((count, 2)))


@pytest.mark.parametrize("half", [0.05, 0.4, 3.0])
@pytest.mark.parametrize("radius", [None, RADIUS])
def test_a_circle_without_noise_is_exact(half: float, radius: float | None) -> None:
    found = fit_circle(_arc(half=half), radius)
    np.testing.assert_allclose(found.center, CENTER, rtol=0.0, atol=1e-10)
    assert found.radius == pytest.approx(RADIUS, abs=1e-10)
    assert found.noise < 1e-12


def test_distances_are_least_across_the_arc_and_not_their_squares() -> None:
    """A circle with large noise: by squared distances its radius would be too large by twice as much."""
    found = [fit_circle(_arc(0.02, seed, half=3.0, count=2000)) for seed in range(20)]
    assert np.mean([one.noise for one in found]) == pytest.approx(0.02, rel=0.02)
    # Noise along the arc makes every distance larger by noise^2/(2 radius).
    expected = RADIUS + 0.02**2 / (2.0 * RADIUS)
    error = np.mean([one.radius_error for one in found]) / np.sqrt(20)
    assert np.mean([one.radius for one in found]) == pytest.approx(expected, abs=3.0 * error)
    assert error < 0.2 * 0.02**2 / (2.0 * RADIUS)


@pytest.mark.parametrize("radius", [None, RADIUS])
def test_the_errors_are_those_of_the_center_and_the_radius(radius: float | None) -> None:
    found = [fit_circle(_arc(3e-4, seed), radius) for seed in range(200)]
    # The standard deviation of 200 is known to 5 %; three of them.
    for axis in range(2):
        scatter = np.std([one.center[axis] for one in found])
        assert np.mean([one.center_error[axis] for one in found]) == pytest.approx(scatter, rel=0.15)
    assert np.mean([one.noise for one in found]) == pytest.approx(3e-4, rel=0.02)
    if radius is None:
        scatter = np.std([one.radius for one in found])
        assert np.mean([one.radius_error for one in found]) == pytest.approx(scatter, rel=0.15)
    else:
        assert {one.radius for one in found} == {RADIUS}
        assert {one.radius_error for one in found} == {0.0}


@pytest.mark.parametrize(("radius", "count"), [(None, 4), (RADIUS, 4)])
def test_the_noise_of_a_few_points_is_not_underrated(radius: float | None, count: int) -> None:
    """The mean of the variances is that of the noise: what was fitted is taken off the number of points."""
    found = [fit_circle(_arc(1e-4, seed, half=1.0, count=count), radius) for seed in range(3000)]
    # The standard deviation of the mean is 1.8 to 2.6 %, depending on the degrees of freedom.
    assert np.mean([one.noise**2 for one in found]) == pytest.approx(1e-8, rel=0.08)


def test_a_known_radius_that_is_not_that_of_the_arc_moves_the_center_along_it() -> None:
    found = fit_circle(_arc(), 0.3)
    # The top of the arc stays in place: the center goes down by what the radius is too long.
    assert found.center == pytest.approx(CENTER - [0.0, 0.3 - RADIUS], abs=1e-3)


def test_the_error_of_the_radius_of_a_nearly_straight_path() -> None:
    """An arc of 1 m whose middle is 0.1 mm off its chord."""
    along, random, radius = np.linspace(-0.5, 0.5, 60), np.random.default_rng(3), 1e3
    path = np.column_stack((along, np.sqrt(radius**2 - along**2) - radius))
    fits = [fit_circle(path + random.normal(0.0, 1e-8, path.shape)) for _ in range(40)]
    off = [(one.radius - radius) / one.radius_error for one in fits]
    # The root mean square of 40 is within a third of 1 in 99.7 % of all cases.
    assert np.sqrt(np.mean(np.square(off))) == pytest.approx(1.0, rel=0.34)


def test_points_on_a_straight_line_determine_no_circle() -> None:
    line = np.column_stack((np.linspace(-1.0, 1.0, 50), np.zeros(50)))
    found = fit_circle(line)
    assert not np.isfinite(found.radius_error)
    assert not np.isfinite(found.center_error).any()


def test_an_uncertain_plane_is_told_with_the_root_mean_squares_in_and_out_of_it() -> None:
    along = np.linspace(-0.1, 0.1, 100)
    signs = np.tile([[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]], (25, 1))
    path = np.column_stack((along, signs * [1e-4, 0.8e-4]))
    with pytest.raises(RecordError, match=r"curved by 0\.1 mm rms within it, and leaves it by 0\.08 mm rms"):
        motion_plane(path, path[0], np.array([1.0, 0.0, 0.0]), "path")
