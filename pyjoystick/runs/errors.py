"""Errors of coupled systems and of sweeps."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from pyjoystick.support import InputFileError, PyJoystickError


@dataclass(eq=False)
class CouplingError(PyJoystickError):
    """FMUs cannot be connected as requested.

    Attributes:
        system: name of the system
        place: the component or the connection
        reason: what is wrong with it, and what is allowed
    """

    system: str
    place: str
    reason: str
    _message = "system {system!r}: {place}: {reason}"


@dataclass(eq=False)
class ChangedSweepError(PyJoystickError):
    """The saved progress of a sweep belongs to other settings, another FMU or another version.

    Attributes:
        path: the result of the sweep
        differences: what has changed, one line each
    """

    path: Path
    differences: tuple[str, ...]

    def __str__(self) -> str:
        return (
            f"{self.path} belongs to another sweep: {'; '.join(self.differences)}. "
            "Choose another name for the result, or start over with --overwrite"
        )


class SweepFileError(InputFileError):
    """A file of a sweep cannot be read."""


class SensitivityError(PyJoystickError, ValueError):
    """Sensitivity indices cannot be computed from these runs."""


@dataclass(eq=False)
class ClusterError(PyJoystickError):
    """The cluster cannot be used, or was lost; finished runs are kept.

    Attributes:
        address: address of the scheduler
        reason: what is wrong
    """

    address: str
    reason: str
    _message = "Dask scheduler {address}: {reason}"
