"""The range of a slider: wide enough to show the effect of a parameter, narrow enough to set it by hand."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

Scale = Literal["linear", "log"]

#: A slider spans from a fifth of the start value to five times that value.
_SPREAD = 5.0
#: Bounds beyond these mean "positive" or "any" and are useless as ends of a slider.
_LARGEST, _SMALLEST = 1e15, 1e-15


@dataclass(frozen=True, slots=True)
class Range:
    """The ends of a slider in the variable's own unit; a ``log`` scale has ends of the same sign."""

    minimum: float
    maximum: float
    scale: Scale = "linear"


def range_of(start: float, minimum: float | None, maximum: float | None, nominal: float | None) -> Range:
    """Return the range around a start value, within the bounds of the variable.

    A start value of zero has no magnitude: the range then uses both bounds if they are usable, else the
    nominal value or 1.
    """
    lower, upper = _useful(minimum), _useful(maximum)
    if start == 0.0:
        size = abs(nominal) if nominal else 1.0
        both = lower is not None and upper is not None
        ends = (lower, upper) if both else (max(-size, _or(lower, -size)), min(size, _or(upper, size)))
    else:
        ends = (start / _SPREAD, start * _SPREAD) if start > 0.0 else (start * _SPREAD, start / _SPREAD)
        ends = (max(ends[0], _or(lower, -math.inf)), min(ends[1], _or(upper, math.inf)))
    low, high = (float(end) for end in ends)  # type: ignore[arg-type]
    if not low < high:  # the bounds leave no room around the start value
        size = abs(start) or 1.0
        low, high = start - size, start + size
    return Range(
        low, high, "log" if low * high > 0.0 and max(low / high, high / low) >= _SPREAD else "linear"
    )


def _useful(bound: float | None) -> float | None:
    if bound is None or not abs(bound) < _LARGEST:
        return None
    return 0.0 if abs(bound) < _SMALLEST else bound


def _or(bound: float | None, otherwise: float) -> float:
    return otherwise if bound is None else bound
