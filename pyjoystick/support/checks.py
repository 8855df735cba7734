"""Checks of values given by users, which return the value or raise ParameterError; types and defaults."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from numbers import Integral, Real
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyjoystick.support.errors import ParameterError

FloatArray = NDArray[np.float64]
#: Torque about the pivot (N m) as a function of time (s).
Torque = Callable[[float], float]

#: Tolerance of an FMU's integrator.
DEFAULT_TOLERANCE: Final = 1e-8
#: Length of a free oscillation (s): the joystick of the paper is at rest by then.
DEFAULT_DURATION: Final = 1.5
#: Time between two rows of a table (s).
DEFAULT_OUTPUT_INTERVAL: Final = 1e-3


def type_text(value: object) -> str:
    """The text for a value of a wrong type in a message."""
    return f"an object of type {type(value).__name__}"


def number_of_text(text: str) -> float:
    """The number that a text is, ValueError for any other.

    Unlike `float`, it takes no underscores and no digits of other scripts: in a file they are damage.
    """
    if "_" in text or not text.isascii():
        raise ValueError(text)
    return float(text)


def is_number_text(text: str) -> bool:
    """Whether a text is a number for `number_of_text`."""
    try:
        number_of_text(text)
    except ValueError:
        return False
    return True


def finite(field: str, value: object, unit: str = "", allowed: str = "a finite number") -> float:
    """`value` as a float; text, complex numbers, NaN and infinities are rejected."""
    number = math.nan
    if isinstance(value, Real) and not isinstance(value, bool | np.timedelta64):  # which NumPy calls integers
        with suppress(OverflowError):  # a whole number of more than 308 digits
            number = float(value)
    if not math.isfinite(number):
        raise ParameterError(field, value, f"{allowed} ({unit})" if unit else allowed)
    return number


def positive(field: str, value: object, unit: str = "") -> float:
    """`value` as a float; it must be above zero."""
    allowed = f"a finite number above 0 {unit}".rstrip()
    number = finite(field, value, allowed=allowed)
    if number <= 0.0:
        raise ParameterError(field, value, allowed)
    return number


def not_negative(field: str, value: object, unit: str = "") -> float:
    """`value` as a float; it must not be below zero."""
    allowed = f"a finite number, 0 {unit} or more".replace("0  or", "0 or")
    number = finite(field, value, allowed=allowed)
    if number < 0.0:
        raise ParameterError(field, value, allowed)
    return number


def whole_number(field: str, value: object, least: int, most: int | None = None) -> int:
    """`value` as an integer from `least` to `most`; floats and Booleans are rejected."""
    number = (
        -math.inf
        if isinstance(value, bool | np.timedelta64) or not isinstance(value, Integral)
        else int(value)
    )
    if not least <= number <= (math.inf if most is None else most):
        limits = f", {least} or more" if most is None else f" from {least} to {most}"
        raise ParameterError(field, value, f"a whole number{limits}")
    return int(number)


def angle(field: str, value: object) -> float:
    """`value` in rad as a float; |value| must be below pi/2, where the cam geometry ends (eq. 3)."""
    allowed = "an angle in rad strictly between -pi/2 and pi/2"
    number = finite(field, value, allowed=allowed)
    if abs(number) >= math.pi / 2.0:
        hint = f"in degrees? {number:g} degrees are {math.radians(number):.6g} rad"
        raise ParameterError(field, value, allowed, hint)
    return number


def without_mask(values: ArrayLike) -> NDArray[Any]:
    """`values` as an array, with NaN in place of what is masked in a masked array."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        return np.where(np.ma.getmaskarray(values), np.nan, np.ma.getdata(values).astype(np.float64))
    return np.asarray(values)


def real_numbers(values: ArrayLike) -> FloatArray:
    """`values` as a new array of floats, NaN where they are masked.

    Raises:
        TypeError, ValueError: they are no real numbers, such as durations, whose unit would be lost, complex
            numbers or text
    """
    given = without_mask(values)
    if given.dtype.kind not in "fiubO" or any(isinstance(one, complex) for one in given.flat[:1]):
        raise TypeError(f"{given.dtype} is no type of real numbers")
    try:
        return np.array(given, dtype=np.float64)
    except OverflowError as error:  # a whole number of more than 308 digits
        raise ValueError(str(error)) from None


def increasing_times(time: ArrayLike) -> FloatArray:
    """`time` (s) as an array (n,) of two or more finite, increasing instants."""
    try:
        instants = real_numbers(time)
    except (TypeError, ValueError):
        raise ParameterError("time", type_text(time), "an array of numbers (s)") from None
    if instants.ndim != 1 or instants.size < 2:
        given = f"array of shape {instants.shape}"
        raise ParameterError("time", given, "one-dimensional with two or more instants")
    for i in np.flatnonzero(~np.isfinite(instants))[:1]:
        finite(f"time[{i}]", instants[i], "s")
    for i in np.flatnonzero(np.diff(instants) <= 0.0)[:1]:
        raise ParameterError(f"time[{i + 1}]", instants[i + 1], f"above time[{i}] = {instants[i]} s")
    return instants
