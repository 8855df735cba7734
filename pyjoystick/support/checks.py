"""Checks of values that a user gives: each returns what was checked, or raises ParameterError."""

from __future__ import annotations

import math
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.support.errors import ParameterError
from pyjoystick.support.types import FloatArray


def finite(field: str, value: object, unit: str = "", allowed: str = "a finite number") -> float:
    """`value` as a float; refuses text, complex numbers, NaN and infinities."""
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise ParameterError(field, value, f"{allowed} ({unit})" if unit else allowed)
    return float(value)


def positive(field: str, value: object, unit: str = "") -> float:
    """`value` as a float; refuses what is not above zero."""
    allowed = f"a finite number above 0 {unit}".rstrip()
    number = finite(field, value, allowed=allowed)
    if number <= 0.0:
        raise ParameterError(field, value, allowed)
    return number


def not_negative(field: str, value: object, unit: str = "") -> float:
    """`value` as a float; refuses what is below zero."""
    allowed = f"a finite number, 0 {unit} or more".replace("0  or", "0 or")
    number = finite(field, value, allowed=allowed)
    if number < 0.0:
        raise ParameterError(field, value, allowed)
    return number


def angle(field: str, value: object) -> float:
    """`value` in rad as a float; refuses |value| >= pi/2, where the cam geometry ends (eq. 3)."""
    allowed = "an angle in rad strictly between -pi/2 and pi/2"
    number = finite(field, value, allowed=allowed)
    if abs(number) >= math.pi / 2.0:
        hint = f"in degrees? {number:g} degrees are {math.radians(number):.6g} rad"
        raise ParameterError(field, value, allowed, hint)
    return number


def increasing_times(time: ArrayLike) -> FloatArray:
    """`time` (s) as an array (n,), refused unless it has two or more finite, increasing instants."""
    try:
        instants = np.array(time, dtype=np.float64)
    except (TypeError, ValueError):
        raise ParameterError("time", time, "an array of numbers (s)") from None
    if instants.ndim != 1 or instants.size < 2:
        given = f"array of shape {instants.shape}"
        raise ParameterError("time", given, "one-dimensional with two or more instants")
    for i, value in enumerate(instants):
        finite(f"time[{i}]", value, "s")
    for i in np.flatnonzero(np.diff(instants) <= 0.0)[:1]:
        raise ParameterError(f"time[{i + 1}]", instants[i + 1], f"above time[{i}] = {instants[i]} s")
    return instants
