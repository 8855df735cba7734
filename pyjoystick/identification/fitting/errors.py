"""What can be wrong with a fit before it has a result."""

from __future__ import annotations

from pyjoystick.support import PyJoystickError


class FitError(PyJoystickError):
    """A fit cannot be set up, or its first run fails.

    Attributes:
        subject: the record, parameter or FMU that it is about
        reason: what is wrong and what to do
    """

    def __init__(self, subject: str, reason: str) -> None:
        super().__init__(subject, reason)
        self.subject = subject
        self.reason = reason

    def __str__(self) -> str:
        return f"{self.subject}: {self.reason}"


class FitInterruptedError(PyJoystickError):
    """The fit was stopped (Ctrl-C) before there was a result."""

    def __str__(self) -> str:
        return "the fit was stopped before there was a result"
