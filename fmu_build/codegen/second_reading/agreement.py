"""Compare two readings of an expression by their values at random points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, TypeAlias

import numpy as np

from fmu_build.codegen.second_reading.operations import UnknownError, Value
from fmu_build.codegen.second_reading.points import Point, Points

_ROUNDING: Final = 1e-12
_LARGEST: Final = 1e100

Reading: TypeAlias = Callable[[Point], Sequence[Value]]


class Size:
    """The largest number that has entered values, for the rounding."""

    def __init__(self) -> None:
        self.largest = 0.0

    def enter(self, *values: Value) -> None:
        """Take note of values."""
        finite = (float(np.abs(one[np.isfinite(one)]).max(initial=0.0)) for one in values)
        self.largest = max([self.largest, *finite])


def differ(
    points: Points,
    meant: Reading,
    found: Reading,
    size: Size,
    *,
    is_residual: bool = False,
    is_complete: bool = False,
) -> bool:
    """Return whether two readings have different values at one of the points.

    Args:
        points: the points at which they are compared
        meant: the values of what the source means
        found: the values of what rumoca has made of it
        size: the numbers that `meant` enters
        is_residual: whether order and signs do not matter
        is_complete: whether rumoca has left out nothing, as it may do with branches that are never chosen

    Raises:
        UnknownError: the values are not known; or the readings agree only as far as Booleans are true or
            false, or only for the values that Integer parameters have
    """
    count_matters = is_residual or is_complete
    of_any_integers = False
    if points.has_integers:
        try:
            of_any_integers = _differ(points.of_any_integers, meant, found, size, is_residual, count_matters)
        except UnknownError:  # They may be sizes or subscripts.
            of_any_integers = False
        else:
            if not of_any_integers:
                return False
    if _differ(points.of_own_integers, meant, found, size, is_residual, count_matters):
        return _differ(points.of_replaced_names, meant, found, size, is_residual, count_matters)
    if of_any_integers:
        raise UnknownError
    return False


def _differ(
    points: Sequence[Point],
    meant: Reading,
    found: Reading,
    size: Size,
    is_residual: bool,
    count_matters: bool,
) -> bool:
    is_known = False
    for point in points:
        numbers, others = (_numbers(reading(point), is_residual=is_residual) for reading in (meant, found))
        if len(numbers) != len(others):
            if not count_matters:
                raise UnknownError
            return _certain(point)
        if not np.isfinite(numbers).all() or np.abs(numbers).max(initial=0) > _LARGEST:
            continue
        is_known = True
        if not np.allclose(numbers, others, rtol=_ROUNDING, atol=_ROUNDING * size.largest):
            return _certain(point)
    if not is_known:
        raise UnknownError
    return False


def _numbers(values: Sequence[Value], *, is_residual: bool) -> Value:
    numbers = np.concatenate([np.empty(0), *(one.reshape(-1) for one in values)])
    return np.sort(np.abs(numbers)) if is_residual else numbers


def _certain(point: Point) -> bool:
    if point.is_smooth:
        raise UnknownError
    return True
