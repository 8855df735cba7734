"""Peaks of displacement and velocity from a noisy, coarsely sampled record, with standard errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.motion.peaks import find_peaks
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.records.record import Record
from pyjoystick.motion.records.swings import THRESHOLD, Swing, find_swings
from pyjoystick.motion.release_peaks import ReleasePeaks
from pyjoystick.motion.spline import MotionSpline, fit_spline
from pyjoystick.support import FloatArray, ParameterError, type_text

#: Minimum number of samples of a swing to determine its part of the spline.
FEWEST_SAMPLES_IN_SWING: Final = 2.0
#: A peak is significant while it is this many of its standard errors high.
SIGNIFICANT: Final = 2.5
#: The first peak of the velocity may be lower than the second by this many of their standard errors.
_LOWER: Final = 4.0
#: Largest ratio of successive swing durations; the period falls with the amplitude.
_LONGER: Final = 1.5
#: Swings are followed down to this many standard deviations of the noise
_ABOVE_NOISE: Final = 4.0
#: and, in a clean record, down to this part of the largest angle.
_SMALLEST: Final = 0.01
#: Number of points between two samples at which the spline is evaluated; `find_peaks` interpolates.
_FINENESS: Final = 40


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredPeaks(ReleasePeaks):
    """Peaks of one record, on its own clock, with standard errors.

    The tables of peaks have two more columns, ``time_error`` and ``value_error``: standard errors due to
    noise alone. The bias of the method is described in docs/damping-from-peaks.md.

    Attributes:
        release_time_error: standard error of the time of release (s)
        release_angle_error: standard error of the angle at the release (rad)
        noise: standard deviation of the samples about the fitted motion (rad)
    """

    release_time_error: float
    release_angle_error: float
    noise: float


def measured_peaks(record: Record) -> MeasuredPeaks:
    """Find release and peaks of a free oscillation, with interpolation and robust against noise.

    A spline with a corner at every zero crossing is fitted by least squares (`fit_spline`), and its
    peaks are found by `find_peaks`. Swings are followed until they are lost in the noise, have fewer than two
    samples, or their peaks are not significant. At 60 Hz and 0.1 degree of noise, peaks of the displacement
    have no visible bias; peaks of the velocity are 1 % too high at first and 6 % at the tenth,
    because the real corner is rounded within less than a sample. docs/damping-from-peaks.md has the table.

    Raises:
        ParameterError: the argument is not a record
        RecordError: the samples do not determine a motion with a release and two swings, the first peak of
            the displacement is on the side of the release, or the first of the velocity lower than the second
    """
    if not isinstance(record, Record):
        allowed = "a Record; of a run, find_peaks(run.index, run['theta'])"
        raise ParameterError("record", type_text(record), allowed)
    largest = float(np.max(np.abs(record.theta)))
    fitted = _fit(record, THRESHOLD * largest)
    finer = max(_ABOVE_NOISE * fitted.noise, _SMALLEST * largest)
    if finer < THRESHOLD * largest:
        fitted = _fit(record, finer)
    angle_error = math.sqrt(float(fitted.variance(np.array([fitted.release]))[0]))
    displacement, velocity = (_peaks(fitted, record.interval, derivative) for derivative in (0, 1))
    release_angle = float(fitted.spline(fitted.release))
    _require_other_side(record, release_angle, displacement)
    _require_release(record, velocity)
    return MeasuredPeaks(
        name=record.name,
        release_time=fitted.release,
        release_time_error=math.sqrt(fitted.release_variance),
        release_angle=release_angle,
        release_angle_error=angle_error,
        displacement=displacement,
        velocity=velocity,
        noise=fitted.noise,
    )


def _require_other_side(record: Record, release_angle: float, displacement: pd.DataFrame) -> None:
    """Refuse a first peak of the displacement on the side of the release: it is noise of the hold."""
    if displacement.empty or displacement["value"].iloc[0] * release_angle <= 0.0:
        return
    time, value = displacement[["time", "value"]].iloc[0]
    raise _no_release(
        record,
        f"displacement is on the side of the release, {math.degrees(release_angle):+.3g} degrees",
        "release from a larger angle, or measure with less noise",
        time,
        f"{math.degrees(value):+.3g} degrees",
    )


def _require_release(record: Record, velocity: pd.DataFrame) -> None:
    """Refuse a first peak of the velocity that is lower than the second: damping leaves no such motion."""
    first, second = velocity["value"].abs().to_numpy()[:2] if len(velocity) > 1 else (0.0, 0.0)
    allowed = _LOWER * float(np.linalg.norm(velocity["value_error"][:2]))
    if second - first <= allowed:
        return
    raise _no_release(
        record,
        f"velocity is lower than the second, {second:.3g} rad/s",
        "begin the record at rest before the release, and leave out what the hand does before",
        float(velocity["time"].iloc[0]),
        f"{first:.3g} rad/s",
    )


def _no_release(record: Record, what: str, advice: str, time: float, value: str) -> RecordError:
    """Make the error for a first peak, at a time (s), that shows that the release was not found."""
    reason = f"the release is not found: the first peak of the {what}"
    rows = [record.rows[int(np.argmin(np.abs(record.time - time)))]]
    return RecordError(
        record.source, reason, advice, column="theta", rows=rows, value=f"{value} at {time:.4g} s"
    )


def _fit(record: Record, threshold: float) -> MotionSpline:
    """The spline over as many swings as the samples determine."""
    passages = _passages(record, find_swings(record.theta, threshold))
    for count in range(len(passages), 1, -1):
        fitted = fit_spline(record.time, record.theta, passages[:count])
        if fitted is not None:
            return fitted
    raise RecordError(
        record.source,
        "the samples do not determine a release and the swings after it",
        "sample faster, and begin the record before the release",
        column="theta",
        rows=record.rows[[0, -1]],
    )


def _passages(record: Record, swings: list[Swing]) -> FloatArray:
    """Times (s) of the zero crossings after the release, by linear interpolation.

    They end before the first swing with too few samples, or so much longer than the previous one
    that it must contain swings too small to be seen.
    """
    passages: list[float] = []
    last = [swing.last for swing in swings if swing.last + 1 < len(record)]
    for swing_end in last:
        before, after = record.theta[swing_end : swing_end + 2]
        start, end = record.time[swing_end : swing_end + 2]
        passage = float(start + (end - start) * before / (before - after))
        if passages and passage - passages[-1] < FEWEST_SAMPLES_IN_SWING * record.interval:
            break
        if len(passages) > 1 and passage - passages[-1] > _LONGER * (passages[-1] - passages[-2]):
            break
        passages.append(passage)
    return np.array(passages)


def _peaks(fitted: MotionSpline, interval: float, derivative: int) -> pd.DataFrame:
    """Peaks of the angle or the velocity with standard errors, up to the first that is not significant."""
    edges = [fitted.release, *fitted.passages.tolist()]
    spans = [np.linspace(a, b, max(int(_FINENESS * (b - a) / interval), 8)) for a, b in pairwise(edges)]
    grid = np.unique(np.concatenate(spans))
    value = fitted.spline(grid, nu=derivative)
    slope = fitted.spline(grid, nu=derivative + 1)
    peaks = find_peaks(grid, value, slope, minimum_prominence=_SMALLEST * float(np.max(np.abs(value))))
    times = peaks["time"].to_numpy()
    peaks["value_error"] = np.sqrt(fitted.variance(times, derivative))
    peaks["time_error"] = _time_errors(fitted, times, derivative)
    significant = np.abs(peaks["value"]) > SIGNIFICANT * peaks["value_error"]
    count = len(peaks) if significant.all() else int(np.argmin(significant))
    return peaks.iloc[:count][["time", "value", "sign", "time_error", "value_error"]]


def _time_errors(fitted: MotionSpline, times: FloatArray, derivative: int) -> FloatArray:
    """Standard errors (s) of the times of peaks.

    A peak of the angle is where the velocity is zero; a peak of the velocity is at the corner in
    the zero crossing of the angle.
    """
    crossing = 1 - derivative
    slope = fitted.spline(times, nu=crossing + 1)
    return np.asarray(np.sqrt(fitted.variance(times, crossing)) / np.abs(slope))
