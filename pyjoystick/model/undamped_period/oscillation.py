"""Common result of both period computations: the time that the motion takes over each piece of its path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from pyjoystick.support import PyJoystickError

Side = Literal["forward", "backward"]


@dataclass(eq=False)
class NoOscillationError(PyJoystickError, ValueError):
    """After this release, the mechanism does not swing through the middle and back.

    Attributes:
        release: where it was released (rad, or m)
        reason: why it does not oscillate
    """

    release: float
    reason: str
    _message = "no oscillation through the middle after a release at {release:.6g}: {reason}"


@dataclass(frozen=True, slots=True)
class Span:
    """A piece of the path between two neighboring kinks, or a kink and the turning point.

    Attributes:
        side: the side of the middle on which it lies
        segment: 0 for the clearance, i + 1 where the stiffness k_i of Table 1 acts
        inner, outer: distances of its ends from the middle (rad, or m)
        duration: time that the motion takes over it, one way (s)
    """

    side: Side
    segment: int
    inner: float
    outer: float
    duration: float


@dataclass(frozen=True, slots=True)
class UndampedOscillation:
    """A periodic oscillation without damping and torque.

    Attributes:
        forward, backward: largest distances from the middle on either side (rad, or m), above 0
        spans: the pieces of the path, each once; the motion passes each twice in a period
        error: estimate of the error of the period (s); 0 where only rounding is left
    """

    forward: float
    backward: float
    spans: tuple[Span, ...]
    error: float = 0.0

    @property
    def period(self) -> float:
        """The period (s)."""
        return 2.0 * sum(span.duration for span in self.spans)

    def share(self, *segments: int) -> float:
        """Fraction of the period spent in segments with these numbers, on both sides together."""
        inside = sum(span.duration for span in self.spans if span.segment in segments)
        return 2.0 * inside / self.period


def other_side(side: Side) -> Side:
    """The side opposite to `side`."""
    return "backward" if side == "forward" else "forward"


def side_of(release: float) -> Side:
    """The side on which a release (rad, or m) lies."""
    return "forward" if release > 0.0 else "backward"
