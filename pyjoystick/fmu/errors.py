"""What can be wrong with an FMU or with a run of it."""

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
        advice: how to get it
    """

    fmu: str
    advice: str
    _message = "there is no FMU {fmu}; {advice}"


class FmuFileError(InputFileError):
    """The file is not an FMU, or a broken one."""


class UnsupportedFmuError(FmuFileError):
    """The FMU is sound, but cannot be run here: another FMI version, interface or platform."""


@dataclass(eq=False)
class FmuRunError(SimulationError):
    """The FMU rejected its settings or failed during a run.

    Attributes:
        time: the last communication point (s) that was reached
        reason: the FMI function that failed, and how
        path: the FMU
        messages: what the FMU itself reported, oldest first
    """

    path: Path
    messages: tuple[str, ...] = ()

    def __str__(self) -> str:
        said = "; ".join(message.rstrip(".") for message in self.messages)
        return f"{self.path.name} at t = {self.time:.9g} s: {said or 'no message'} ({self.reason})"


#: The reason of an `FmuEndedError`.
THE_END: Final = "the FMU ended the simulation"


@dataclass(eq=False)
class FmuEndedError(FmuRunError):
    """The FMU ended the simulation by itself, before the requested end.

    Attributes:
        time: when it did so (s)
        samples: what was recorded up to there, in the form that the run would have returned
    """

    samples: Any = field(default=None, repr=False)

    def __str__(self) -> str:
        said = "; ".join(message.rstrip(".") for message in self.messages)
        return f"{self.path.name}: {self.reason} at t = {self.time:.9g} s{f': {said}' if said else ''}"


class StepperEndedError(FmuRunError):
    """A simulation was to go on after its end; the reason says how it ended."""

    def __str__(self) -> str:
        return f"{self.path.name}: the simulation ended at t = {self.time:.9g} s: {self.reason}"


class FmuCrashError(FmuRunError):
    """The process of the FMU ended in a run; the reason has its signal or exit code, and what it printed."""


class FmuTrapError(FmuRunError):
    """The WebAssembly module of an FMU in a sandbox trapped or broke a rule; the reason says which."""


class FmuFuelError(FmuTrapError):
    """A run in a sandbox took more instructions than it may, and was ended."""


class FmuMemoryError(FmuTrapError):
    """The module of an FMU in a sandbox found no memory for a run within its limit."""


class FmuTimeLimitError(FmuRunError):
    """A run took longer than it may, and was ended."""
