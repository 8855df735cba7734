"""Attractors of a shaken joystick, from many releases: periodic motions, or chaos."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyjoystick.forced_motion.periodic.chaos import LargestExponent, largest_exponent
from pyjoystick.forced_motion.periodic.solutions import NoSolutionError, PeriodicSolution, solve
from pyjoystick.forced_motion.response.shaken import ShakenJoystick
from pyjoystick.support import FloatArray, ParameterError, whole_number

#: Longest period that is tried, in periods of the torque.
_MOST_PERIODS: Final = 6
#: A motion has settled if it returns to within this distance, in scales.
_BACK: Final = 1e-3
#: Motions closer than this, in scales, are the same.
_SAME: Final = 1e-3
#: Number of motions for estimating an exponent; a single one is supplemented by neighboring states.
_MOTIONS: Final = 16
_BESIDE: Final = 1e-6
#: Requested relative standard error of an exponent.
_PRECISION: Final = 0.03
#: Maximum number of releases checked for how long they can be trusted, and number of periods checked.
_ASKED: Final = 6
_TRIED: Final = 40


@dataclass(frozen=True, eq=False)
class PeriodicAttractor:
    """A stable periodic motion.

    Attributes:
        periods: period of the motion, in periods of the torque
        solution: its first state, multipliers and exponents
        largest: largest magnitude of the angle (rad)
    """

    periods: int
    solution: PeriodicSolution
    largest: float


@dataclass(frozen=True, eq=False)
class UnsettledMotion:
    """Motions that have not become periodic; no period is given for them.

    Attributes:
        exponent: the largest Lyapunov exponent
        largest: the largest angle of all samples of the section (rad)
        section: theta (rad) and omega (rad/s) at the start of each period (Poincare section), shape
            (n, 2)
        trusted: until when a run can be trusted (s): the shortest `ShakenJoystick.trusted_until` of some of
            the releases. Errors grow faster at first than the exponent, which is an average.
    """

    exponent: LargestExponent
    largest: float
    section: FloatArray
    trusted: float


@dataclass(frozen=True, eq=False)
class Basins:
    """Basins of attraction: the attractor of each release.

    Attributes:
        theta: release angles (rad), shape (n,)
        omega: release speeds (rad/s), shape (m,)
        attractors: the attractors
        labels: index of the attractor, shape (m, n); -1 for a run that fails
    """

    theta: FloatArray
    omega: FloatArray
    attractors: tuple[PeriodicAttractor | UnsettledMotion, ...]
    labels: NDArray[np.int64]

    def share(self, number: int) -> float:
        """Fraction of the releases that lead to an attractor."""
        return float(np.mean(self.labels == number))


def basins(
    shaken: ShakenJoystick,
    theta: ArrayLike,
    omega: ArrayLike = (0.0,),
    *,
    settling: int = 100,
    iterations: int = 200,
    on_progress: Callable[[str], None] = lambda _: None,
) -> Basins:
    """Release the joystick at the start of a period, and find where each motion ends up.

    A motion belongs to a periodic attractor if, after `settling` periods, it returns to its state of one to
    six periods before and Newton's method finds a stable solution there. The others form one group: they are
    chaotic if their exponent is above zero, and have not settled otherwise.

    Args:
        shaken: the joystick, sampled once per period, at the value of its free parameter
        theta: release angles (rad), shape (n,)
        omega: release speeds (rad/s), shape (m,)
        settling: number of periods before a motion is judged
        iterations: minimum number of periods for averaging the exponent
        on_progress: called with a description of the current stage

    Raises:
        ParameterError: no angle or speed, or a number is not allowed
    """
    angles, speeds = (np.atleast_1d(np.asarray(one, dtype=np.float64)) for one in (theta, omega))
    if not (angles.size and speeds.size and np.all(np.isfinite(angles)) and np.all(np.isfinite(speeds))):
        raise ParameterError("theta, omega", (theta, omega), "finite numbers, one or more of each")
    releases = np.array([(angle, speed) for speed in speeds for angle in angles])
    states = releases
    value = shaken.value
    for period in range(whole_number("settling", settling, 1)):
        if period % 10 == 0:
            on_progress(f"period {period} of {settling} of {len(states)} motions")
        states = shaken.images(states, value)
    path = [states]
    for _ in range(_MOST_PERIODS):
        path.append(shaken.images(path[-1], value))
    found: list[PeriodicAttractor | UnsettledMotion] = []
    labels = np.full(len(states), -1)
    known: list[tuple[int, FloatArray]] = []
    for i in range(len(states)):
        track = np.array([states[i] for states in path])
        if np.all(np.isfinite(track)):
            labels[i] = _periodic(shaken, track, found, known)
    left = np.flatnonzero((labels == -2) & np.isfinite(states[:, 0]))
    if len(left):
        on_progress(f"Lyapunov exponent of {len(left)} motions")
        labels[left] = len(found)
        trusted = min(shaken.trusted_until(releases[i], _TRIED) for i in left[:: -(-len(left) // _ASKED)])
        found.append(_unsettled(shaken, states[left], iterations, trusted))
    return Basins(angles, speeds, tuple(found), labels.reshape(len(speeds), len(angles)))


def _periodic(
    shaken: ShakenJoystick,
    track: FloatArray,
    found: list[PeriodicAttractor | UnsettledMotion],
    known: list[tuple[int, FloatArray]],
) -> int:
    """Index of a motion's attractor, -2 if it is not periodic; adds new attractors.

    Args:
        shaken: the joystick
        track: states at the start of successive periods, shape (n, 2)
        found: attractors so far
        known: their states, each with the index of its attractor
    """
    scales = shaken.scales[:2]
    for number, state in known:
        if np.max(np.abs(track[-1] - state) / scales) < _SAME:
            return number
    back = np.max(np.abs(track[1:] - track[0]) / scales, axis=1) < _BACK
    if not np.any(back):
        return -2
    periods = int(np.argmax(back)) + 1
    longer = shaken.with_periods(periods)
    try:
        solution = solve(longer.smooth(), track[0], longer.value, scales)
    except NoSolutionError:
        return -2
    if not solution.is_stable or np.max(np.abs(solution.state - track[0]) / scales) > 10.0 * _BACK:
        return -2
    state = solution.state
    for _ in range(periods):
        known.append((len(found), state))
        state = shaken.images(state[None, :], shaken.value)[0]
    extremes = longer.orbit(solution.state, longer.value).extremes
    found.append(PeriodicAttractor(periods, solution, max(map(abs, extremes))))
    return len(found) - 1


def _unsettled(
    shaken: ShakenJoystick, states: FloatArray, iterations: int, trusted: float
) -> UnsettledMotion:
    chosen = states[np.linspace(0, len(states) - 1, min(len(states), _MOTIONS)).astype(int)]
    if len(chosen) < _MOTIONS:
        repeated = np.resize(chosen, (_MOTIONS, 2))
        chosen = repeated + _BESIDE * shaken.scales[:2] * np.arange(_MOTIONS)[:, None]
    period = shaken.period(shaken.value)
    exponent = largest_exponent(
        shaken.images,
        chosen,
        shaken.value,
        shaken.scales[:2],
        period,
        iterations=iterations,
        precision=_PRECISION,
        tangents=shaken.tangents(),
    )
    section = [chosen]
    for _ in range(max(1, iterations // 4)):
        section.append(shaken.images(section[-1], shaken.value))
    points = np.concatenate(section)
    orbits = (shaken.orbit(state, shaken.value).extremes for state in points[-4 * _MOTIONS :])
    largest = max(abs(one) for pair in orbits for one in pair)
    return UnsettledMotion(exponent, largest, points, trusted)
