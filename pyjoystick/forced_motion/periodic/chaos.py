"""Largest Lyapunov exponent of a map: the growth rate of the distance between neighboring motions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.forced_motion.periodic.maps import Images, Tangents
from pyjoystick.support import FloatArray, ParameterError, whole_number

#: Distance of two neighbors, in scales: far above the noise of a run, far below the map's nonlinearity.
_APART: Final = 1e-7
#: An exponent differs from zero if it exceeds this many standard errors.
_SURE: Final = 3.0
#: Upper limit of the iterations for the requested precision, as a multiple.
_MOST_ROUNDS: Final = 8


@dataclass(frozen=True, slots=True)
class LargestExponent:
    """Largest Lyapunov exponent: the mean growth rate of the logarithm of a small distance.

    Attributes:
        value: 1/s
        error: its standard error, from the scatter among the motions (1/s)
        settled: motions that are left out because neighbors come together in the last quarter of the time:
            their chaos was a transient
    """

    value: float
    error: float
    settled: int = 0

    @property
    def is_chaotic(self) -> bool:
        """Whether it is above zero by more than three standard errors."""
        return self.value > _SURE * self.error


def largest_exponent(
    images: Images,
    states: FloatArray,
    parameter: float,
    scales: FloatArray,
    period: float,
    *,
    iterations: int = 300,
    precision: float = math.inf,
    tangents: Tangents | None = None,
) -> LargestExponent:
    """The largest exponent over several motions at a time, each with a tangent that is brought back.

    After each period the tangent is set to its first length again, in the direction that it has (Benettin and
    others, Meccanica 15 (1980) 9-30). Without derivatives of the map, a neighbor of the motion shows it.

    Args:
        images: the map over one period
        states: start states, all on one attractor, shape (runs, n), runs >= 2
        parameter: value of the parameter
        scales: size of each state, shape (n,)
        period: s
        iterations: periods; a tenth more is spent before, in which the distance finds its direction
        precision: the standard error that is wanted, as a part of the exponent; up to eight times as many
            periods are spent for it
        tangents: the map with its derivatives, in the place of `images`

    Raises:
        ParameterError: fewer than two motions, or one of them fails
    """
    count = whole_number("iterations", iterations, 1)
    whole_number("states", len(states), 2)
    now = states.copy()
    directions = np.full(now.shape, 1.0 / math.sqrt(now.shape[1]))
    growth: list[FloatArray] = []
    before = max(1, count // 10)
    for i in range(before + _MOST_ROUNDS * count):
        if tangents is None:
            both = images(np.concatenate((now, now + _APART * directions * scales)), parameter)
            now, beside = both[: len(now)], both[len(now) :]
            grown = (beside - now) / (_APART * scales)
        else:
            now, slopes = tangents(now, parameter)
            grown = np.einsum("rij,rj->ri", slopes, directions * scales) / scales
        length = np.linalg.norm(grown, axis=1)
        if not np.all(np.isfinite(length) & (length > 0.0)):
            raise ParameterError("states", states.tolist(), "motions that do not fail or become one")
        directions = grown / length[:, None]
        if i >= before:
            growth.append(np.log(length) / period)
        if growth and len(growth) % count == 0:
            found = _of_growth(np.array(growth))
            if found.error <= precision * abs(found.value):
                break
    return found


def _of_growth(growth: FloatArray) -> LargestExponent:
    """Exponent of the motions that have not settled, or of all motions if all have."""
    settled = np.mean(growth[-max(1, len(growth) // 4) :], axis=0) < 0.0
    kept = ~settled if np.count_nonzero(~settled) > 1 else np.ones_like(settled)
    rates = np.mean(growth[:, kept], axis=0)
    error = float(np.std(rates, ddof=1) / math.sqrt(len(rates)))
    return LargestExponent(float(np.mean(rates)), error, int(np.count_nonzero(~kept)))
