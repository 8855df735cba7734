"""Figures of a fit: records and fitted motions, residuals, profiles, correlations."""

from __future__ import annotations

import math
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np
from matplotlib.figure import Figure

from pyjoystick.identification.fitting.result import Fit, RecordFit
from pyjoystick.support import BAND, FITTED, MEASURED, FloatArray, dress, legend_above, save_figure

#: Angles are plotted in degrees.
_ANGLES: Final = {"theta": "deg", "omega": "deg/s"}
_COLUMNS: Final = 3
#: Characters that fit into a legend with several columns, and the longest record name within a label.
_LEGEND_WIDTH: Final = 96
_LONGEST_NAME: Final = 12
#: The figure that only fits with profiles have.
PROFILES: Final = "profiles.png"


def save_figures(fit: Fit, folder: str | PathLike[str]) -> list[Path]:
    """Save all figures that apply to the fit as PNG; returns the files."""
    folder = Path(folder)
    figures = {
        "records.png": plot_records(fit),
        "residuals.png": plot_residuals(fit),
        "correlation.png": plot_correlation(fit),
    }
    if fit.profiles:
        figures[PROFILES] = plot_profiles(fit)
    for name, figure in figures.items():
        save_figure(figure, folder / name)
    return [folder / name for name in figures]


def plot_records(fit: Fit) -> Figure:
    """Plot each record (dots) with the fitted motion (line), or measured (dots) and fitted (crosses) peaks.

    The line shows the motion every millisecond, with a gap where samples are missing.
    """
    panels = [(one, label) for one in fit.records for label in _series(one)]
    figure = Figure(figsize=(7.4, 1.9 * len(panels) + 0.5), layout="constrained")
    axes = figure.subplots(len(panels), 1, squeeze=False, sharex=True)[:, 0]
    for panel, (one, label) in zip(axes, panels, strict=True):
        inside = np.array(one.labels) == label
        factor, unit = _scale(label)
        times = one.times[inside]
        panel.plot(times, one.data[inside] * factor, ".", color=MEASURED, markersize=4, label="measured")
        if one.curve is None:
            heights, instants = one.predicted[inside], one.predicted[len(times) :]
            panel.plot(instants, heights * factor, "x", color=FITTED, markersize=6, label="fit")
        else:
            panel.plot(one.curve.index, one.curve[label] * factor, color=FITTED, linewidth=1.0, label="fit")
        panel.set_ylabel(f"{label} {unit}".strip())
        panel.set_title(one.name, loc="left", fontsize="small")
        dress(panel)
    axes[-1].set_xlabel("Time (s)")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper right", ncols=2, frameon=False)
    return figure


def plot_residuals(fit: Fit) -> Figure:
    """Plot residuals in standard deviations of the noise, over time and as a histogram."""
    columns = max(1, min(4, _LEGEND_WIDTH // (4 + max(len(one.name) for one in fit.records))))
    rows = math.ceil(len(fit.records) / columns)
    figure = Figure(figsize=(7.4, 3.2 + 0.2 * rows), layout="constrained")
    over_time, histogram = figure.subplots(1, 2, sharey=True, width_ratios=[3.0, 1.0])
    markers = "o^sDv<>p"
    everything = []
    for k, one in enumerate(fit.records):
        scaled = _scaled_residuals(fit, one)
        everything.append(scaled)
        over_time.plot(
            one.times, scaled, markers[k % len(markers)], markersize=3, fillstyle="none", label=one.name
        )
    joined = np.concatenate(everything)
    histogram.hist(joined, bins=31, orientation="horizontal", density=True, color="0.8")
    level = np.linspace(-4.0, 4.0, 201)
    normal = np.exp(-0.5 * level**2) / math.sqrt(2.0 * math.pi)
    histogram.plot(normal, level, color=FITTED, linewidth=1.2, label="normal")
    over_time.set_xlabel("Time (s)")
    over_time.set_ylabel("Measured less fitted (standard deviations)")
    histogram.set_xlabel("Density")
    histogram.legend(frameon=False, fontsize="small")
    for axes in (over_time, histogram):
        dress(axes)
    figure.legend(
        *over_time.get_legend_handles_labels(),
        loc="outside upper center",
        ncols=columns,
        frameon=False,
        fontsize="small",
    )
    return figure


def plot_profiles(fit: Fit) -> Figure:
    """Plot the profile of each shared parameter in standard deviations of the noise; dashed: linear."""
    count = len(fit.profiles)
    columns = min(count, _COLUMNS)
    rows = math.ceil(count / columns)
    figure = Figure(figsize=(2.6 * columns + 0.8, 2.6 * rows + 0.4), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    quantile = fit.standard_errors.quantile
    for axes, (j, profile) in zip(grid, fit.profiles.items(), strict=False):
        variable = fit.variables[j]
        line = {"linewidth": 1.0, "markersize": 4.0}
        axes.plot(profile.values, np.abs(profile.distances), ".-", color=MEASURED, label="profile", **line)
        error = float(fit.standard_errors.errors[j])
        if math.isfinite(error) and error > 0.0:
            linear = np.abs(profile.values - fit.x[j]) / error
            axes.plot(profile.values, linear, "--", color=FITTED, linewidth=1.0, label="linear")
        level = f"{100.0 * fit.settings.uncertainty.level:g} %"
        axes.axhline(quantile, color=BAND, linewidth=0.9, label=level)
        axes.set_ylim(0.0, 1.6 * quantile)
        axes.set_xlabel(f"{variable.label} ({variable.unit})" if variable.unit else variable.label)
        axes.locator_params(axis="x", nbins=4)
        dress(axes)
    for axes in grid[count:]:
        axes.set_visible(False)
    legend_above(figure, grid[0])
    figure.supylabel("Distance from the best fit", fontsize="small")
    return figure


def plot_correlation(fit: Fit) -> Figure:
    """Plot the correlations of the fitted values; gray where the data do not determine a value.

    If record names are long, labels contain numbers instead, with a key below the figure.
    """
    names = [one.name for one in fit.records]
    numbered = max(map(len, names)) > _LONGEST_NAME
    labels = [
        variable.label
        if variable.record is None or not numbered
        else f"{variable.name} [{variable.record + 1}]"
        for variable in fit.variables
    ]
    size = 0.42 * len(labels) + 2.4
    figure = Figure(figsize=(size + 0.8, size), layout="constrained")
    axes = figure.subplots()
    matrix = np.ma.masked_invalid(fit.standard_errors.correlation)
    axes.set_facecolor("0.85")
    image = axes.imshow(matrix, cmap="RdBu_r", vmin=-1.0, vmax=1.0)
    axes.set_xticks(range(len(labels)), labels, rotation=90, fontsize="small")
    axes.set_yticks(range(len(labels)), labels, fontsize="small")
    for i in range(len(labels)):
        for j in range(len(labels)):
            value = fit.standard_errors.correlation[i, j]
            if math.isfinite(value):
                color = "white" if abs(value) > 0.6 else "black"
                axes.text(j, i, f"{value:.2f}", ha="center", va="center", fontsize="x-small", color=color)
    figure.colorbar(image, ax=axes, shrink=0.8, label="Correlation")
    if numbered:
        key = "\n".join(f"[{number}] {name}" for number, name in enumerate(names, start=1))
        figure.supxlabel(key, fontsize="x-small", ha="left", x=0.02)
    return figure


def _scaled_residuals(fit: Fit, one: RecordFit) -> FloatArray:
    sigma = np.array([one.sigma[label] for label in one.labels])
    if fit.settings.comparison == "peaks":
        count = len(one.data) // 2
        times = one.data[count:]
        spacing = np.diff(times, prepend=2.0 * times[0] - times[1])
        sigma = sigma * np.concatenate((np.abs(one.data[:count]), spacing))
    return np.asarray(one.residuals() / sigma)


def _series(one: RecordFit) -> list[str]:
    """The series of a record; times of peaks go with their heights."""
    return [label for label in dict.fromkeys(one.labels) if not label.endswith(" time")]


def _scale(label: str) -> tuple[float, str]:
    return (math.degrees(1.0), f"({_ANGLES[label]})") if label in _ANGLES else (1.0, "")
