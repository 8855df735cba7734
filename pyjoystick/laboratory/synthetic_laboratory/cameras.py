"""Synthetic records of known motions by cameras and an accelerometer.

`synthetic_record` and `synthetic_swing` return the angle itself, `synthetic_markers` the markers from which
it is found. The joystick is simulated by the pure-Python reference, not by the FMU, so that parameters
recovered with the FMU do not originate from it. The impacts of the plungers, which ring in a real
accelerometer (Fig. 4d), are not simulated.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.integrate import solve_ivp

from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.model import JoystickParameters, simulate
from pyjoystick.motion import GRAVITY, Record
from pyjoystick.support import FloatArray, angle, not_negative, positive

#: Sampling rate of the paper's camera system (Hz).
CAMERA_RATE: Final = 60.0
#: Standard deviation of the angle's noise (rad): 0.1 degree.
ANGLE_NOISE: Final = math.radians(0.1)


def synthetic_record(
    parameters: JoystickParameters,
    *,
    release_angle: float,
    random: np.random.Generator,
    name: str = "synthetic",
    release_time: float = 0.25,
    duration: float = 1.75,
    rate: float = CAMERA_RATE,
    noise: float = ANGLE_NOISE,
) -> Record:
    """A joystick held at an angle, released and sampled by a camera until the end.

    Args:
        parameters: the joystick
        release_angle: angle of hold and release (rad), positive forward
        random: random generator for the noise
        name: name of the record
        release_time: time of release (s) on the clock of the record, 0 or more; need not coincide with a
            sample
        duration: time of the last sample (s), after the release
        rate: sampling rate (Hz)
        noise: standard deviation of the angle's independent normal noise (rad), 0 for none

    Raises:
        ParameterError: a value is not finite or outside its range
        SimulationError: the motion reaches pi/2
    """
    start = angle("release_angle", release_angle)
    released = not_negative("release_time", release_time, "s")
    count = math.floor(positive("duration", duration, "s") * positive("rate", rate, "Hz")) + 1
    time = np.arange(count) / rate
    after = time > released
    theta = np.full(count, start)
    run = simulate(parameters, time=np.insert(time[after], 0, released), theta_start=start)
    theta[after] = run.theta[1:]
    theta += not_negative("noise", noise, "rad") * random.standard_normal(count)
    return Record(name, time, theta, source="synthetic, by the reference")


def synthetic_swing(
    parameters: JoystickParameters,
    *,
    random: np.random.Generator,
    amplitude: float = math.radians(25.0),
    damping: float = 0.002,
    offset: float = 0.0,
    duration: float = 20.0,
    rate: float = 60.0,
    noise: float = math.radians(0.05),
) -> Record:
    """Motion of J*theta'' + C*theta' + m*g*h*sin(theta) = 0 from rest, sampled with noise.

    Args:
        parameters: the joystick; only J, m, h and g are used
        random: random generator for the noise
        amplitude: release angle (rad)
        damping: C of the pivot and the air (N m s/rad)
        offset: reading at rest (rad)
        duration: length of the record (s)
        rate: sampling rate (Hz)
        noise: standard deviation of the angle's independent normal noise (rad), 0 for none
    """
    weight = parameters.m * parameters.g * parameters.h

    def right_hand_side(_: float, state: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[float]:
        theta, omega = state
        return [omega, (-weight * math.sin(theta) - damping * omega) / parameters.J]

    time = np.arange(0.0, duration, 1.0 / rate)
    solution = solve_ivp(
        right_hand_side, (0.0, duration), [amplitude, 0.0], t_eval=time, rtol=1e-10, atol=1e-12
    )
    theta = solution.y[0] + offset + noise * random.standard_normal(time.size)
    return Record("synthetic swing", time, theta)


#: Names of the markers that `synthetic_markers` makes.
TOP: Final = "TOP"
BASE: Final = ("BASE1", "BASE2")


@dataclass(frozen=True, slots=True)
class MarkerLayout:
    """Positions of the markers, in a frame at the pivot: forward, left, up.

    Attributes:
        height: from the pivot to the marker on top (m); by default Table 2's handle
        bases: positions of the two markers on the base (m)
        pivot: position of the pivot in the laboratory (m)
        heading: angle from the x axis of the laboratory to forward (rad), about the vertical
        sideways: largest motion of the top to the left, relative to the largest forward motion, a quarter of
            a period apart as on an ellipse, which does not rotate the plane
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
    """The markers `TOP` and `BASE` of a joystick with a known angle.

    Args:
        time: times of the frames (s), shape (n,)
        theta: angle (rad), shape (n,), positive forward
        random: random generator for the noise
        noise: standard deviation of each coordinate's independent normal noise (m), 0 for none
        layout: positions of the markers; by default those of `MarkerLayout`

    Raises:
        ParameterError: the noise is not finite or below zero
        RecordError: fewer than three frames, or the time does not increase
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
    """Reading of an accelerometer on the front of the joystick: L alpha - g sin(theta), plus noise (m/s2).

    Args:
        theta: angle (rad), shape (n,), positive forward
        alpha: angular acceleration (rad/s2), shape (n,)
        distance: from the pivot to the accelerometer, L (m)
        random: random generator for the noise
        noise: standard deviation of independent normal noise (m/s2), 0 for none
        gravity: g (m/s2)

    Raises:
        ParameterError: the noise is not finite or below zero
    """
    scatter = not_negative("noise", noise, "m/s2") * random.standard_normal(len(theta))
    return np.asarray(distance * alpha - gravity * np.sin(theta) + scatter, dtype=np.float64)
