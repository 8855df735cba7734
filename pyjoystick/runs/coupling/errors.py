"""What can be wrong with a system of FMUs."""

from __future__ import annotations

from pyjoystick.support import PyJoystickError


class CouplingError(PyJoystickError):
    """FMUs cannot be put together as asked.

    Attributes:
        system: name of the system
        place: the component or the connection
        reason: what is wrong with it, and what is allowed
    """

    def __init__(self, system: str, place: str, reason: str) -> None:
        super().__init__(system, place, reason)
        self.system = system
        self.place = place
        self.reason = reason

    def __str__(self) -> str:
        return f"system {self.system!r}: {self.place}: {self.reason}"
