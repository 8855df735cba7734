"""The errors of pyjoystick. Each names the thing it is about, its value and what is allowed."""

from __future__ import annotations

import difflib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Final

#: Up to so many names are listed whole; of more than that, the first few.
_MOST_LISTED: Final = 12
_FEW: Final = 5


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


class UnknownNameError(PyJoystickError, KeyError):
    """Nothing has the given name; the message lists the nearest known names, or where none is near a few.

    Attributes:
        name: the name that was given
        known: the names that exist
    """

    kind = "name"

    def __init__(self, name: str, known: Iterable[str]) -> None:
        self.name = name
        self.known = tuple(known)
        super().__init__(name, self.known)

    def __str__(self) -> str:
        return f"there is no {self.kind} {self.name!r}; {self._advice()}"

    def _advice(self) -> str:
        near = difflib.get_close_matches(self.name, self.known, n=3, cutoff=0.5)
        if near:
            return f"did you mean {' or '.join(near)}?"
        if len(self.known) <= _MOST_LISTED:
            return f"known are {', '.join(self.known) or 'none'}"
        more = f"{', '.join(self.known[:_FEW])} and {len(self.known) - _FEW} more"
        return f"known are {more} (those of an FMU: `pyjoystick info FMU --all`)"


class UnknownParameterError(UnknownNameError):
    """No parameter has the given name."""

    kind = "parameter"


class UnknownVariableError(UnknownNameError):
    """No variable that can be an output has the given name."""

    kind = "variable"


class UnknownInputError(UnknownNameError):
    """No input has the given name."""

    kind = "input"


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


class OutputFileError(PyJoystickError):
    """A result cannot be written; what was there before is still there.

    Attributes:
        path: the file
        reason: why it cannot be written
    """

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(path, reason)
        self.path = path
        self.reason = reason

    def __str__(self) -> str:
        return f"cannot write {self.path}: {self.reason}"


class InputFileError(PyJoystickError):
    """A file cannot be read.

    Attributes:
        path: the file
        reason: what is wrong with it
    """

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(path, reason)
        self.path = path
        self.reason = reason

    def __str__(self) -> str:
        return f"{self.path}: {self.reason}"


class SettingsError(PyJoystickError, ValueError):
    """Something in a settings or parameter file (TOML) is not allowed.

    Attributes:
        path: the file
        table: name of the table in it, empty for the file as a whole
        key: the key in that table, empty for the table as a whole
        value: what was given, None where nothing was
        allowed: what is allowed
        hint: a likely cause, or an empty string
    """

    def __init__(self, path: Path, table: str, key: str, value: object, allowed: str, hint: str = "") -> None:
        super().__init__(path, table, key, value, allowed, hint)
        self.path = path
        self.table = table
        self.key = key
        self.value = value
        self.allowed = allowed
        self.hint = hint

    def __str__(self) -> str:
        place = " ".join(filter(None, (f"[{self.table}]" if self.table else "", self.key)))
        given = "" if self.value is None else f" = {_as_written(self.value)}"
        hint = f" ({self.hint})" if self.hint else ""
        return (
            f"{self.path}: {place}{given}: {self.allowed}{hint}" if place else f"{self.path}: {self.allowed}"
        )


def _as_written(value: object) -> str:
    try:
        return json.dumps(value, ensure_ascii=False)
    except (TypeError, ValueError):
        return str(value)
