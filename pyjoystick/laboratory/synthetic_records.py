"""Synthetic records: what a camera would have seen of a joystick whose parameters are known.

They are made by the pure-Python reference, not by the FMU, so that what is recovered from them through the
FMU was not put in by it. Wherever such a record appears it is called synthetic.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from pyjoystick.model import JoystickParameters, simulate
from pyjoystick.motion import Record
from pyjoystick.support import angle, not_negative, positive

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
        random: where the noise comes from
        name: name of the record
        release_time: instant of release (s) on the clock of the record, 0 or more; it need not be a sample
        duration: last instant of the record (s), after the release
        rate: samples a second (Hz)
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
