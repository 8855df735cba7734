"""Doubts about a measured angle, one sentence each."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from pyjoystick.laboratory.measurements.marker_path import Circle, MotionPlane
from pyjoystick.laboratory.measurements.markers import unseen
from pyjoystick.support import FloatArray

#: The rest position is the mean over this time at the end of a record (s).
REST_TIME: Final = 0.25
#: Thresholds for notes: motion at rest (rad), fraction of the motion out of the plane, and motion of the base
#: and standard error of the radius, both relative to the radius.
_RESTLESS: Final = math.radians(0.5)
_OUT_OF_PLANE: Final = 0.05
_BASE_MOVES: Final = 0.005
_RADIUS_UNCERTAIN: Final = 0.01
_NO_RADIUS: Final = 0.5
#: Differences of more than this many standard errors between arc radius and measured radius are noted.
_RADII_DIFFER: Final = 3.0


def rest_notes(theta: FloatArray) -> list[str]:
    """Note that the angle (degrees) moves at rest."""
    moved = float(np.ptp(theta))
    if moved > math.degrees(_RESTLESS):
        return [f"the angle moves by {moved:.2f} degrees in the rest position: zero is its mean there"]
    return []


def plane_notes(plane: MotionPlane) -> list[str]:
    """Note that the motion leaves its plane."""
    if plane.out_of_plane > _OUT_OF_PLANE:
        share = 100.0 * plane.out_of_plane
        return [f"the motion is not planar: the top leaves the plane by {share:.1f} % of its excursion"]
    return []


def base_notes(time: FloatArray, middle: FloatArray, radius: float) -> list[str]:
    """Note that the base moves, from means of stretches, which average out the markers' noise."""
    stretches = np.floor((time - time[0]) / REST_TIME)
    means = [mean_position(middle[stretches == k]) for k in np.unique(stretches)]
    moved = float(np.max(np.nanmax(means, axis=0) - np.nanmin(means, axis=0)))
    if moved > _BASE_MOVES * radius:
        return [f"the base moves by {1e3 * moved:.1f} mm: is it a moving base?"]
    return []


def arc_notes(arc: Circle) -> list[str]:
    """Note that the arc does not determine its radius well."""
    if arc.radius_error > _RADIUS_UNCERTAIN * arc.radius:
        share = 100.0 * arc.radius_error / arc.radius
        return [f"the arc's radius has a standard error of {share:.1f} %, and so does the scale of the angle"]
    return []


def radius_notes(arc: Circle, radius: float) -> list[str]:
    """Note that the measured radius (m) differs from that of the arc, or that the arc has none."""
    if not arc.radius_error < _NO_RADIUS * arc.radius:
        found = f"{1e3 * arc.radius:.0f} +- {1e3 * arc.radius_error:.0f} mm"
        return [f"the arc does not confirm the radius: its own is {found}"]
    if abs(arc.radius - radius) > _RADII_DIFFER * arc.radius_error:
        return [
            f"the arc's radius is {1e3 * arc.radius:.1f} +- {1e3 * arc.radius_error:.1f} mm, "
            f"{1e3 * radius:.1f} mm were given: is it measured from the pivot to the middle of the marker?"
        ]
    return []


def mean_position(values: FloatArray) -> FloatArray:
    """The mean position over the frames in which it is known."""
    known = ~unseen(values)
    return np.asarray(values[known].mean(axis=0)) if known.any() else np.full(3, np.nan)
