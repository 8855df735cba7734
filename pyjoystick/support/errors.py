"""The errors of pyjoystick. Each names the thing it is about, its value and what is allowed."""

from __future__ import annotations

import copyreg
import difflib
import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Final

#: Up to so many names are listed whole; of more than that, the first few.
_MOST_LISTED: Final = 12
_FEW: Final = 5


class PyJoystickError(Exception):
    """Base class of every error that pyjoystick raises on purpose.

    A subclass with attributes is a dataclass, ``@dataclass(eq=False)`` because exceptions are compared by
    identity: its fields are the arguments of the constructor, and `_message` is formatted with them.
    """

    _message: ClassVar[str] = ""

    def __post_init__(self) -> None:
        self.args = tuple(vars(self).values())

    def __str__(self) -> str:
        return self._message.format_map(vars(self)) if self._message else super().__str__()

    def __reduce__(self) -> tuple[Any, ...]:
        # Exceptions are unpickled by calling the class with `args`, which keyword-only fields do not survive.
        return copyreg.__newobj__, (type(self), *self.args), vars(self)  # type: ignore[attr-defined]


@dataclass(eq=False)
class ParameterError(PyJoystickError, ValueError):
    """A value lies outside what is allowed.

    Attributes:
        field: name of the parameter or argument, dotted inside a structure (``forward.returnSpring.k_s``)
        value: the value that was given
        allowed: what is allowed, with the unit
        hint: a likely cause, or an empty string
    """

    field: str
    value: object
    allowed: str
    hint: str = ""

    def __str__(self) -> str:
        message = f"{self.field} = {self.value}: must be {self.allowed}"
        return f"{message} ({self.hint})" if self.hint else message

    def within(self, parent: str) -> ParameterError:
        """The same error with the field named inside `parent`."""
        return ParameterError(f"{parent}.{self.field}", self.value, self.allowed, self.hint)


@dataclass(eq=False)
class UnknownNameError(PyJoystickError, KeyError):
    """Nothing has the given name; the message suggests similar names, or lists some that exist.

    Attributes:
        name: the name that was given
        known: the names that exist (a tuple)
        kind: what the names are names of
    """

    name: str
    known: Iterable[str]
    kind: str = "name"

    def __post_init__(self) -> None:
        self.known = tuple(self.known)
        super().__post_init__()

    def __str__(self) -> str:
        return f"there is no {self.kind} {self.name!r}; {self._advice(list(self.known))}"

    def _advice(self, known: list[str]) -> str:
        near = difflib.get_close_matches(str(self.name), known, n=3, cutoff=0.5)
        if near:
            return f"did you mean {' or '.join(near)}?"
        if len(known) <= _MOST_LISTED:
            return f"known are {', '.join(known) or 'none'}"
        more = f"{', '.join(known[:_FEW])} and {len(known) - _FEW} more"
        return f"known are {more} (those of an FMU: `pyjoystick info FMU --all`)"


@dataclass(eq=False)
class UnknownParameterError(UnknownNameError):
    """No parameter has the given name."""

    kind: str = "parameter"


@dataclass(eq=False)
class UnknownVariableError(UnknownNameError):
    """No variable that can be an output has the given name."""

    kind: str = "variable"


@dataclass(eq=False)
class UnknownInputError(UnknownNameError):
    """No input has the given name."""

    kind: str = "input"


@dataclass(eq=False)
class SimulationError(PyJoystickError, RuntimeError):
    """A run stopped before its end.

    Attributes:
        time: the time that was reached (s)
        reason: why the run stopped there
    """

    time: float
    reason: str
    _message = "the run stopped at t = {time:.9g} s: {reason}"


@dataclass(eq=False)
class SeriesError(PyJoystickError, ValueError):
    """A sampled series cannot be used.

    Attributes:
        series: name of the series
        reason: what is wrong, with the first offending index where there is one
    """

    series: str
    reason: str
    _message = "series {series!r}: {reason}"


@dataclass(eq=False)
class OutputFileError(PyJoystickError):
    """A result cannot be written; an existing file is left as it was.

    Attributes:
        path: the file
        reason: why it cannot be written
    """

    path: Path
    reason: str
    _message = "cannot write {path}: {reason}"


@dataclass(eq=False)
class InputFileError(PyJoystickError):
    """A file cannot be read.

    Attributes:
        path: the file
        reason: what is wrong with it
    """

    path: Path
    reason: str
    _message = "{path}: {reason}"


@dataclass(eq=False)
class MissingPackageError(PyJoystickError, ImportError):
    """An optional package is not installed.

    Attributes:
        what: what needs it
        extra: the extra of pyjoystick that installs it
    """

    what: str
    extra: str
    _message = "{what} need more packages: pip install 'pyjoystick[{extra}]'"


@dataclass(eq=False)
class SettingsError(PyJoystickError, ValueError):
    """An entry of a settings or parameter file (TOML) is not allowed.

    Attributes:
        path: the file
        table: name of the table in it, empty for the file as a whole
        key: the key in that table, empty for the table as a whole
        value: the value that was given, None if there was none
        allowed: what is allowed
        hint: a likely cause, or an empty string
    """

    path: Path
    table: str
    key: str
    value: object
    allowed: str
    hint: str = ""

    def __str__(self) -> str:
        place = " ".join(filter(None, (f"[{self.table}]" if self.table else "", self.key)))
        if not place:
            return f"{self.path}: {self.allowed}"
        given = "" if self.value is None else f" = {_as_written(self.value)}"
        hint = f" ({self.hint})" if self.hint else ""
        return f"{self.path}: {place}{given}: {self.allowed}{hint}"


def _as_written(value: object) -> str:
    try:
        return json.dumps(value, ensure_ascii=False)
    except (TypeError, ValueError):
        return str(value)
