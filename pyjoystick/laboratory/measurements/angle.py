"""The joystick's angle from three markers: one on top of it, two on its base (section 2 of the paper).

The vectors from the pivot to the top, projected onto the plane of motion, give the angle from the rest
position by their dot and cross products: ``atan2(cross, dot)`` has a sign and is accurate near zero, where
the dot product alone is flat. The plane is that of the top marker's path. The pivot is the center of this
path's arc, which is far more certain if the arc's radius was measured. With the middle of the base markers as
the pivot, the angle is wrong by a factor of about L/(L + d), where d is the distance of the middle below the
pivot and L the distance from the pivot to the top.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from pyjoystick.laboratory.measurements.angle_notes import (
    REST_TIME,
    arc_notes,
    base_notes,
    mean_position,
    plane_notes,
    radius_notes,
    rest_notes,
)
from pyjoystick.laboratory.measurements.marker_path import Circle, MotionPlane, fit_circle, motion_plane
from pyjoystick.laboratory.measurements.markers import Markers, unseen
from pyjoystick.model import JoystickParameters, Side, angle_of_travel
from pyjoystick.motion import Record, RecordError, glitch_notes, require_no_glitch, uneven_notes
from pyjoystick.support import FloatArray, angle, positive

Origin = Literal["arc", "middle"]
Base = Literal["still", "moving"]

#: Axes of the laboratory by name.
AXES: Final = {
    f"{sign}{name}": np.array([(-1.0 if sign else 1.0) * (name == other) for other in "xyz"])
    for name in "xyz"
    for sign in ("", "-")
}
#: Relative standard error of the radius above which the pivot is rejected.
_RADIUS_UNKNOWN: Final = 0.05
_FEWEST: Final = 10


@dataclass(frozen=True, slots=True, eq=False)
class AngleMeasurement:
    """The angle in each frame, and how it was found.

    Attributes:
        source: source of the markers
        time: times of the frames (s), shape (n,)
        theta: angle from the rest position (rad), shape (n,), positive forward, NaN if a marker is missing
        rows: rows of the frames in the source, shape (n,)
        rate: frame rate (Hz)
        plane: the plane of motion
        arc: circle of the top marker's path, in the plane's coordinates
        pivot: center of the angle, relative to the middle of the base markers, in the plane's coordinates
            (m), shape (2,)
        rest_radius: from the pivot to the top at rest (m), in the plane's coordinates, shape (2,)
        noise: standard deviation of the angle's noise (rad), from the distances to the arc
        notes: doubts, one sentence each
    """

    source: str
    time: FloatArray
    theta: FloatArray
    rows: NDArray[np.int64]
    rate: float
    plane: MotionPlane
    arc: Circle
    pivot: FloatArray
    rest_radius: FloatArray
    noise: float
    notes: tuple[str, ...]

    def record(self, name: str) -> Record:
        """Frames in which the angle is known, as measured: neither filtered nor interpolated.

        Raises:
            RecordError: fewer than three, or an angle of pi/2 or more
        """
        seen = np.isfinite(self.theta)
        return Record(
            name,
            self.time[seen],
            self.theta[seen],
            source=self.source,
            notes=self.notes,
            rows=self.rows[seen],
        )


def measure_angle(
    markers: Markers,
    *,
    top: str,
    base: Sequence[str],
    forward: str,
    origin: Origin = "arc",
    radius: float | None = None,
    base_motion: Base = "still",
    up: str | None = None,
    rest: tuple[float, float] | None = None,
    rest_angle: float = 0.0,
) -> AngleMeasurement:
    """Compute the joystick's angle from its markers.

    Args:
        markers: positions of the markers
        top: name of the marker on top of the joystick
        base: names of the two markers on the base
        forward: axis of the laboratory that is closest to forward: a name of `AXES`
        origin: center of the angle: that of the top marker's arc, or the middle of the base markers
        radius: measured distance from the pivot to the top marker (m); by default that of the arc;
            not used with the middle
        base_motion: ``still`` uses the mean position of the base markers, which averages their noise;
            ``moving`` computes angle and pivot relative to the base in each frame; its two markers
            must then be apart in the plane of motion
        up: axis of the laboratory in the plane of motion (the paper's z), a name of `AXES`; by
            default the plane is found from the motion alone
        rest: first and last time (s) of an interval at rest, on the clock of the markers; by default the
            last `REST_TIME` with the markers visible
        rest_angle: angle there (rad): a joystick leans to one end of its clearance

    Raises:
        ParameterError: the radius is not above zero, or `rest_angle` is not an angle
        RecordError: a marker does not exist or was never seen, the rest interval is empty, the plane or the
            pivot is uncertain, forward is not an axis along the motion, or the angle jumps
    """
    for axis in (forward, up or forward):
        if axis not in AXES:
            raise RecordError(markers.source, f"{axis!r} is not an axis", f"known are {', '.join(AXES)}")
    first, second = _two(markers, base)
    seen = ~unseen(markers.of(top))
    middle, span = (first + second) / 2.0, second - first
    if base_motion == "moving":
        seen &= ~unseen(span)
    else:
        middle, span = (np.broadcast_to(mean_position(value), middle.shape) for value in (middle, span))
    if np.count_nonzero(seen) < _FEWEST:
        reason = f"are in sight together in {np.count_nonzero(seen)} frames, at least {_FEWEST} are needed"
        column = ", ".join([top, *base])
        raise RecordError(markers.source, reason, "choose other markers or another record", column=column)
    path = (markers.of(top) - middle)[seen]
    still = _rest(markers, seen, rest)[seen]
    center = path[still].mean(axis=0)
    plane = motion_plane(path, center, AXES[forward], markers.source, up=AXES[up] if up else None)
    flat = plane.project(path)
    if base_motion == "moving":
        flat = _turned_back(flat, plane.project(span[seen]), still, markers.source)
    arc = fit_circle(flat)
    pivot = _pivot(flat, arc, origin, radius, markers.source, top)
    theta = np.full(len(seen), np.nan)
    rest_radius = (flat[still] - pivot).mean(axis=0)
    theta[seen] = angle("rest_angle", rest_angle) + _angle(flat - pivot, rest_radius)
    motion = markers.time[seen], theta[seen], markers.rows[seen]
    require_no_glitch(
        markers.source,
        *motion,
        question="is a marker somewhere else there, or its label swapped?",
        advice="empty the marker's cells in these frames; short gaps are interpolated",
    )
    notes = [
        *markers.notes,
        *uneven_notes(markers.time),
        *rest_notes(np.degrees(theta[seen][still])),
        *plane_notes(plane),
        *(base_notes(markers.time, (first + second) / 2.0, arc.radius) if base_motion == "still" else ()),
        *(arc_notes(arc) if radius is None else radius_notes(arc, radius)),
        *glitch_notes(*motion, question="is a marker wrong there?"),
    ]
    return AngleMeasurement(
        source=markers.source,
        time=markers.time,
        theta=theta,
        rows=markers.rows,
        rate=markers.rate,
        plane=plane,
        arc=arc,
        pivot=pivot,
        rest_radius=rest_radius,
        noise=arc.noise / arc.radius,
        notes=tuple(notes),
    )


def rest_angle(parameters: JoystickParameters, side: Side) -> float:
    """Angle (rad) at which a joystick leans against the springs of one side, positive forward.

    Gravity tips it over within its clearance. The deflection of the springs is neglected: with the paper's
    stiffnesses, 0.3 % of the angle.
    """
    actuator = parameters.forward if side == "forward" else parameters.backward
    leaning = angle_of_travel(parameters, actuator.return_spring.x_0)
    return leaning if side == "forward" else -leaning


def _pivot(
    flat: FloatArray, arc: Circle, origin: Origin, radius: float | None, source: str, top: str
) -> FloatArray:
    """Position of the pivot in the plane, shape (2,), from the middle of the base markers."""
    if origin == "middle":
        return np.zeros(2)
    if radius is not None:
        return fit_circle(flat, positive("radius", radius, "m")).center
    if not arc.radius_error < _RADIUS_UNKNOWN * arc.radius:
        raise RecordError(
            source,
            f"the pivot is uncertain: the arc's radius is {1e3 * arc.radius:.0f} mm with a standard error of "
            f"{1e3 * arc.radius_error:.0f} mm",
            "measure the radius, use a record of larger motion, or take the middle of the base markers",
            column=top,
        )
    return arc.center


def _two(markers: Markers, base: Sequence[str]) -> tuple[FloatArray, FloatArray]:
    if len(base) != 2 or markers.index(base[0]) == markers.index(base[1]):
        reason = f"names {', '.join(base) or 'nothing'} as markers of the base"
        raise RecordError(markers.source, reason, "name two different ones")
    for name in base:
        if markers.missing(name).all():
            raise RecordError(markers.source, "is never visible", "choose another marker", column=name)
    first, second = (markers.of(name) for name in base)
    return first, second


def _rest(markers: Markers, seen: NDArray[np.bool_], rest: tuple[float, float] | None) -> NDArray[np.bool_]:
    """The frames at rest."""
    last = markers.time[seen][-1]
    start, end = (last - REST_TIME, last) if rest is None else rest
    still = seen & (markers.time >= start) & (markers.time <= end)
    if not still.any():
        reason = f"no frame with the markers in sight between {start:g} and {end:g} s, called at rest"
        advice = f"the record goes from {markers.time[0]:g} to {markers.time[-1]:g} s"
        raise RecordError(markers.source, reason, advice)
    return still


def _turned_back(flat: FloatArray, span: FloatArray, still: NDArray[np.bool_], source: str) -> FloatArray:
    """Positions relative to the base, with the base's rotation in the plane removed."""
    length = np.hypot(*span.T)
    if np.min(length) < 0.2 * np.max(length) or np.max(length) < 1e-2:
        raise RecordError(
            source,
            f"the base markers are only {1e3 * np.min(length):.1f} mm apart in the plane of motion",
            "for a moving base, place them one behind the other along the motion; otherwise leave out "
            "--moving-base",
        )
    turned = _signed(span, span[still].mean(axis=0))
    cos, sin = np.cos(turned), np.sin(turned)
    x, y = flat.T
    return np.column_stack((cos * x + sin * y, -sin * x + cos * y))


def _signed(vectors: FloatArray, start: FloatArray) -> FloatArray:
    """Angles from a vector to others in a plane (rad), from cross and dot product, shape (n,)."""
    cross = start[0] * vectors[:, 1] - start[1] * vectors[:, 0]
    return np.asarray(np.arctan2(cross, vectors @ start), dtype=np.float64)


def _angle(radii: FloatArray, rest: FloatArray) -> FloatArray:
    """Angles from the rest position, positive along the first axis, for a pivot on either side."""
    return _signed(radii, rest) * (-1.0 if rest[1] > 0.0 else 1.0)
