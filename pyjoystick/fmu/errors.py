"""Errors of FMUs and of their runs."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from pyjoystick.support import InputFileError, PyJoystickError, SimulationError


@dataclass(eq=False)
class FmuNotFoundError(PyJoystickError):
    """There is no such FMU.

    Attributes:
        fmu: requested name or path
        advice: how to obtain it
    """

    fmu: str
    advice: str
    _message = "there is no FMU {fmu}; {advice}"


class FmuFileError(InputFileError):
    """The file is not an FMU, or is a broken one."""


class UnsupportedFmuError(FmuFileError):
    """The FMU is valid, but cannot run here: FMI version, interface or platform is not supported."""


@dataclass(eq=False)
class FmuRunError(SimulationError):
    """The FMU rejected its settings or failed during a run.

    Attributes:
        time: the last communication point (s) that was reached
        reason: the FMI function that failed, and how
        path: the FMU
        messages: messages of the FMU, oldest first
    """

    path: Path
    messages: tuple[str, ...] = ()

    def __str__(self) -> str:
        said = "; ".join(message.rstrip(".") for message in self.messages)
        return f"{self.path.name} at t = {self.time:.9g} s: {said or 'no message'} ({self.reason})"


#: Reason of an `FmuEndedError`.
THE_END: Final = "the FMU ended the simulation"


@dataclass(eq=False)
class FmuEndedError(FmuRunError):
    """The FMU terminated the simulation before the requested end.

    Attributes:
        time: time of termination (s)
        samples: samples up to there, in the form that the run would have returned
    """

    samples: Any = field(default=None, repr=False)

    def __str__(self) -> str:
        said = "; ".join(message.rstrip(".") for message in self.messages)
        return f"{self.path.name}: {self.reason} at t = {self.time:.9g} s{f': {said}' if said else ''}"


class StepperEndedError(FmuRunError):
    """A simulation that has ended was used again; the reason describes how it ended."""

    def __str__(self) -> str:
        return f"{self.path.name}: the simulation ended at t = {self.time:.9g} s: {self.reason}"


class FmuCrashError(FmuRunError):
    """The FMU's process ended during a run; the reason has its signal or exit code, and its output."""


class FmuTrapError(FmuRunError):
    """The WebAssembly module of a sandboxed FMU trapped or broke a rule, which the reason describes."""


class FmuFuelError(FmuTrapError):
    """A sandboxed run exceeded its limit of instructions and was stopped."""


class FmuMemoryError(FmuTrapError):
    """The module of a sandboxed FMU exceeded its memory limit."""


class FmuTimeLimitError(FmuRunError):
    """A run exceeded its time limit and was stopped."""


class NotFiniteWarning(RuntimeWarning):
    """Results of a run are NaN or infinite; the message names FMU, variables and times."""
