"""What the paper's cameras and signal chain would make of a motion that is known (section 2, Fig. 14)."""

from __future__ import annotations

import math

import numpy as np

from pyjoystick.forced_motion.measured import through_chain
from pyjoystick.forced_motion.motions import ForwardAndReturn
from pyjoystick.forced_motion.samples import Samples
from pyjoystick.laboratory import BASE, TOP, Chain, MarkerLayout, measure_angle, synthetic_markers


def seen_by_cameras(
    motion: ForwardAndReturn,
    *,
    random: np.random.Generator,
    chain: Chain | None = None,
    camera_rate: float = 60.0,
    noise: float = 3e-4,
) -> Samples:
    """A synthetic measurement: markers of the motion, their angle, and what the signal chain makes of it.

    Zero is the mean angle of the rest after the motion. What a short arc to one side does not tell well
    enough, the plane of motion and the radius, is taken as known.

    Args:
        motion: the motion, with a rest of a few frames at least
        random: where the noise comes from
        chain: filter and differentiation, by the paper's settings if not given
        camera_rate: frames a second (Hz)
        noise: standard deviation of each coordinate of the markers (m)

    Raises:
        ParameterError: a value is not allowed
        RecordError, SeriesError: the motion is too short, or rests for less than two frames
    """
    frames = np.arange(math.floor(motion.duration * camera_rate) + 1) / camera_rate
    markers = synthetic_markers(frames, motion.at(frames).theta, random=random, noise=noise)
    rest = (motion.duration - motion.rest, motion.duration)
    angle = measure_angle(
        markers, top=TOP, base=BASE, forward="x", up="z", radius=MarkerLayout().height, rest=rest
    )
    return through_chain(angle.record("synthetic"), chain or Chain())
