"""A motion recorded by cameras, from the markers to the angle and through the signal chain."""

from __future__ import annotations

import math
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from pyjoystick.laboratory.measurements.angle import AngleMeasurement, measure_angle, rest_angle
from pyjoystick.laboratory.measurements.chain import Motion
from pyjoystick.laboratory.measurements.marker_files import read_markers
from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.laboratory.measurements.results import (
    chain_report,
    markers_report,
    write_motion,
    write_record,
)
from pyjoystick.laboratory.measurements.setups import MarkerSetup
from pyjoystick.model import JoystickParameters
from pyjoystick.motion import Record, check_free_oscillation
from pyjoystick.support import ParameterError


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """One recorded motion.

    Attributes:
        setup: settings for finding the angle
        markers: the recorded markers
        measured: the angle in each frame, and how it was found
        record: the angle as measured, neither filtered nor interpolated
        motion: the angle, its velocity and acceleration after the signal chain
    """

    setup: MarkerSetup
    markers: Markers
    measured: AngleMeasurement
    record: Record
    motion: Motion

    def write(self, record_file: Path, motion_file: Path | None = None) -> None:
        """Write the record and the filtered motion as CSV; raises OutputFileError."""
        setup, low_pass = self.setup, self.setup.chain.low_pass
        origin = (
            f"angle from {Path(self.measured.source).name}: top {setup.top}, "
            f"base {setup.base[0]} and {setup.base[1]}, forward {setup.forward}"
        )
        write_record(self.record, record_file, [origin])
        if motion_file is not None:
            how = (
                f"filtered at {low_pass.cutoff:g} Hz, order {low_pass.order}, forward and reverse, "
                f"{setup.chain.rate:g} Hz"
            )
            write_motion(self.motion, motion_file, [origin, how])

    def report(self) -> str:
        """Report on the markers, how the angle was found, and the output of the signal chain."""
        names = (self.setup.top, *self.setup.base)
        parts = (
            markers_report(self.markers, names, self.measured),
            chain_report(self.setup.chain, self.motion),
        )
        return "\n\n".join(parts)


def read_trial(
    path: str | PathLike[str], setup: MarkerSetup, *, name: str, joystick: JoystickParameters | None = None
) -> Trial:
    """Find the angle of a joystick from a file of markers.

    Args:
        path: C3D, Nexus CSV or plain CSV
        setup: settings for finding the angle
        name: name of the record
        joystick: its springs and geometry are needed for `MarkerSetup.rests`

    Raises:
        ParameterError: ``rests`` without a joystick
        InputFileError, RecordError, SeriesError: the file cannot be used; the message explains why
    """
    at_rest = 0.0
    if setup.rests is not None:
        if joystick is None:
            raise ParameterError("rests", setup.rests, "left out without a joystick")
        at_rest = rest_angle(joystick, setup.rests)
    markers = read_markers(Path(path), unit=setup.unit)
    measured = measure_angle(
        markers,
        top=setup.top,
        base=setup.base,
        forward=setup.forward,
        up=setup.up,
        origin="middle" if setup.middle else "arc",
        radius=setup.radius,
        base_motion="moving" if setup.moving_base else "still",
        rest=setup.rest,
        rest_angle=at_rest,
    )
    record = measured.record(name)
    if setup.released is not None:
        # A gap in which a peak may hide is no fault of a record that is fitted; `peaks` refuses it.
        # An angle computed from several rounded coordinates has finer steps than its resolution.
        resolution = markers.resolution(setup.top) / math.hypot(*measured.rest_radius)
        record = check_free_oscillation(record, released=setup.released, counted=False, resolution=resolution)
    return Trial(setup, markers, measured, record, setup.chain.run(measured.time, measured.theta))
