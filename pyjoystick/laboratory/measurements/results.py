"""Output of imported measurements: angles and motions as CSV files, and short reports in Markdown.

`pyjoystick.motion.read_record` reads these files.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Final

import numpy as np
from matplotlib.figure import Figure

from pyjoystick.laboratory.measurements.accelerometer import AccelerometerRecord, AngularAcceleration
from pyjoystick.laboratory.measurements.angle import AngleMeasurement
from pyjoystick.laboratory.measurements.chain import Chain, Motion
from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.motion import Log, Record
from pyjoystick.support import MEASURED, FloatArray, TextTable, dress, write_text

#: Labels and factors of quantities in tables and figures.
_SHOWN: Final = {
    "theta": ("Angle (deg)", math.degrees(1.0)),
    "omega": ("Velocity (rad/s)", 1.0),
    "T": ("Torque (N m)", 1.0),
    "F": ("Force (N)", 1.0),
}


def write_record(record: Record, path: Path, comments: Iterable[str]) -> None:
    """Write time and measured angle; raises OutputFileError.

    Args:
        record: the angle
        path: the file
        comments: lines before the headings
    """
    _write(path, {"time (s)": record.time, "theta (rad)": record.theta}, comments)


def write_log(log: Log, path: Path) -> None:
    """Write the samples of a laboratory's table as a record, in SI units; raises OutputFileError.

    A comment lists the table's column of each quantity.
    """
    read = ", ".join(
        f"{name} from {match.heading.text!r} in {match.unit}" for name, match in log.found.items()
    )
    units = {"time": "s", "theta": "rad", "omega": "rad/s", "T": "N.m", "F": "N"}
    columns = {f"{name} ({unit})": log.series[name] for name, unit in units.items() if name in log.series}
    _write(path, columns, [f"from {log.path.name}: {read}"])


def write_motion(motion: Motion, path: Path, comments: Iterable[str]) -> None:
    """Write the output of the chain, without gaps that are not bridged; raises OutputFileError.

    The column ``bridged`` is 1 inside bridged gaps.
    """
    known = np.isfinite(motion.theta)
    columns = {
        "time (s)": motion.time,
        "theta (rad)": motion.theta,
        "omega (rad/s)": motion.omega,
        "alpha (rad/s2)": motion.alpha,
        "bridged": motion.bridged.astype(np.float64),
    }
    _write(path, {name: values[known] for name, values in columns.items()}, comments)


def write_acceleration(found: AngularAcceleration, path: Path, comments: Iterable[str]) -> None:
    """Write the angular acceleration where the angle is known; raises OutputFileError."""
    known = np.isfinite(found.alpha)
    _write(path, {"time (s)": found.time[known], "alpha (rad/s2)": found.alpha[known]}, comments)


def _write(path: Path, columns: Mapping[str, FloatArray], comments: Iterable[str]) -> None:
    rows = zip(*(series.tolist() for series in columns.values()), strict=True)
    lines = [
        *(f"# {line}" for comment in comments for line in comment.splitlines()),
        ",".join(columns),
        # The first column is time; a clock that counts from 1970 has ten digits before the decimal point.
        *(",".join((repr(instant), *(f"{value:.12g}" for value in row))) for instant, *row in rows),
    ]
    write_text(path, "\n".join(lines) + "\n")


def markers_report(markers: Markers, names: tuple[str, ...], measured: AngleMeasurement) -> str:
    """Report on the markers, and on how the angle was found."""
    plane, arc = measured.plane, measured.arc
    lost = ", ".join(f"{name} {np.count_nonzero(markers.missing(name))}" for name in names)
    theta = np.degrees(measured.theta[np.isfinite(measured.theta)])
    direction = ", ".join(f"{value:+.3f}" for value in plane.along)
    rows = [
        ["frames", f"{len(markers.time)} at {markers.rate:.6g} Hz, {markers.time[-1]:.6g} s"],
        ["frames without", lost],
        *([["residual, rms (mm)", _residuals(markers, names)]] if markers.residuals is not None else []),
        ["main direction (x, y, z)", direction],
        ["out of the plane", f"{100.0 * plane.out_of_plane:.2f} %"],
        ["pivot to top, by the arc (mm)", f"{1e3 * arc.radius:.1f} +- {1e3 * arc.radius_error:.1f}"],
        ["noise across the arc (mm)", f"{1e3 * arc.noise:.3f}"],
        ["noise of the angle (deg)", f"{math.degrees(measured.noise):.3f}"],
        ["angle (deg)", f"{theta.min():+.2f} to {theta.max():+.2f}"],
    ]
    return TextTable(["", "markers"], rows).markdown()


def log_report(log: Log) -> str:
    """Report on how a laboratory's table was interpreted."""
    time = log.series["time"]
    rows = [
        ["file", log.form],
        ["headings in row", str(log.line) if log.line else "none"],
        *([name, f"{match.heading.text!r}, in {match.unit}"] for name, match in log.found.items()),
        ["samples", f"{len(time)}, {log.rate:.6g} Hz"],
        ["time (s)", f"{round(time[0], 6):.16g} to {round(time[-1], 6):.16g}"],
        *(
            [label, f"{factor * log.series[name].min():+.6g} to {factor * log.series[name].max():+.6g}"]
            for name, (label, factor) in _SHOWN.items()
            if name in log.series
        ),
        ["rows left out", str(len(log.left_out))],
    ]
    return TextTable(["", "record"], rows).markdown()


def plot_log(log: Log) -> Figure:
    """Plot a laboratory's table as interpreted, one panel per quantity."""
    shown = {name: label for name, label in _SHOWN.items() if name in log.series}
    figure = Figure(figsize=(7.0, 1.2 + 1.9 * len(shown)), layout="constrained")
    panels = figure.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    for panel, (name, (label, factor)) in zip(panels, shown.items(), strict=True):
        panel.plot(log.series["time"], factor * log.series[name], ".", color=MEASURED, markersize=2.0)
        match = log.found[name]
        panel.set(ylabel=label, title=f"column {match.heading.text!r}, read in {match.unit}")
        dress(panel, zero=True)
    panels[-1].set_xlabel("Time (s)")
    figure.suptitle(f"{log.path.name}: {log.form}", fontsize="medium")
    return figure


def chain_report(chain: Chain, motion: Motion) -> str:
    """Settings of the chain, their effect, and its output."""
    low_pass = chain.low_pass
    design, half = (value(chain.rate) for value in (low_pass.design_cutoff, low_pass.half_power_frequency))
    known = np.isfinite(motion.theta)
    gaps = ", ".join(f"{start:.4g} to {end:.4g} s" for start, end in motion.gaps) or "none"
    rows = [
        ["samples", f"{np.count_nonzero(known)} at {chain.rate:g} Hz"],
        ["in bridged gaps", f"{np.count_nonzero(motion.bridged)}"],
        ["gaps that stay", gaps],
        ["filter", f"Butterworth {low_pass.order}, {design:.4g} Hz, forward and reverse"],
        ["-3 dB of both runs (Hz)", f"{half:.4g}"],
        ["largest velocity (rad/s)", f"{np.max(np.abs(motion.omega[known])):.3f}"],
        ["largest acceleration (rad/s2)", f"{np.max(np.abs(motion.alpha[known])):.1f}"],
    ]
    return TextTable(["", "motion"], rows).markdown()


def acceleration_report(record: AccelerometerRecord, found: AngularAcceleration) -> str:
    """Comparison of the accelerometer with the differentiated angle."""
    rms, peaks = found.differences, found.peaks
    whole = rms["differentiated"]
    rows = [
        ["samples", f"{record.samples} at {record.rate:.6g} Hz"],
        ["range (m/s2)", f"{record.smallest:+.2f} to {record.largest:+.2f}"],
        ["reading at rest (m/s2)", f"{found.zero:+.3f}"],
        ["gravity in parts of the peak", f"{100.0 * found.gravity_share:.1f} %"],
        ["peak, accelerometer less gravity (rad/s2)", f"{peaks['less gravity']:.1f}"],
        ["peak, differentiated angle (rad/s2)", f"{peaks['differentiated']:.1f}"],
        ["difference, gravity left in", f"{100.0 * rms['with gravity'] / whole:.1f} % rms"],
        ["difference, less gravity", f"{100.0 * rms['less gravity'] / whole:.1f} % rms"],
        ["correlation", f"{found.correlation:+.4f}"],
        ["add to the delay (s)", f"{found.lag:+.4f}"],
    ]
    return TextTable(["", "accelerometer"], rows).markdown()


def residual(markers: Markers, name: str) -> float:
    """Root mean square of a marker's residuals (m); NaN if the file has none."""
    if markers.residuals is None:
        return math.nan
    column = markers.residuals[:, markers.index(name)]
    known = column[np.isfinite(column)]
    return math.sqrt(float(np.mean(known**2))) if known.size else math.nan


def _residuals(markers: Markers, names: tuple[str, ...]) -> str:
    found = {name: residual(markers, name) for name in names}
    return ", ".join(
        f"{name} -" if math.isnan(one) else f"{name} {1e3 * one:.2f}" for name, one in found.items()
    )
