"""Eq. (10): an estimate of the damping from each peak of a free oscillation."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pandas as pd

from pyjoystick.motion import DISPLACEMENT_PEAKS, VELOCITY_PEAKS, ReleasePeaks
from pyjoystick.support import FloatArray, positive

#: From when the time of velocity peaks counts.
VelocityClock = Literal["first peak", "release"]


def displacement_points(
    peaks: ReleasePeaks, inertia: float, *, count: int = DISPLACEMENT_PEAKS
) -> pd.DataFrame:
    """Eq. (10), C = -2 J / t * ln(|theta_peak| / |theta(0)|) with t from the release, for displacement peaks.

    Args:
        peaks: peaks of one release
        inertia: moment of inertia about the pivot, J (kg m2)
        count: number of peaks that are used, from the first on; fewer where there are fewer

    Returns:
        one row a peak: ``record``, ``number`` (from 1), ``time`` (s from the release), ``peak`` (rad, signed)
        and ``C`` (N m s/rad), which is not positive where a peak is no lower than the release

    Raises:
        ParameterError: the inertia is not above zero
    """
    table = peaks.displacement.iloc[:count]
    time = table["time"].to_numpy() - peaks.release_time
    return _points(peaks.name, time, table["value"].to_numpy(), abs(peaks.release_angle), inertia)


def velocity_points(
    peaks: ReleasePeaks,
    inertia: float,
    *,
    count: int = VELOCITY_PEAKS,
    clock: VelocityClock = "first peak",
) -> pd.DataFrame:
    """C_exp of the velocity peaks by the analog of eq. (10).

    The paper says only that "a similar approach" is used; the velocity is zero at the release, so something
    must stand for theta(0). Our reading: the first velocity peak does, and gives no point itself. Time
    counts from that peak (``first peak``), which makes the formula exact for a linear joystick, as eq. (9) is
    for the displacement. Counted from the release instead, as the letter of eq. (9) has it (``release``), the
    early points come out too low, and the line through them falls with an exponent near the paper's
    m = -0.26 whatever the true law; so the authors may well have done that.

    Args:
        peaks: peaks of one release
        inertia: moment of inertia about the pivot, J (kg m2)
        count: number of peaks that are used, the first one included
        clock: from when time counts

    Returns:
        as `displacement_points`, with ``peak`` in rad/s and ``time`` from where the clock starts

    Raises:
        ParameterError: the inertia is not above zero
    """
    table = peaks.velocity.iloc[:count]
    time, value = table["time"].to_numpy(), table["value"].to_numpy()
    start = peaks.release_time if clock == "release" else float(time[0])
    points = _points(peaks.name, time[1:] - start, value[1:], abs(float(value[0])), inertia)
    return points.assign(number=points["number"] + 1)


def _points(name: str, time: FloatArray, peak: FloatArray, start: float, inertia: float) -> pd.DataFrame:
    factor = -2.0 * positive("inertia", inertia, "kg.m2")
    return pd.DataFrame(
        {
            "record": name,
            "number": np.arange(1, len(time) + 1),
            "time": time,
            "peak": peak,
            "C": factor / time * np.log(np.abs(peak) / start),
        }
    )
