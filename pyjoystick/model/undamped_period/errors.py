"""The error of what does not oscillate about the middle."""

from __future__ import annotations

from pyjoystick.support import PyJoystickError


class NoOscillationError(PyJoystickError, ValueError):
    """Released there, the mechanism does not swing through the middle and back.

    Attributes:
        release: where it was released (rad, or m)
        reason: why
    """

    def __init__(self, release: float, reason: str) -> None:
        super().__init__(release, reason)
        self.release = release
        self.reason = reason

    def __str__(self) -> str:
        return f"no oscillation through the middle after a release at {self.release:.6g}: {self.reason}"
