"""Extrema of a sampled series, with interpolation: the numerics of `pyjoystick.motion.peaks`.

Everything here is arithmetic on arrays that Numba can compile unchanged, as the compiled loop over runs does
(`pyjoystick.fmu.stepping`); both give bitwise equal results. An array of extrema has one row each, in order
of time: time, value, sign (1 for a maximum, -1 for a minimum).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pyjoystick.support import FloatArray

_STENCIL = 5
_MOST_ITERATIONS = 100


def extrema_of_derivative(time: FloatArray, value: FloatArray, slope: FloatArray) -> FloatArray:
    """Find extrema at sign changes of the derivative, including those with a stretch of zeros in between.

    Args:
        time: times (s), shape (n,), increasing
        value: the series, shape (n,)
        slope: its derivative, shape (n,)
    """
    found = np.empty((len(slope), 3))
    count = 0
    before = -1  # the last sample with a nonzero slope
    for i in range(len(slope)):
        if slope[i] == 0.0:
            continue
        if before >= 0 and (slope[i] > 0.0) != (slope[before] > 0.0):
            sign = 1.0 if slope[before] > 0.0 else -1.0
            if i == before + 1:
                instant, height = _cubic_extremum(time, value, slope, before, sign)
            else:
                instant, height = _middle(time, value, before + 1, i - 1)
            found[count, 0], found[count, 1], found[count, 2] = instant, height, sign
            count += 1
        before = i
    return found[:count]


def extrema_of_samples(time: FloatArray, value: FloatArray) -> FloatArray:
    """Find extrema of the samples, refined by a polynomial through their neighbors.

    Args:
        time: times (s), shape (n,), n >= 3, increasing
        value: the series, shape (n,)
    """
    found = np.empty((len(value), 3))
    count = 0
    first = 0  # first of the equal samples that end before sample i
    for i in range(1, len(value)):
        if value[i] == value[i - 1]:
            continue
        if first > 0 and (value[first] > value[first - 1]) != (value[i] > value[i - 1]):
            sign = 1.0 if value[first] > value[first - 1] else -1.0
            if i - first >= 3:
                instant, height = _middle(time, value, first, i - 1)
            else:
                instant, height = _polynomial_extremum(time, value, first, i - 1, sign)
            found[count, 0], found[count, 1], found[count, 2] = instant, height, sign
            count += 1
        first = i
    return found[:count]


def peaks_among(
    extrema: FloatArray, first: float, last: float, minimum_height: float, minimum_prominence: float
) -> FloatArray:
    """Select maxima above and minima below zero that are high and prominent enough.

    The most extreme value since the last turn is kept until the series has returned by the prominence. The
    ends of the series count as returns, but are not extrema themselves.

    Args:
        extrema: as found above, shape (n, 3)
        first: first value of the series
        last: last value of the series
        minimum_height: minimum |value| of a peak
        minimum_prominence: minimum return of the series on either side of a peak
    """
    places = np.empty(len(extrema), dtype=np.int64)
    count = 0
    lowest = highest = first
    held = -1
    for i in range(len(extrema)):
        value, sign = extrema[i, 1], extrema[i, 2]
        if held < 0:
            rise = value - lowest if sign > 0.0 else highest - value
            lowest, highest = min(lowest, value), max(highest, value)
            if rise >= minimum_prominence:
                held = i
        elif sign == extrema[held, 2]:
            if (value - extrema[held, 1]) * sign > 0.0:
                held = i
        elif abs(value - extrema[held, 1]) >= minimum_prominence:
            places[count] = held
            count += 1
            held = i
    if held >= 0 and (extrema[held, 1] - last) * extrema[held, 2] >= minimum_prominence:
        places[count] = held
        count += 1
    return _high_ones(extrema, places[:count], minimum_height)


def _high_ones(extrema: FloatArray, places: NDArray[np.int64], minimum_height: float) -> FloatArray:
    """Those of these extrema that are maxima above or minima below zero and high enough."""
    kept = np.empty((len(places), 3))
    count = 0
    for place in places:
        height = extrema[place, 1] * extrema[place, 2]
        if height > 0.0 and height >= minimum_height:
            for i in range(3):
                kept[count, i] = extrema[place, i]
            count += 1
    return kept[:count]


def _middle(time: FloatArray, value: FloatArray, first: int, last: int) -> tuple[float, float]:
    """Middle of a flat stretch, with the value between the two adjacent samples."""
    middle = 0.5 * (time[first] + time[last])
    right = first
    while time[right] < middle:
        right += 1
    if time[right] == middle:
        return middle, value[right]
    left = right - 1
    part = (middle - time[left]) / (time[right] - time[left])
    return middle, value[left] + part * (value[right] - value[left])


def _cubic_extremum(
    time: FloatArray, value: FloatArray, slope: FloatArray, i: int, sign: float
) -> tuple[float, float]:
    """Extremum of the Hermite cubic between samples i and i+1, whose slopes differ in sign."""
    spacing = time[i + 1] - time[i]
    start, end = slope[i] * spacing, slope[i + 1] * spacing
    rise = value[i + 1] - value[i]
    # The slope of the cubic is start + 2*b*s + 3*a*s^2, s from 0 to 1, with a single zero in this range.
    a, b = start + end - 2.0 * rise, 3.0 * rise - 2.0 * start - end
    # Its discriminant b^2 - 3*a*start, in a form that rounding errors do not make negative.
    root = math.sqrt((b + start) ** 2 - start * end)
    s = -start / (b - sign * root)
    return time[i] + s * spacing, value[i] + s * (start + s * (b + s * a))


def _polynomial_extremum(
    time: FloatArray, value: FloatArray, first: int, last: int, sign: float
) -> tuple[float, float]:
    """Extremum of the quartic through five samples around the highest (or lowest) one.

    If it has none between the adjacent samples, the parabola through the three middle samples is used, which
    always has one.
    """
    count = min(_STENCIL, len(value))
    lowest = min(max(first - _STENCIL // 2, 0), len(value) - count)
    spacing = time[last + 1] - time[first - 1]
    low = (time[first - 1] - time[first]) / spacing
    high = (time[last + 1] - time[first]) / spacing
    for narrow in (False, True):
        begin, end = (first - 1, first + 2) if narrow else (lowest, lowest + count)
        c = _interpolating_polynomial(
            (time[begin:end] - time[first]) / spacing, value[begin:end] - value[first]
        )
        found, x = _turn_inside(c, low, high, sign)
        if found:
            height = x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])))
            return time[first] + x * spacing, value[first] + (c[0] + height)
    return time[first], value[first]


def _interpolating_polynomial(x: FloatArray, y: FloatArray) -> FloatArray:
    """Coefficients, lowest power first, shape (5,), of the polynomial through up to five points."""
    count = len(x)
    differences = y.copy()
    for order in range(1, count):
        for i in range(count - 1, order - 1, -1):
            differences[i] = (differences[i] - differences[i - 1]) / (x[i] - x[i - order])
    c = np.zeros(_STENCIL)
    for i in range(count - 1, -1, -1):
        # c = c*(x - x[i]) + differences[i]
        for power in range(_STENCIL - 1, 0, -1):
            c[power] = c[power - 1] - x[i] * c[power]
        c[0] = differences[i] - x[i] * c[0]
    return c


def _turn_inside(c: FloatArray, low: float, high: float, sign: float) -> tuple[bool, float]:
    """Extremum of a quartic between `low` and `high` that is nearest to 0."""
    first, second = _zeros_of_quadratic(12.0 * c[4], 6.0 * c[3], 2.0 * c[2])
    found, nearest = False, 0.0
    left = low
    # Between these points the slope of the quartic is monotonic.
    for right in (first, second, high):
        if left < right <= high:
            if _slope(c, left) * sign > 0.0 and _slope(c, right) * sign < 0.0:
                x = _zero_of_slope(c, left, right)
                if not found or abs(x) < abs(nearest):
                    found, nearest = True, x
            left = right
    return found, nearest


def _slope(c: FloatArray, x: float) -> float:
    slope: float = c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * 4.0 * c[4]))
    return slope


def _zeros_of_quadratic(a: float, b: float, c: float) -> tuple[float, float]:
    """Real zeros of a*x^2 + b*x + c in order; infinite if there are fewer."""
    discriminant = b * b - 4.0 * a * c
    if discriminant < 0.0:
        return math.inf, math.inf
    q = -0.5 * (b + math.copysign(math.sqrt(discriminant), b))
    first = q / a if a != 0.0 else math.inf
    second = c / q if q != 0.0 else math.inf
    return min(first, second), max(first, second)


def _zero_of_slope(c: FloatArray, left: float, right: float) -> float:
    """Zero of the slope between two points where it differs in sign, by Newton's method with bisection."""
    rises = _slope(c, right) > 0.0
    x = 0.5 * (left + right)
    for _ in range(_MOST_ITERATIONS):
        slope = _slope(c, x)
        if slope == 0.0:
            break
        if (slope > 0.0) == rises:
            right = x
        else:
            left = x
        curvature = 2.0 * c[2] + x * (6.0 * c[3] + x * 12.0 * c[4])
        following = x - slope / curvature if curvature != 0.0 else right
        if not left < following < right:
            following = 0.5 * (left + right)
        if following == x:
            break
        x = following
    return x


#: Functions to compile, each after those that it calls.
EXTREMA_FUNCTIONS = (
    _middle,
    _cubic_extremum,
    extrema_of_derivative,
    _slope,
    _zeros_of_quadratic,
    _zero_of_slope,
    _turn_inside,
    _interpolating_polynomial,
    _polynomial_extremum,
    extrema_of_samples,
    _high_ones,
    peaks_among,
)
