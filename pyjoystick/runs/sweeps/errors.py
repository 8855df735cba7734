"""What can be wrong with a sweep."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pyjoystick.support import InputFileError, PyJoystickError


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
            f"{self.path} belongs to another sweep: {'; '.join(self.differences)}. "
            "Give the result another name, or begin anew with --overwrite"
        )


class SweepFileError(InputFileError):
    """A file of a sweep cannot be read."""


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
