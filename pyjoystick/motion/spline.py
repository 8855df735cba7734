"""A spline for motions that swing between stiff stops: smooth within a swing, corners at zero crossings.

Between two zero crossings the preloads keep the acceleration nearly constant; at the crossing it reverses
within a millisecond or two, far less than the time between two camera frames. The angle is therefore fitted
by cubic pieces with double knots at the crossings: angle and velocity are continuous there, and the
acceleration jumps. A filter of any cutoff would round these corners, and with them every velocity peak.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from scipy.interpolate import BSpline
from scipy.optimize import minimize_scalar

from pyjoystick.support import FloatArray

_DEGREE: Final = 3
#: Swings with this many samples get a knot in the middle, which adds less noise than it removes bias.
_SAMPLES_FOR_INNER_KNOT: Final = 5
#: The time at which the first swing leaves rest is also fitted, so it needs a knot only if it is longer.
_FIRST_SWING_SAMPLES: Final = 8
#: Error of the release without noise, relative to the first swing: rms over damping laws and release angles.
_RELEASE_ERROR: Final = 0.005
#: Number of first swings from which the release is found.
_SWINGS_FOR_RELEASE: Final = 3
#: Part of the first swing that follows half of its height, for a constant acceleration.
_AFTER_HALF: Final = 1.0 - math.sqrt(0.5)
#: The release is sought within this part of the first swing of the first guess,
_SOUGHT: Final = 0.4
_GUESSES: Final = 20
#: and, with a knot in the first swing, within this part of that found without.
_NEAR: Final = 0.1
#: Smallest singular value of a determined model, relative to the largest.
_WORST_CONDITION: Final = 1e-3
#: Maximum number of alternations between fitting and locating the crossings.
_ROUNDS: Final = 4
#: Largest move of a crossing per iteration (parts of a sampling interval).
_LARGEST_MOVE: Final = 0.3


@dataclass(frozen=True, slots=True, eq=False)
class MotionSpline:
    """A fitted motion from the release.

    Attributes:
        spline: angle (rad) over time (s), from `release` to the last of `passages`
        release: time (s) at which the joystick leaves rest
        passages: times (s) of the zero crossings, then the end of the fit, shape (swings,)
        noise: standard deviation of the samples about the spline (rad)
        covariance: covariance of the spline's coefficients and the release, in rad and s
    """

    spline: BSpline
    release: float
    passages: FloatArray
    noise: float
    covariance: FloatArray

    def variance(self, time: FloatArray, derivative: int = 0) -> FloatArray:
        """Variance of the angle or one of its derivatives (rad2 and seconds) at times within the fit."""
        rows = _basis(self.spline.t, time, derivative)
        inner = self.covariance[:-1, :-1]
        return np.asarray(np.einsum("ij,jk,ik->i", rows, inner, rows))

    @property
    def release_variance(self) -> float:
        """Variance of the time of release (s2), of noise and of what the spline does to the motion."""
        of_model = _RELEASE_ERROR * (float(self.passages[0]) - self.release)
        return float(self.covariance[-1, -1]) + of_model**2


def fit_spline(time: FloatArray, theta: FloatArray, passages: FloatArray) -> MotionSpline | None:
    """Fit a motion that is held, released and swings; None if the samples do not determine it.

    The angle is constant up to the release and starts with zero velocity; the time of release is also
    fitted, between samples. Without samples of the hold, it is where the velocity vanishes.

    Releases are compared with the same number of knots: one more knot in the first swing for early releases
    would fit noise of the hold. Whether there is one is decided by a first search without it.

    Args:
        time: times (s), shape (n,), from the hold to the last crossing or beyond
        theta: angles (rad), shape (n,)
        passages: first guess of the zero crossings (s), shape (swings,), the last one being the end
    """
    interval = float(np.median(np.diff(time)))
    inside = time <= passages[-1]
    time, theta = time[inside], theta[inside]
    candidates = _guesses(time, theta, float(passages[0]))
    release = _best_release(time, theta, candidates, passages, False)
    knot = int(np.count_nonzero((time >= release) & (time < passages[0]))) >= _FIRST_SWING_SAMPLES
    if knot:
        candidates = release + _NEAR * (passages[0] - release) * np.linspace(-1.0, 1.0, 9)
    for _ in range(_ROUNDS):
        release = _best_release(time, theta, candidates, passages, knot)
        candidates = release + interval * np.array([-0.1, 0.0, 0.1])
        fitted = _least_squares(time, theta, release, passages, knot)
        if fitted is None:
            return None
        passages = _passages(_spline(fitted[0], release, passages, time, knot), passages, interval)
    return _with_covariance(time, theta, release, passages, knot)


def _guesses(time: FloatArray, theta: FloatArray, first_passage: float) -> FloatArray:
    """Times around that at which a constant acceleration would have begun.

    From the time of half the height to the crossing: there, noise moves the time least. The last sample
    at the height of the hold is often far from the release.
    """
    before = time < first_passage
    times, heights = np.append(time[before], first_passage), np.append(np.abs(theta[before]), 0.0)
    half = 0.5 * float(np.max(heights))
    last = int(np.flatnonzero(heights >= half)[-1])
    at_half = np.interp(-half, -heights[last : last + 2], times[last : last + 2])
    first_swing = (first_passage - at_half) / _AFTER_HALF
    return np.asarray(first_passage - first_swing * np.linspace(1.0 + _SOUGHT, 1.0 - _SOUGHT, _GUESSES))


def _best_release(
    time: FloatArray, theta: FloatArray, candidates: FloatArray, passages: FloatArray, knot: bool
) -> float:
    """Time of release with the least squares over the first swings, near the best candidate."""
    few = passages[:_SWINGS_FOR_RELEASE]
    inside = time <= few[-1]
    time, theta = time[inside], theta[inside]
    nothing_explained = float(theta @ theta)

    def squares(release: float) -> float:
        fitted = _least_squares(time, theta, release, few, knot)
        return nothing_explained if fitted is None else fitted[1]

    best = float(candidates[np.argmin([squares(candidate) for candidate in candidates])])
    step = float(candidates[1] - candidates[0])
    # Minimize over the shift, not the absolute time, of which SciPy would not change the last eight digits.
    found = minimize_scalar(
        lambda move: squares(best + move), bounds=(-step, step), method="bounded", options={"xatol": 1e-5}
    )
    return best + float(found.x)


def _knots(release: float, passages: FloatArray, time: FloatArray, knot: bool) -> FloatArray:
    knots = [release] * (_DEGREE + 1)
    edges = [release, *passages.tolist()]
    for start, end in pairwise(edges):
        samples = int(np.count_nonzero((time >= start) & (time < end)))
        if knot if start == release else samples >= _SAMPLES_FOR_INNER_KNOT:
            knots.append(0.5 * (start + end))
        knots += [end] * 2
    return np.array([*knots[:-2], *[edges[-1]] * (_DEGREE + 1)])


def _basis(knots: FloatArray, time: FloatArray, derivative: int = 0) -> FloatArray:
    """Values of the basis functions at given times, shape (n, coefficients)."""
    count = len(knots) - _DEGREE - 1
    functions = BSpline(knots, np.eye(count), _DEGREE)
    return np.asarray(functions(np.clip(time, knots[0], knots[-1]), nu=derivative))


def _design(knots: FloatArray, time: FloatArray) -> FloatArray:
    """Design matrix of the samples: constant before the release, with zero velocity at it.

    The first two coefficients are equal, so that the velocity vanishes at the first knot.
    """
    rows = _basis(knots, time)
    rows[:, 1] += rows[:, 0]
    return rows[:, 1:]


def _least_squares(
    time: FloatArray, theta: FloatArray, release: float, passages: FloatArray, knot: bool
) -> tuple[FloatArray, float] | None:
    """Coefficients and the sum of squares; None if the samples do not determine them.

    Crossings that change order, or come before the release, leave no swing between them.
    """
    if not np.all(np.diff(passages, prepend=release) > 0.0):
        return None
    design = _design(_knots(release, passages, time, knot), time)
    coefficients, _, rank, _ = np.linalg.lstsq(design, theta, rcond=_WORST_CONDITION)
    if rank < design.shape[1]:
        return None
    residual = theta - design @ coefficients
    return np.asarray(coefficients, dtype=np.float64), float(residual @ residual)


def _spline(
    coefficients: FloatArray, release: float, passages: FloatArray, time: FloatArray, knot: bool
) -> BSpline:
    knots = _knots(release, passages, time, knot)
    return BSpline(knots, np.insert(coefficients, 0, coefficients[0]), _DEGREE)


def _passages(spline: BSpline, passages: FloatArray, interval: float) -> FloatArray:
    """Newton step from each crossing to the zero of the spline; the end stays."""
    inner = passages[:-1]
    largest = _LARGEST_MOVE * interval
    moves = np.clip(spline(inner) / spline(inner, nu=1), -largest, largest)
    return np.append(inner - moves, passages[-1])


def _with_covariance(
    time: FloatArray, theta: FloatArray, release: float, passages: FloatArray, knot: bool
) -> MotionSpline | None:
    fitted = _least_squares(time, theta, release, passages, knot)
    if fitted is None:
        return None
    coefficients, squares = fitted
    spline = _spline(coefficients, release, passages, time, knot)
    design = _design(spline.t, time)
    # Derivative of the samples with respect to the release time, with the following swing moving along.
    after = np.clip(time, release, passages[0])
    share = np.where(time <= passages[0], (passages[0] - after) / (passages[0] - release), 0.0)
    slope = np.where(time >= release, -share * spline(np.clip(time, release, None), nu=1), 0.0)
    jacobian = np.column_stack((design, slope))
    # Samples of noise alone determine coefficients, but no release.
    if np.linalg.matrix_rank(jacobian) < jacobian.shape[1]:
        return None
    freedom = max(len(time) - jacobian.shape[1], 1)
    variance = squares / freedom
    inverse = np.linalg.inv(np.linalg.qr(jacobian, mode="r"))
    reduced = variance * (inverse @ inverse.T)
    order = [0, *range(jacobian.shape[1])]
    return MotionSpline(spline, release, passages, math.sqrt(variance), reduced[np.ix_(order, order)])
