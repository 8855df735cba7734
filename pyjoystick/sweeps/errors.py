"""What can be wrong with a sweep."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from pyjoystick.errors import PyJoystickError


class SettingsError(PyJoystickError, ValueError):
    """The settings of a sweep cannot be used.

    Attributes:
        path: the settings file
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


class ChangedSweepError(PyJoystickError):
    """What was kept of a sweep belongs to other settings, another FMU or another version.

    Attributes:
        path: the result of the sweep
        differences: what is not as it was, one line each
    """

    def __init__(self, path: Path, differences: Sequence[str]) -> None:
        super().__init__(path, tuple(differences))
        self.path = path
        self.differences = tuple(differences)

    def __str__(self) -> str:
        return (
            f"{self.path} was begun otherwise: {'; '.join(self.differences)}. "
            "Give the result another name, or begin anew with --overwrite"
        )


class SweepFileError(PyJoystickError):
    """A file of a sweep cannot be read.

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


class MissingPackageError(PyJoystickError, ImportError):
    """A package that only some uses need is not installed.

    Attributes:
        what: what needs it
        extra: the extra of pyjoystick that brings it
    """

    def __init__(self, what: str, extra: str) -> None:
        super().__init__(what, extra)
        self.what = what
        self.extra = extra

    def __str__(self) -> str:
        return f"{self.what} need more packages: pip install 'pyjoystick[{self.extra}]'"


class SensitivityError(PyJoystickError, ValueError):
    """Sensitivity indices cannot be had from these runs."""


class ClusterError(PyJoystickError):
    """The cluster cannot be used, or was lost; what was finished is kept.

    Attributes:
        address: of the scheduler
        reason: what is wrong
    """

    def __init__(self, address: str, reason: str) -> None:
        super().__init__(address, reason)
        self.address = address
        self.reason = reason

    def __str__(self) -> str:
        return f"Dask scheduler {self.address}: {self.reason}"
