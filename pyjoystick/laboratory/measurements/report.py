"""Short reports on what was imported, in Markdown."""

from __future__ import annotations

import math

import numpy as np

from pyjoystick.laboratory.measurements.accelerometer import AccelerometerRecord, AngularAcceleration
from pyjoystick.laboratory.measurements.angle import AngleMeasurement
from pyjoystick.laboratory.measurements.chain import Chain, Motion
from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.support import TextTable


def markers_report(markers: Markers, names: tuple[str, ...], measured: AngleMeasurement) -> str:
    """What the cameras saw and how the angle was found."""
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


def chain_report(chain: Chain, motion: Motion) -> str:
    """The settings of the chain, what they do, and what came out of it."""
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
    """The accelerometer beside the differentiated angle."""
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


def _residuals(markers: Markers, names: tuple[str, ...]) -> str:
    assert markers.residuals is not None
    texts = []
    for name in names:
        column = markers.residuals[:, markers.index(name)]
        known = column[np.isfinite(column)]
        texts.append(f"{name} {1e3 * math.sqrt(float(np.mean(known**2))):.2f}" if known.size else f"{name} -")
    return ", ".join(texts)
