"""The errors of pyjoystick. Each names the thing it is about, its value and what is allowed."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class PyJoystickError(Exception):
    """Base class of every error that pyjoystick raises on purpose."""


class ParameterError(PyJoystickError, ValueError):
    """A value lies outside what is allowed.

    Attributes:
        field: name of the parameter or argument, dotted inside a structure (``forward.returnSpring.k_s``)
        value: the value that was given
        allowed: what is allowed, with the unit
        hint: a likely cause, or an empty string
    """

    def __init__(self, field: str, value: object, allowed: str, hint: str = "") -> None:
        super().__init__(field, value, allowed, hint)
        self.field = field
        self.value = value
        self.allowed = allowed
        self.hint = hint

    def __str__(self) -> str:
        message = f"{self.field} = {self.value}: must be {self.allowed}"
        return f"{message} ({self.hint})" if self.hint else message

    def within(self, parent: str) -> ParameterError:
        """The same error with the field named inside `parent`."""
        return ParameterError(f"{parent}.{self.field}", self.value, self.allowed, self.hint)


class UnknownParameterError(PyJoystickError, KeyError):
    """No parameter has the given name; the message lists the nearest known names.

    Attributes:
        name: the name that was given
        known: the names that exist
    """

    def __init__(self, name: str, known: Iterable[str]) -> None:
        self.name = name
        self.known = tuple(known)
        super().__init__(name, self.known)

    def __str__(self) -> str:
        near = difflib.get_close_matches(self.name, self.known, n=3, cutoff=0.5)
        names = f"did you mean {' or '.join(near)}?" if near else f"known are {', '.join(self.known)}"
        return f"there is no parameter {self.name!r}; {names}"


class SimulationError(PyJoystickError, RuntimeError):
    """A run could not be carried to its end.

    Attributes:
        time: the time that was reached (s)
        reason: why the run stopped there
    """

    def __init__(self, time: float, reason: str) -> None:
        super().__init__(time, reason)
        self.time = time
        self.reason = reason

    def __str__(self) -> str:
        return f"the run stopped at t = {self.time:.9g} s: {self.reason}"


class SeriesError(PyJoystickError, ValueError):
    """A sampled series cannot be used.

    Attributes:
        series: name of the series
        reason: what is wrong, with the first offending index where there is one
    """

    def __init__(self, series: str, reason: str) -> None:
        super().__init__(series, reason)
        self.series = series
        self.reason = reason

    def __str__(self) -> str:
        return f"series {self.series!r}: {self.reason}"
