"""What can be wrong with an FMU or with a run of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pyjoystick.support import PyJoystickError, SimulationError


class FmuNotFoundError(PyJoystickError):
    """There is no such FMU.

    Attributes:
        fmu: name or path that was asked for
        advice: how to get it
    """

    def __init__(self, fmu: str, advice: str) -> None:
        super().__init__(fmu, advice)
        self.fmu = fmu
        self.advice = advice

    def __str__(self) -> str:
        return f"there is no FMU {self.fmu}; {self.advice}"


class FmuFileError(PyJoystickError):
    """The file is not an FMU, or a broken one.

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


class UnsupportedFmuError(FmuFileError):
    """The FMU is sound, but cannot be run here: another FMI version, interface or platform."""


class FmuRunError(SimulationError):
    """The FMU refused its settings or failed during a run.

    Attributes:
        path: the FMU
        time: the last communication point (s) that was reached
        reason: the FMI function that failed, and how
        messages: what the FMU itself said, oldest first
    """

    def __init__(self, path: Path, time: float, reason: str, messages: Sequence[str] = ()) -> None:
        super().__init__(time, reason)
        self.args = (path, time, reason, tuple(messages))
        self.path = path
        self.messages = tuple(messages)

    def __str__(self) -> str:
        said = "; ".join(message.rstrip(".") for message in self.messages)
        return f"{self.path.name} at t = {self.time:.9g} s: {said or 'no message'} ({self.reason})"
