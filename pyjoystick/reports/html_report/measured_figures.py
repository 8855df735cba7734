"""Figures of measurements: records with prediction bands, residuals, a swing test."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from matplotlib.figure import Figure

from pyjoystick.identification import FitDocument, FittedSeries
from pyjoystick.motion import Record
from pyjoystick.support import BAND, FITTED, MEASURED, FloatArray, dress, legend_above

#: Characters that fit into a legend with several columns.
_LEGEND_WIDTH: Final = 84
#: Angles are plotted in degrees.
_SHOWN: Final = {
    "theta": (math.degrees(1.0), "Angle (deg)"),
    "omega": (math.degrees(1.0), "Velocity (deg/s)"),
}


def band(one: FittedSeries, quantile: float) -> FloatArray:
    """Half-width of the prediction band of samples, from noise and uncertainty of the motion, shape (n,)."""
    errors = np.zeros_like(one.data) if one.errors is None else one.errors
    return np.asarray(quantile * np.hypot(one.sigma, errors))


def plot_record(one: FittedSeries, fit: FitDocument) -> Figure:
    """Plot a record as dots, the fitted motion as a line and, below, the residuals within their band."""
    figure = Figure(figsize=(7.0, 3.4), layout="constrained")
    motion, rest = figure.subplots(2, 1, sharex=True, height_ratios=[2, 1])
    factor, name = _SHOWN.get(one.label, (1.0, one.label))
    half = factor * band(one, fit.quantile)
    dots: Any = {"color": MEASURED, "markersize": 2.5, "linewidth": 0.0, "marker": "."}
    motion.plot(one.times, factor * one.data, label="measured", **dots)
    motion.plot(one.curve[0], factor * one.curve[1], color=FITTED, linewidth=1.0, label="model")
    held = f"{100.0 * fit.level:g} % of the samples"
    rest.fill_between(one.times, -half, half, color=BAND, alpha=0.25, linewidth=0.0, label=held)
    rest.plot(one.times, factor * one.residuals, **dots)
    motion.set_ylabel(name)
    rest.set_ylabel("Less model")
    rest.set_xlabel("Time on the clock of the record (s)")
    for axes in (motion, rest):
        dress(axes, zero=True)
    figure.align_ylabels([motion, rest])
    legend_above(figure, [motion, rest], marker_scale=3.0)
    return figure


def plot_residual_distribution(fit: FitDocument) -> Figure:
    """Plot residuals in standard deviations of the noise, over the fitted number and as a histogram."""
    figure = Figure(figsize=(7.0, 3.2), layout="constrained")
    over, histogram = figure.subplots(1, 2, sharey=True, width_ratios=[2.0, 1.0])
    scaled = np.concatenate([one.residuals / one.sigma for one in fit.series])
    factor, name = _SHOWN.get(fit.series[0].label, (1.0, fit.series[0].label))
    for marker, one in zip("os^Dv<>p*h" * len(fit.series), fit.series, strict=False):
        style: Any = {"markersize": 3.0, "fillstyle": "none", "linestyle": "none", "marker": marker}
        over.plot(factor * one.fit, one.residuals / one.sigma, label=one.record, **style)
    over.set_xlabel(f"{name}, model")
    over.set_ylabel("Measured less model\n(standard deviations of the noise)")
    histogram.hist(scaled, bins=31, orientation="horizontal", density=True, color="0.75")
    levels = np.linspace(-4.0, 4.0, 201)
    normal = np.exp(-0.5 * levels**2) / math.sqrt(2.0 * math.pi)
    histogram.plot(normal, levels, color=FITTED, linewidth=1.2, label="normal distribution")
    histogram.set_xlabel("Density")
    for axes in (over, histogram):
        dress(axes, zero=True)
    longest = max(len(one.record) for one in fit.series)
    legend_above(figure, [over, histogram], columns=max(1, min(4, _LEGEND_WIDTH // (longest + 8))))
    return figure


def plot_swing(record: Record) -> Figure:
    """Plot a swing test as recorded."""
    figure = Figure(figsize=(7.0, 2.8), layout="constrained")
    axes = figure.subplots()
    axes.plot(record.time, np.degrees(record.theta), ".", color=MEASURED, markersize=2.5)
    axes.set_xlabel("Time (s)")
    axes.set_ylabel("Angle (deg)")
    dress(axes, zero=True)
    return figure
