"""The instant inside a step at which a monotone quantity passes through zero, found to rounding."""

from __future__ import annotations

from collections.abc import Callable

_MOST_ITERATIONS = 100


def first_zero(
    function: Callable[[float], tuple[float, float]],
    start_value: float,
    end: float,
    end_value: float,
    resolution: float,
) -> float:
    """Newton's method kept inside a shrinking bracket.

    Every value comes from a step of the integrator that ends exactly there, not from an interpolant, so
    the zero is as accurate as the integration itself.

    Args:
        function: value and derivative at a point of [0, end]
        start_value: value at 0, not zero
        end: end of the bracket, above 0
        end_value: value at `end`, zero or of the other sign than `start_value`
        resolution: values of this magnitude are rounding

    Returns:
        the point in [0, end] where the value is zero to within `resolution`, or where the bracket has no more
        floating-point numbers inside
    """
    lower, upper = 0.0, end
    if end_value == 0.0:
        return end
    point = end * start_value / (start_value - end_value)
    for _ in range(_MOST_ITERATIONS):
        value, slope = function(point)
        if abs(value) <= resolution:
            break
        if (value > 0.0) == (start_value > 0.0):
            lower = point
        else:
            upper = point
        newton = point - value / slope if slope != 0.0 else lower
        following = newton if lower < newton < upper else 0.5 * (lower + upper)
        if following in (point, lower, upper):
            break
        point = following
    return point
