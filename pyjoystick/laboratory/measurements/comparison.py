"""Comparison of an accelerometer's file with the recorded angle of the same motion."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final

from pyjoystick.laboratory.measurements.accelerometer import (
    LARGEST_LAG,
    AccelerometerRecord,
    AngularAcceleration,
    angular_acceleration,
    read_accelerometer,
)
from pyjoystick.laboratory.measurements.angle_notes import REST_TIME
from pyjoystick.laboratory.measurements.results import acceleration_report, write_acceleration
from pyjoystick.laboratory.measurements.setups import AccelerometerSetup
from pyjoystick.motion import Record

#: Smallest correlation of an accelerometer with the angle's acceleration, if both are of one motion.
_LEAST_CORRELATION: Final = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class AccelerometerComparison:
    """Comparison of an accelerometer with the differentiated angle.

    Attributes:
        setup: how the file was read
        record: its samples
        found: the angular acceleration, and its agreement
        notes: doubts, one sentence each
    """

    setup: AccelerometerSetup
    record: AccelerometerRecord
    found: AngularAcceleration
    notes: tuple[str, ...]

    def write(self, path: Path) -> None:
        """Write the angular acceleration as CSV; raises OutputFileError."""
        name, distance = Path(self.record.source).name, self.setup.distance
        comment = f"angular acceleration from {name}, less gravity, over {distance:g} m"
        write_acceleration(self.found, path, [comment])

    def report(self) -> str:
        """The comparison as a table in Markdown."""
        return acceleration_report(self.record, self.found)


def compare_accelerometer(path: Path, angle: Record, setup: AccelerometerSetup) -> AccelerometerComparison:
    """Compare an accelerometer with the differentiated angle (section 2 of the paper).

    Only the part of the file that the angle covers is kept in memory.

    Args:
        path: CSV with headings, or .npy
        angle: the unfiltered angle
        setup: position of the accelerometer, and how to read its file

    Raises:
        RecordError, SeriesError, ParameterError: a file or a setting cannot be used
    """
    chain = setup.chain
    motion = chain.run(angle.time, angle.theta)
    start, end = float(motion.time[0]), float(motion.time[-1])
    record = read_accelerometer(
        path,
        window=(start, end),
        column=setup.column,
        unit=setup.unit,
        rate=setup.rate,
        sensitivity=setup.sensitivity,
        full_scale=setup.full_scale,
        delay=setup.delay,
    )
    found = angular_acceleration(
        record,
        motion,
        distance=setup.distance,
        rest=setup.rest or (end - REST_TIME, end),
        low_pass=chain.low_pass,
        backward=setup.backward,
    )
    notes = list(record.notes)
    if abs(found.lag) > 0.99 * LARGEST_LAG:
        notes.append(f"the clocks may differ by more than {LARGEST_LAG:g} s: give --delay")
    if abs(found.correlation_at_lag) < _LEAST_CORRELATION:
        notes.append(
            f"does not resemble the angle's acceleration at any delay up to {LARGEST_LAG:g} s (correlation "
            f"{found.correlation_at_lag:.2f}): is it of the same motion? If so, give --delay"
        )
    elif found.correlation_at_lag < 0.0:
        notes.append("opposes the angle: if its positive direction is backward, add --backward")
    return AccelerometerComparison(setup, record, found, tuple(notes))
