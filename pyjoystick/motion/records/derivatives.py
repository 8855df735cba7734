"""Whether a measured rate is the derivative of what was measured beside it."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.records.errors import RecordError
from pyjoystick.support import FloatArray

#: Largest difference between a quantity and the integral of its rate, relative to the larger of the two.
#: Noise and filters stay below a tenth; a wrong sign gives 2, a factor of 2 gives 0.5.
_TOLERATED: Final = 0.4
#: Largest relative difference from the ratio of degrees and radians, or from -1, that is taken for it.
_NEAR: Final = 0.5
#: Ratio of two sizes that no sampling explains.
_FAR: Final = 10.0
#: Fewest samples that show a motion.
_FEWEST: Final = 8


def require_derivative(
    source: str,
    time: FloatArray,
    quantity: tuple[str, FloatArray],
    rate: tuple[str, FloatArray],
    *,
    smallest: float,
    longest_step: float,
    rows: NDArray[np.int64],
) -> None:
    """Raise RecordError if the rate is not the derivative of the quantity.

    Both are compared up to a straight line, as a rate may have an offset.

    Args:
        source: the file, for the message
        time: shape (n,), increasing (s)
        quantity: its name and values, shape (n,)
        rate: its name and values in the unit of the quantity per second, shape (n,)
        smallest: largest difference (rms, in the unit of the quantity) that noise can cause
        longest_step: longer ones are gaps, over which nothing can be integrated (s)
        rows: line numbers of the samples, shape (n,)
    """
    (name, values), (name_of_rate, rates) = quantity, rate
    ratio = ratio_to_rate(time, values, rates, smallest=smallest, longest_step=longest_step)
    if ratio is not None:
        reason = f"is not the rate of {name}, which changes {ratio:.3g} times as fast"
        raise RecordError(
            source, reason, _advice(name_of_rate, ratio), column=name_of_rate, rows=rows[[0, -1]]
        )


def ratio_to_rate(
    time: FloatArray,
    values: FloatArray,
    rates: FloatArray,
    *,
    smallest: float,
    longest_step: float = math.inf,
) -> float | None:
    """How much faster values change than their rates say; None if the rates can be theirs.

    The arguments are those of `require_derivative`.
    """
    steps = np.diff(time)
    if len(time) < _FEWEST:
        return None
    inside = steps <= longest_step
    changes = np.where(inside, np.diff(values), 0.0)
    integrals = np.where(inside, 0.5 * (rates[1:] + rates[:-1]) * steps, 0.0)
    moved, integrated = (_beside_a_line(np.cumsum(one)) for one in (changes, integrals))
    difference = _rms(moved - integrated)
    small, large = sorted((_rms(moved), _rms(integrated)))
    tolerated = max(smallest, _TOLERATED * large)
    if _FAR * small > large:  # else not even the order of magnitude agrees, however coarse the sampling
        tolerated += _sampling_error(steps, rates, integrals, inside)
    if difference <= tolerated:
        return None
    return float(moved @ integrated / (integrated @ integrated)) if integrated.any() else math.inf


def _sampling_error(
    steps: FloatArray, rates: FloatArray, integrals: FloatArray, inside: NDArray[np.bool_]
) -> float:
    """How much every second sample alone would change the integral: several samples a swing are few."""
    count = len(steps) // 2 * 2
    whole = inside[:count:2] & inside[1:count:2]
    coarse = 0.5 * (rates[: count - 1 : 2] + rates[2 : count + 1 : 2]) * (steps[:count:2] + steps[1:count:2])
    fine = integrals[:count:2] + integrals[1:count:2]
    return _rms(_beside_a_line(np.cumsum(np.where(whole, coarse - fine, 0.0))))


def _advice(name: str, ratio: float) -> str:
    power = {"omega": "", "alpha": "2"}[name]
    if ratio < -_NEAR:
        return "turn the sign of one of the two"
    if abs(ratio * math.degrees(1.0) - 1.0) < _NEAR:
        return f"name the column {name} (deg/s{power})"
    if abs(ratio / math.degrees(1.0) - 1.0) < _NEAR:
        return f"name the column {name} (rad/s{power})"
    return "leave the column out"


def _beside_a_line(series: FloatArray) -> FloatArray:
    """The series without the straight line that fits it best."""
    positions = np.linspace(-1.0, 1.0, len(series))
    slope = (positions @ series) / (positions @ positions)
    without: FloatArray = series - series.mean() - slope * positions
    return without


def _rms(series: FloatArray) -> float:
    return float(np.sqrt(np.mean(series**2)))
