"""The accelerometer of section 2: angular acceleration from tangential acceleration, corrected for gravity.

An accelerometer on the joystick at a distance L from the pivot, with its axis along the direction of motion,
reads

    a = L alpha - g sin(theta)

because it senses the force that supports it against gravity, and at a forward angle theta its axis points
downward by theta. Hence alpha = (a + g sin(theta))/L with the measured angle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.laboratory.measurements.chain import Motion
from pyjoystick.laboratory.measurements.low_pass import LowPass
from pyjoystick.laboratory.measurements.sample_files import PIECE, SampleFile, open_samples
from pyjoystick.laboratory.measurements.saturation import SaturationWatch
from pyjoystick.motion import GRAVITY, UNITS, Column, RecordError, lone_notes, require_sampling, rows_in_words
from pyjoystick.support import FloatArray, positive

_COLUMN: Final = Column("acceleration", {**UNITS["acceleration"], **UNITS["voltage"]})
#: Sampling is uneven if a time step differs by more than this from the usual one.
_UNEVEN: Final = 0.02
#: An angle that changes by less than this (rad) only does so by rounding.
_STILL: Final = 1e-9
#: Range (s), to either side, and step of the comparison of clocks.
LARGEST_LAG: Final = 0.5
_LAG_STEP: Final = 5e-4


@dataclass(frozen=True, slots=True, eq=False)
class AccelerometerRecord:
    """Samples of an accelerometer within a window, and properties of the whole file.

    Attributes:
        source: the file
        time: times (s), shape (n,), on the clock of the window
        acceleration: readings (m/s2), shape (n,)
        rows: rows in the file, shape (n,)
        samples: number of samples in the whole file
        rate: sampling rate (Hz)
        smallest, largest: extremes of the whole file (m/s2)
        notes: doubts, one sentence each
    """

    source: str
    time: FloatArray
    acceleration: FloatArray
    rows: NDArray[np.int64]
    samples: int
    rate: float
    smallest: float
    largest: float
    notes: tuple[str, ...]


def read_accelerometer(
    path: Path,
    *,
    window: tuple[float, float] = (-math.inf, math.inf),
    column: str | None = None,
    unit: str | None = None,
    rate: float | None = None,
    sensitivity: float | None = None,
    full_scale: float | None = None,
    delay: float = 0.0,
    piece: int = PIECE,
) -> AccelerometerRecord:
    """Read the samples of an accelerometer; only those inside the window are kept.

    Args:
        path: a CSV file with headings, ``time (s),acceleration (m/s2)``, or an .npy file
        window: first and last time (s) to keep, on the clock of the other measurement
        column: heading of the column in a CSV file; by default ``acceleration``
        unit: unit of the samples if the heading has none: an acceleration or a voltage of `UNITS`
        rate: sampling rate (Hz), for files without times
        sensitivity: volts per m/s2, for voltages
        full_scale: largest reading of the amplifier, in the unit of the file
        delay: time on the accelerometer's clock (s) at time zero of the other clock
        piece: number of samples in memory at a time

    Raises:
        RecordError: the file cannot be used, see `open_samples`; the unit is unknown; the signal never
            changes; the samples are not even; or none are in the window
    """
    file = open_samples(path, _COLUMN, heading=column or "", unit=unit or "", rate=rate)
    factor = _factor(file, sensitivity)
    watch = SaturationWatch(full_scale)
    kept: list[tuple[FloatArray, FloatArray, NDArray[np.int64]]] = []
    samples, smallest, largest = 0, math.inf, -math.inf
    for part in file.pieces(piece):
        watch.add(part.values, part.first)
        smallest, largest = min(smallest, float(part.values.min())), max(largest, float(part.values.max()))
        time = part.time - delay
        inside = (time >= window[0]) & (time <= window[1])
        if inside.any():
            rows = part.first + np.flatnonzero(inside)
            kept.append((time[inside], part.values[inside] * factor, rows))
        samples += len(part.values)
    if samples and smallest == largest:
        advice = "is the charge amplifier on, and this its channel?"
        raise RecordError(str(path), "never changes", advice, column=file.column, value=f"{largest:g}")
    if not kept:
        reason = f"has no samples from {window[0]:g} to {window[1]:g} s, where the angle is known"
        raise RecordError(
            str(path), reason, "do both clocks start at the same instant? If not, give the delay"
        )
    time, acceleration, rows = (np.concatenate(series) for series in zip(*kept, strict=True))
    return AccelerometerRecord(
        source=str(path),
        time=time,
        acceleration=acceleration,
        rows=rows,
        samples=samples,
        rate=_even_rate(str(path), time, rows),
        smallest=smallest * factor,
        largest=largest * factor,
        notes=(*_saturation_notes(file.column, watch), *lone_notes(repr(file.column), acceleration, rows)),
    )


def _factor(file: SampleFile, sensitivity: float | None) -> float:
    """Factor from the unit of the file to m/s2."""
    if file.unit in UNITS["acceleration"]:
        if sensitivity is not None:
            reason, advice = (
                f"is in {file.unit}, not in volts",
                "leave the sensitivity out, or correct the unit",
            )
            raise RecordError(str(file.path), reason, advice, column=file.column)
        return UNITS["acceleration"][file.unit]
    if sensitivity is None:
        advice = "give the sensitivity of accelerometer and amplifier in V/(m/s2)"
        raise RecordError(str(file.path), "is a voltage", advice, column=file.column, value=file.unit)
    return UNITS["voltage"][file.unit] / positive("sensitivity", sensitivity, "V/(m/s2)")


def _even_rate(source: str, time: FloatArray, rows: NDArray[np.int64]) -> float:
    if len(time) < 3:
        raise RecordError(source, f"has {len(time)} samples in the window", "give a longer record")
    steps = np.diff(time)
    for i in np.flatnonzero(steps <= 0.0)[:1]:
        reason = "the time does not increase from the sample before"
        raise RecordError(source, reason, "export the samples in order", column="time", rows=[rows[i + 1]])
    require_sampling(source, time, rows)
    usual = float(np.median(steps))
    uneven = np.flatnonzero(np.abs(steps / usual - 1.0) > _UNEVEN)
    if uneven.size:
        raise RecordError(
            source,
            f"the time step differs from the usual {usual:.6g} s",
            "an accelerometer samples at equal intervals: were samples lost, or are the times rounded?",
            column="time",
            rows=[rows[uneven[0] + 1]],
            value=f"{steps[uneven[0]]:.6g} s",
        )
    return (len(time) - 1) / float(time[-1] - time[0])  # the median step is off if times are rounded


def _saturation_notes(column: str, watch: SaturationWatch) -> tuple[str, ...]:
    runs = watch.found()
    if not runs:
        return ()
    rows = [row for first, last in runs[:100] for row in range(first, min(last, first + 1000) + 1)]
    count = sum(last - first + 1 for first, last in runs)
    return (
        f"column {column!r}, {rows_in_words(rows)}: saturated, {count} samples in {len(runs)} stretches stay "
        "at an extreme value: lower the amplifier's gain; peaks and mean are too small there",
    )


@dataclass(frozen=True, slots=True, eq=False)
class AngularAcceleration:
    """The angular acceleration from an accelerometer, and the differentiated angle.

    Arrays have the shape (n,) of the accelerometer's samples or (k,) of the motion's samples.

    Attributes:
        time: times of the samples (s), shape (n,)
        alpha: corrected for gravity, unfiltered (rad/s2), shape (n,); NaN where the angle is not known
        zero: offset subtracted from the readings so that there is no acceleration at rest (m/s2)
        gravity_share: largest component of gravity relative to the largest |L alpha| after the filter
        filtered: `alpha` after the low-pass filter of the motion, at its times, shape (k,)
        differences: rms difference (rad/s2) from the differentiated angle, ``with gravity`` left in and
            ``less gravity``, and the rms of the latter itself, ``differentiated``
        peaks: largest magnitudes (rad/s2) of the same
        lag: correction of the clock for the smallest difference (s), to be added to the delay
        correlation: correlation of `filtered` with the differentiated angle
        correlation_at_lag: the same, less gravity, once the clock is corrected by `lag`
    """

    time: FloatArray
    alpha: FloatArray
    zero: float
    gravity_share: float
    filtered: FloatArray
    differences: dict[str, float]
    peaks: dict[str, float]
    lag: float
    correlation: float
    correlation_at_lag: float


def angular_acceleration(
    record: AccelerometerRecord,
    motion: Motion,
    *,
    distance: float,
    rest: tuple[float, float],
    low_pass: LowPass | None = None,
    gravity: float = GRAVITY,
    backward: bool = False,
) -> AngularAcceleration:
    """Compute the angular acceleration from an accelerometer and the measured angle.

    Args:
        record: the accelerometer's samples, on the clock of the motion
        motion: the measured angle, after the chain
        distance: from the pivot to the accelerometer (m)
        rest: first and last time (s) of an interval at rest in the middle, which sets the zero
        low_pass: filter of the chain that produced the motion
        gravity: g (m/s2)
        backward: whether the accelerometer's positive direction is backward

    Raises:
        ParameterError: the distance is not above zero
        RecordError: there are no samples at rest, or too few where the angle is known, or it never changes
    """
    length = positive("distance", distance, "m")
    sign = -1.0 if backward else 1.0
    weight = gravity * np.sin(np.interp(record.time, motion.time, motion.theta, left=np.nan, right=np.nan))
    still = (record.time >= rest[0]) & (record.time <= rest[1]) & np.isfinite(weight)
    if not still.any():
        reason = f"has no samples with a known angle from {rest[0]:g} to {rest[1]:g} s, called at rest"
        raise RecordError(record.source, reason, "name a stretch at rest inside the record")
    reading = sign * record.acceleration
    zero = float((reading + weight)[still].mean())
    reading = reading - zero
    smooth = (low_pass or LowPass()).filter(reading, record.rate)
    known = np.isfinite(motion.alpha) & (motion.time >= record.time[0]) & (motion.time <= record.time[-1])
    if np.count_nonzero(known) < 3:
        raise RecordError(record.source, "has too few samples where the angle is known", "check both clocks")
    time, alpha = motion.time[known], motion.alpha[known]
    if np.ptp(motion.theta[known]) < _STILL:
        reason = "cannot be compared with an angle that never changes"
        raise RecordError(record.source, reason, "give the record of the same motion")
    level = gravity * np.sin(motion.theta[known])
    raw = np.interp(time, record.time, smooth) / length
    filtered = np.full(len(motion.time), np.nan)
    filtered[known] = raw + level / length
    found = {"with gravity": raw, "less gravity": filtered[known]}
    lag, agreement = _lag(record.time, smooth / length, time, alpha - level / length)
    return AngularAcceleration(
        time=record.time,
        alpha=(reading + weight) / length,
        zero=zero,
        gravity_share=float(np.max(np.abs(level)) / (length * np.max(np.abs(filtered[known])))),
        filtered=filtered,
        differences={name: _rms(series - alpha) for name, series in found.items()}
        | {"differentiated": _rms(alpha)},
        peaks={
            name: float(np.max(np.abs(series)))
            for name, series in (found | {"differentiated": alpha}).items()
        },
        lag=lag,
        correlation=float(np.corrcoef(filtered[known], alpha)[0, 1]),
        correlation_at_lag=agreement,
    )


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _lag(clock: FloatArray, series: FloatArray, time: FloatArray, wanted: FloatArray) -> tuple[float, float]:
    """Delay of a series relative to another, by the largest correlation of either sign, and the latter."""
    lags = np.arange(-LARGEST_LAG, LARGEST_LAG + _LAG_STEP / 2.0, _LAG_STEP)
    alike = np.array([np.corrcoef(np.interp(time + lag, clock, series), wanted)[0, 1] for lag in lags])
    best = int(np.nanargmax(np.abs(alike)))
    return float(lags[best]), float(alike[best])
