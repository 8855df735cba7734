"""Errors of estimates and fits that have no result."""

from __future__ import annotations

from dataclasses import dataclass

from pyjoystick.support import PyJoystickError


class DampingEstimateError(PyJoystickError, ValueError):
    """The peaks do not allow the requested estimate."""


@dataclass(eq=False)
class FitError(PyJoystickError):
    """A fit cannot be set up, or its first run fails.

    Attributes:
        subject: the record, parameter or FMU concerned
        reason: what is wrong and how to correct it
    """

    subject: str
    reason: str
    _message = "{subject}: {reason}"


class FitInterruptedError(PyJoystickError):
    """The fit was stopped (Ctrl-C) before it had a result."""

    _message = "the fit was stopped before it had a result"
