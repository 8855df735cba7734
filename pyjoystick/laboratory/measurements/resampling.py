"""Even resampling of camera samples by cubic splines; gaps are marked, and bridged only up to a limit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion import GAP
from pyjoystick.support import FloatArray, SeriesError, not_negative, positive

#: Minimum number of samples of a stretch for a spline.
FEWEST: Final = 4
#: This many samples are hours: a time, or its unit, is wrong.
_MOST: Final = 10_000_000
#: Even times up to this part of an interval after the last sample are still included.
_ROUNDING: Final = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Resampled:
    """A series at evenly spaced times.

    Attributes:
        time: times (s), shape (n,), evenly spaced from the first sample
        values: shape (n,); NaN in gaps that are not bridged
        bridged: whether a time is in a bridged gap, shape (n,)
        gaps: first and last time (s) of each gap that is not bridged, or that bounds a stretch too short
    """

    time: FloatArray
    values: FloatArray
    bridged: NDArray[np.bool_]
    gaps: tuple[tuple[float, float], ...]

    def stretches(self) -> Iterator[slice]:
        """The stretches without NaN."""
        known = np.isfinite(self.values)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], known, [False])).astype(np.int8)))
        for start, end in edges.reshape(-1, 2).tolist():
            yield slice(start, end)


def resample(time: FloatArray, values: FloatArray, rate: float, *, longest_gap: float) -> Resampled:
    """Interpolate samples at evenly spaced times, separately for each stretch between gaps.

    Args:
        time: times of the samples (s), shape (n,), increasing
        values: the samples, shape (n,), NaN where one is missing
        rate: new sampling rate (Hz)
        longest_gap: longest time (s) between two adjacent samples to bridge; the usual interval
            is not a gap

    Raises:
        ParameterError: the rate or the gap is outside its range
        SeriesError: no stretch has enough samples for a spline, or there would be more than ten million
            samples
    """
    # SciPy is slow to load, and not needed for the settings of a chain alone.
    from scipy.interpolate import CubicSpline

    interval = 1.0 / positive("rate", rate, "Hz")
    limit = not_negative("longest_gap", longest_gap, "s")
    known = np.isfinite(values)
    found = time[known]
    if len(found) < FEWEST:
        raise SeriesError("values", f"has {len(found)} samples, at least {FEWEST} are needed")
    if (found[-1] - found[0]) / interval > _MOST:
        span = f"from {found[0]:g} to {found[-1]:g} s"
        raise SeriesError("time", f"extends {span}, more than {_MOST} samples at {rate:g} Hz")
    usual = float(np.median(np.diff(time)))
    steps = np.diff(found)
    # Intervals equal to the limit up to rounding of the times are bridged.
    cuts = np.flatnonzero(steps > max(GAP * usual, limit * (1.0 + _ROUNDING)))
    even = found[0] + interval * np.arange(int((found[-1] - found[0]) / interval + _ROUNDING) + 1)
    result = np.full(len(even), np.nan)
    starts, ends = np.append(0, cuts + 1), np.append(cuts + 1, len(found))
    for start, end in zip(starts, ends, strict=True):
        if end - start >= FEWEST:
            slack = _ROUNDING * interval
            inside = (even >= found[start] - slack) & (even <= found[end - 1] + slack)
            result[inside] = CubicSpline(found[start:end], values[known][start:end])(even[inside])
    if not np.isfinite(result).any():
        reason = f"no stretch between gaps of more than {limit:g} s has {FEWEST} samples"
        raise SeriesError("values", reason)
    return Resampled(
        even, result, _in_gaps(even, found, steps, usual) & np.isfinite(result), _gaps(even, result)
    )


def _in_gaps(even: FloatArray, found: FloatArray, steps: FloatArray, usual: float) -> NDArray[np.bool_]:
    inside = np.zeros(len(even), dtype=bool)
    for i in np.flatnonzero(steps > GAP * usual):
        slack = _ROUNDING * usual
        inside |= (even > found[i] + slack) & (even < found[i + 1] - slack)
    return inside


def _gaps(even: FloatArray, values: FloatArray) -> tuple[tuple[float, float], ...]:
    missing = np.isnan(values)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], missing, [False])).astype(np.int8)))
    return tuple((float(even[start]), float(even[end - 1])) for start, end in edges.reshape(-1, 2).tolist())
