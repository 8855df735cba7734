"""A record: the measured motion of one release, in SI units."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyjoystick.motion.records.derivatives import require_derivative
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.support import FloatArray, real_numbers

#: Minimum number of samples of a record.
FEWEST_SAMPLES = 3
#: Range of the sampling interval (s): a joystick swings a few times per second, and no instrument is faster.
_INTERVALS: Final = (1e-7, 1.0)
#: A step longer than this many usual ones is a gap.
GAP: Final = 1.5
#: Largest rms difference of theta (rad) or omega (rad/s) from the integral of its rate that is only noise.
_SMALLEST: Final = {"theta": 0.01, "omega": 0.2}
#: A gap shorter than this part of an adjacent swing cannot hide a swing, even a slightly shorter one.
HIDING: Final = 0.75
#: Samples closer than this (s) have the same time.
_SAME_INSTANT: Final = 1e-12
#: No instrument resolves an angle as small as this (rad).
_LEAST_ANGLE: Final = 1e-9
#: What to do about samples without a number.
MISSING_ADVICE: Final = (
    "a lost marker? Leave these rows out; what is missing then counts as a gap, which is allowed where "
    "no peak can hide in it"
)


def require_sampling(source: str, time: FloatArray, rows: Sequence[int] | NDArray[np.int64]) -> None:
    """Raise RecordError if increasing times (s), shape (n,), n > 1, are likely in another unit."""
    shortest, longest = _INTERVALS
    interval = float(np.median(np.diff(time)))
    if not shortest <= interval < longest:
        raise RecordError(
            source,
            "the usual time between two samples is implausible for a measured motion",
            f"it must be from {shortest:g} s to less than {longest:g} s: are these ms or us labeled as s? "
            "Put the unit in the heading, as in 'time (ms)', or use `pyjoystick import record` with "
            "--unit time=ms",
            column="time",
            rows=rows[:2],
            value=f"{interval:.6g} s",
        )


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """One measured motion, in read-only copies of the arrays.

    Nothing is repaired: samples and times are as recorded, with the clock's own zero.

    Attributes:
        name: name of the record in tables and figures
        time: times (s), shape (n,), n >= 3, increasing; gaps are allowed here
        theta: angle (rad), shape (n,), positive forward, |theta| < pi/2
        omega: angular velocity (rad/s) if it was measured, shape (n,), else None
        source: source of the record: the path of the file, or a note on its origin
        notes: doubts that are not errors, one sentence each
        rows: row of each sample in its source, shape (n,): line numbers of a file; by default indices
            from 0

    Raises:
        RecordError: an array is not one-dimensional, not of the length of `time`, too short, or contains NaN
            or infinity; the time does not increase; an angle is pi/2 or more (degrees taken for radians?); no
            angle is large enough for an instrument to resolve, unless all are zero; omega is not the
            derivative of theta
    """

    name: str
    time: FloatArray
    theta: FloatArray
    omega: FloatArray | None = None
    source: str = "arrays"
    notes: tuple[str, ...] = ()
    rows: NDArray[np.int64] = dataclasses.field(default_factory=lambda: np.empty(0, dtype=np.int64))

    def __post_init__(self) -> None:
        time = self._checked("time", self.time)
        rows = np.array(self.rows if len(self.rows) else np.arange(len(time)), dtype=np.int64)
        rows.setflags(write=False)
        object.__setattr__(self, "rows", rows)
        if len(time) < FEWEST_SAMPLES or len(rows) != len(time):
            reason = f"has {len(time)} samples in {len(rows)} rows; at least {FEWEST_SAMPLES} are needed"
            raise RecordError(self.source, reason, "record the whole motion, one sample per row")
        for name in ("time", "theta", "omega"):
            if getattr(self, name) is not None:
                series = self._checked(name, getattr(self, name))
                self._require_samples(name, series)
                object.__setattr__(self, name, series)
        self._require_increasing_time()
        require_sampling(self.source, self.time, self.rows)
        self._require_angles()
        if self.omega is not None:
            self.require_rate("omega", self.omega)

    def __len__(self) -> int:
        return len(self.time)

    @property
    def interval(self) -> float:
        """Sampling interval (s): the median, which ignores gaps."""
        return float(np.median(np.diff(self.time)))

    def require_rate(self, name: str, series: FloatArray, *, moves: bool = False) -> None:
        """Raise RecordError if omega is not the derivative of theta, or alpha not that of omega.

        Args:
            name: ``omega`` or ``alpha``
            series: the rate, shape (n,) (rad/s or rad/s2)
            moves: the motion is known to stand out from noise, however small it is
        """
        of = "theta" if name == "omega" else "omega"
        require_derivative(
            self.source,
            self.time,
            (of, getattr(self, of)),
            (name, series),
            smallest=0.0 if moves else _SMALLEST[of],
            longest_step=GAP * self.interval,
            rows=self.rows,
        )

    def with_notes(self, *notes: str) -> Record:
        """Return the record with additional notes."""
        return dataclasses.replace(self, notes=(*self.notes, *notes))

    def between(self, start: float, end: float = math.inf) -> Record:
        """Return the samples with start <= time <= end (s).

        Raises:
            RecordError: fewer than three are left
        """
        inside = (self.time >= start) & (self.time <= end)
        omega = None if self.omega is None else self.omega[inside]
        return dataclasses.replace(
            self, time=self.time[inside], theta=self.theta[inside], omega=omega, rows=self.rows[inside]
        )

    def _checked(self, name: str, values: ArrayLike) -> FloatArray:
        try:
            series = real_numbers(values)
        except (TypeError, ValueError):
            raise RecordError(
                self.source, "is not an array of numbers", "give numbers", column=name
            ) from None
        if series.ndim != 1:
            reason = f"has the shape {series.shape}, must have one dimension"
            raise RecordError(self.source, reason, "give one number per sample", column=name)
        series.setflags(write=False)
        return series

    def _require_samples(self, name: str, series: FloatArray) -> None:
        if len(series) != len(self.rows):
            reason = f"has {len(series)} samples, time has {len(self.rows)}"
            raise RecordError(self.source, reason, "give one number per sample", column=name)
        bad = np.flatnonzero(~np.isfinite(series))
        if bad.size:
            raise RecordError(
                self.source,
                "samples without a finite number",
                MISSING_ADVICE,
                column=name,
                rows=self.rows[bad],
                value=series[bad[0]],
            )

    def _require_increasing_time(self) -> None:
        steps = np.diff(self.time)
        repeated = np.flatnonzero(np.abs(steps) < _SAME_INSTANT)
        if repeated.size:
            raise RecordError(
                self.source,
                "times are repeated",
                "it is unknown which of the samples is right: if the times are rounded, "
                "export them with more digits; otherwise delete the duplicate rows",
                column="time",
                rows=self.rows[repeated + 1],
                value=self.time[repeated[0] + 1],
            )
        backward = np.flatnonzero(steps < 0.0)
        if backward.size:
            raise RecordError(
                self.source,
                "time runs backward",
                "the rows are out of order, the file holds more than one record, or a clock without a date "
                "has passed midnight: export them in order, one record a file, with dates",
                column="time",
                rows=self.rows[backward + 1],
                value=self.time[backward[0] + 1],
            )

    def _require_angles(self) -> None:
        beyond = np.flatnonzero(np.abs(self.theta) >= math.pi / 2.0)
        if beyond.size:
            raise RecordError(
                self.source,
                "an angle of 90 degrees or more, where the geometry of the joystick ends",
                _advice_beyond(self.theta[beyond]),
                column="theta",
                rows=self.rows[beyond],
                value=f"{self.theta[beyond[0]]:g} rad",
            )
        largest = int(np.argmax(np.abs(self.theta)))
        if 0.0 < abs(self.theta[largest]) < _LEAST_ANGLE:
            raise RecordError(
                self.source,
                f"all angles are below {_LEAST_ANGLE:g} rad, which no instrument resolves",
                "is the unit of theta right?",
                column="theta",
                rows=self.rows[largest : largest + 1],
                value=f"{self.theta[largest]:g} rad",
            )


def _advice_beyond(theta: FloatArray) -> str:
    """Advice about angles (rad) of a quarter turn and more."""
    if len(theta) > 1 and np.ptp(theta) == 0.0:
        same = f"all are the same, {math.degrees(theta[0]):g} degrees"
        return f"{same}: does the instrument write this where it has no angle? Leave these rows out"
    if float(np.max(np.abs(theta))) <= 2.0 * math.pi:
        return (
            "is this in degrees (name the column theta (deg)), does it wrap around at a full turn, or is "
            "zero not the middle position?"
        )
    return "are these degrees labeled as radians? Name the column theta (deg)"
