"""Setups of instruments, with settings for reading their files."""

from __future__ import annotations

from dataclasses import dataclass, field

from pyjoystick.laboratory.measurements.chain import Chain
from pyjoystick.model import Side
from pyjoystick.support import ParameterError


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkerSetup:
    """Settings for finding the joystick's angle from its markers.

    Attributes:
        top: name of the marker on top of the joystick
        base: names of the two markers on the base
        forward: axis of the laboratory that points forward: x, -x, y, -y, z or -z
        up: axis in the plane of motion, if it cannot be found from the markers
        middle: whether the pivot is the middle of the base markers instead of the center of the arc
        radius: measured distance from the pivot to the top marker (m); by default that of the arc
        moving_base: whether the angle is relative to the base in each frame
        rest: first and last time (s) of an interval at rest; by default the last 0.25 s
        rests: side to which the joystick leans at rest; the zero is then the middle of its clearance
        released: side of the release, if known; other records are rejected
        unit: unit of the positions, if the file gives none
        chain: the signal chain of the filtered motion

    Raises:
        ParameterError: a radius was given together with the middle of the base
    """

    top: str
    base: tuple[str, str]
    forward: str = "x"
    up: str | None = None
    middle: bool = False
    radius: float | None = None
    moving_base: bool = False
    rest: tuple[float, float] | None = None
    rests: Side | None = None
    released: Side | None = None
    unit: str | None = None
    chain: Chain = field(default_factory=Chain)

    def __post_init__(self) -> None:
        if self.middle and self.radius is not None:
            allowed = "left out with middle, which is another pivot than the center of an arc of this radius"
            raise ParameterError("radius", self.radius, allowed)


@dataclass(frozen=True, slots=True, kw_only=True)
class AccelerometerSetup:
    """Position of an accelerometer, and settings for reading its file.

    Attributes:
        distance: from the pivot to the accelerometer (m)
        column: heading of the readings
        unit: unit if the heading gives none: m/s2, mm/s2, g, V or mV
        rate: sampling rate (Hz) of a file without times
        sensitivity: V/(m/s2), for voltages
        full_scale: largest reading, in the unit of the file, to detect saturation
        delay: time on its clock (s) at time zero of the angle
        backward: whether its positive direction is backward
        rest: first and last time (s) of an interval at rest; by default the last 0.25 s
        chain: the signal chain of the angle
    """

    distance: float
    column: str = "acceleration"
    unit: str | None = None
    rate: float | None = None
    sensitivity: float | None = None
    full_scale: float | None = None
    delay: float = 0.0
    backward: bool = False
    rest: tuple[float, float] | None = None
    chain: Chain = field(default_factory=Chain)
