"""What cameras and an accelerometer would have seen of a motion that is known.

The impacts of the plungers, which ring in a real accelerometer (Fig. 4d), are not in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.motion import GRAVITY
from pyjoystick.support import FloatArray, not_negative

#: Names of the markers that `synthetic_markers` makes.
TOP: Final = "TOP"
BASE: Final = ("BASE1", "BASE2")


@dataclass(frozen=True, slots=True)
class MarkerLayout:
    """Where the markers are, in a frame at the pivot: forward, to the left, up.

    Attributes:
        height: from the pivot to the marker on top (m); Table 2's handle
        bases: the two markers on the base (m)
        pivot: place of the pivot in the laboratory (m)
        heading: from the x axis of the laboratory to forward (rad), about the vertical
        sideways: largest motion of the top to the left in parts of the largest forward, a quarter of a period
            apart as on an ellipse: none of it is a turn of the plane
    """

    height: float = 0.266
    bases: tuple[tuple[float, float, float], ...] = ((-0.08, 0.05, -0.03), (0.09, 0.05, -0.02))
    pivot: tuple[float, float, float] = (0.31, -0.12, 0.64)
    heading: float = math.radians(4.0)
    sideways: float = 0.02


def synthetic_markers(
    time: FloatArray,
    theta: FloatArray,
    *,
    random: np.random.Generator,
    noise: float = 3e-4,
    layout: MarkerLayout | None = None,
) -> Markers:
    """The markers `TOP` and `BASE` of a joystick that moves by a known angle.

    Args:
        time: instants of the frames (s), shape (n,)
        theta: angle there (rad), shape (n,), positive forward
        random: where the noise comes from
        noise: standard deviation of each coordinate's independent normal noise (m), 0 for none
        layout: where the markers are; the default of `MarkerLayout` where not given

    Raises:
        ParameterError: the noise is not finite or below zero
        RecordError: fewer than three frames, or a time that does not increase
    """
    place = layout or MarkerLayout()
    forward = place.height * np.sin(theta)
    speed = np.gradient(forward, time)
    left = place.sideways * speed * np.max(np.abs(forward)) / max(float(np.max(np.abs(speed))), 1e-12)
    top = np.stack((forward, left, place.height * np.cos(theta)), axis=1)
    bases = [np.broadcast_to(np.array(base), top.shape) for base in place.bases]
    cos, sin = math.cos(place.heading), math.sin(place.heading)
    turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    positions = np.stack((top, *bases), axis=1) @ turn.T + np.array(place.pivot)
    positions += not_negative("noise", noise, "m") * random.standard_normal(positions.shape)
    return Markers("synthetic", (TOP, *BASE), np.array(time), positions)


def synthetic_acceleration(
    theta: FloatArray,
    alpha: FloatArray,
    *,
    distance: float,
    random: np.random.Generator,
    noise: float = 0.05,
    gravity: float = GRAVITY,
) -> FloatArray:
    """What an accelerometer on the front of the joystick reads: L alpha - g sin(theta), and noise (m/s2).

    Args:
        theta: angle (rad), shape (n,), positive forward
        alpha: angular acceleration (rad/s2), shape (n,)
        distance: from the pivot to the accelerometer, L (m)
        random: where the noise comes from
        noise: standard deviation of independent normal noise (m/s2), 0 for none
        gravity: g (m/s2)

    Raises:
        ParameterError: the noise is not finite or below zero
    """
    scatter = not_negative("noise", noise, "m/s2") * random.standard_normal(len(theta))
    return np.asarray(distance * alpha - gravity * np.sin(theta) + scatter, dtype=np.float64)
