"""Figures of damping estimates and of peak errors: Figs. 9 and 11 of the paper."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, MaxNLocator, NullFormatter, NullLocator, StrMethodFormatter

from pyjoystick.identification.peak_method.estimate import DampingEstimate
from pyjoystick.identification.peak_method.line import PowerLine
from pyjoystick.support import (
    BACKWARD,
    BLACK,
    FORWARD,
    LAWS,
    SERIES,
    FloatArray,
    ParameterError,
    dress,
    legend_above,
)

#: Color and marker of peaks by sign.
_SIDES: Final = {"positive": (FORWARD, "o"), "negative": (BACKWARD, "v")}
_BOTH: Final = BLACK
_DEG: Final = math.degrees(1.0)
_CONSTANT: Final = "constant C without the bias"
#: Ticks of the logarithmic axes: round numbers, because decades are too coarse for the range of C.
_C_TICKS: Final = (0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.15, 0.2)
_ANGLE_TICKS: Final = (0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0)
_VELOCITY_TICKS: Final = (50.0, 100.0, 150.0, 200.0, 300.0, 400.0, 500.0)
_ERRORS: Final = {
    "displacement_time": "peak time",
    "displacement": "peak displacement",
    "velocity_time": "velocity peak time",
    "velocity": "peak velocity",
}


def plot_damping_estimate(
    estimate: DampingEstimate, *, constant: float | None = None, confidence: float = 0.95, title: str = ""
) -> Figure:
    """Plot C_exp over peak heights, log-log, with lines and confidence bands, as in Fig. 9 (a) and (b).

    Args:
        estimate: points and lines
        constant: a constant C (N m s/rad) to draw as well, such as the one corrected for bias
        confidence: confidence level of the bands
        title: title of the figure
    """
    figure = Figure(figsize=(7.4, 3.8), layout="constrained")
    angle, velocity = figure.subplots(1, 2, sharey=True)
    for name, (color, _) in _SIDES.items():
        points = estimate.displacement[_side(estimate.displacement, name)]
        _points(angle, points, name)
        _line(angle, estimate.lines[name], points, color, confidence)
        angle.lines[-1].set_label(f"line, {name} peaks")
        _points(velocity, estimate.velocity[_side(estimate.velocity, name)], name)
    _line(velocity, estimate.lines["velocity"], estimate.velocity, _BOTH, confidence)
    velocity.lines[-1].set_label("line, both signs")
    if constant is not None:
        for axes in (angle, velocity):
            axes.axhline(constant, label=_CONSTANT, **LAWS["constant"])
    angle.set_ylabel("$C_\\mathrm{exp}$ (N m s/rad)")
    for axes, label, ticks in (
        (angle, "(a)  Peak displacement (deg)", _ANGLE_TICKS),
        (velocity, "(b)  Peak velocity (deg/s)", _VELOCITY_TICKS),
    ):
        axes.set_xlabel(label)
        _dress_logarithmic(axes, ticks)
    legend_above(figure, [angle, velocity], title=title, columns=3)
    return figure


def plot_peak_errors(
    sweeps: Mapping[str, pd.DataFrame], *, largest: float = 100.0, title: str = ""
) -> Figure:
    """Plot the errors of eqs. (12a, b) over parameters, one panel each, with marked minima, as in Fig. 11.

    Args:
        sweeps: tables of `sweep_peak_errors` by the label of the horizontal axis
        largest: upper end of the vertical axis (percent); curves may leave it
        title: title of the figure

    Raises:
        ParameterError: there is no sweep
    """
    if not sweeps:
        raise ParameterError("sweeps", "no sweep", "one or more")
    figure = Figure(figsize=(7.4, 3.8), layout="constrained")
    apart = {"wspace": 0.08}
    panels = figure.subplots(1, len(sweeps), sharey=True, squeeze=False, gridspec_kw=apart)[0]
    for axes, (label, sweep) in zip(panels, sweeps.items(), strict=True):
        for (column, label_of_error), style in zip(_ERRORS.items(), SERIES, strict=False):
            axes.plot(sweep.index, sweep[column], label=label_of_error, **style)
            at = sweep[column].idxmin()
            axes.plot([at], [sweep[column].min()], marker="o", markersize=4, color=style["color"])
        axes.set_xlabel(label)
        axes.set_xlim(float(sweep.index.min()), float(sweep.index.max()))
        axes.set_ylim(0.0, largest)
        axes.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
        dress(axes)
    panels[0].set_ylabel("Average error of the peaks (%)")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, title=title, loc="outside upper center", ncols=4, frameon=False)
    return figure


def _side(points: pd.DataFrame, name: str) -> pd.Series[bool]:
    return points["peak"] > 0.0 if name == "positive" else points["peak"] < 0.0


def _points(axes: Axes, points: pd.DataFrame, side: str) -> None:
    color, marker = _SIDES[side]
    axes.plot(
        points["peak"].abs() * _DEG,
        points["C"],
        label=f"{side} peaks",
        linestyle="",
        marker=marker,
        markersize=4.5,
        markerfacecolor="none",
        color=color,
    )


def _line(
    axes: Axes,
    line: PowerLine,
    points: pd.DataFrame,
    color: str,
    confidence: float,
) -> None:
    height = _heights(points)
    low, high = line.band(height, confidence)
    axes.plot(height * _DEG, line.at(height), color=color, linewidth=1.2)
    axes.fill_between(height * _DEG, low, high, color=color, alpha=0.15, linewidth=0.0)


def _heights(points: pd.DataFrame) -> FloatArray:
    heights = points["peak"].abs()
    return np.geomspace(float(heights.min()), float(heights.max()), 50)


def _dress_logarithmic(axes: Axes, ticks: tuple[float, ...]) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis, places in ((axes.xaxis, ticks), (axes.yaxis, _C_TICKS)):
        axis.set_major_locator(FixedLocator(places))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_locator(NullLocator())
        axis.set_minor_formatter(NullFormatter())
    dress(axes)
