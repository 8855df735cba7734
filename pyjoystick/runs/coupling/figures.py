"""Figures of coupled systems."""

from __future__ import annotations

import math
from typing import Final

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, ScalarFormatter

from pyjoystick.support import BLACK, BLUE, GREEN, LONG_DASHES, SOLID, VERMILION, dress, legend_above

_MARKERS: Final = {
    "delay": ("v", BLACK),
    "hold": ("s", BLUE),
    "extrapolate": ("^", GREEN),
    "iterate": ("o", VERMILION),
}


def plot_step_errors(errors: pd.DataFrame) -> Figure:
    """Plot the coupling error of the angle over the communication step, log-log.

    Args:
        errors: from `coupling_errors`, for an angle
    """
    figure = Figure(figsize=(5.6, 4.2), layout="constrained")
    axes = figure.add_subplot()
    for scheme, rows in errors.groupby("scheme", sort=False):
        marker, color = _MARKERS[str(scheme)]
        axes.loglog(
            1e3 * rows["step"], rows["error"], marker=marker, color=color, linewidth=1.2, label=str(scheme)
        )
    axes.set(xlabel="communication step H (ms)", ylabel="largest error of theta (rad)")
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.xaxis.set_minor_formatter(NullFormatter())
    dress(axes)
    legend_above(figure, axes)
    return figure


def plot_operated_joystick(run: pd.DataFrame) -> Figure:
    """Plot wanted and actual angle, and the torque of the operator.

    Args:
        run: run of `operator_and_joystick`
    """
    figure = Figure(figsize=(6.0, 4.6), layout="constrained")
    angle, torque = figure.subplots(2, 1, sharex=True)
    degrees = math.degrees(1.0)
    angle.plot(
        run.index, degrees * run["operator.theta_ref"], color=BLACK, linestyle=LONG_DASHES, label="wanted"
    )
    angle.plot(run.index, degrees * run["joystick.theta"], color=VERMILION, linestyle=SOLID, label="joystick")
    torque.plot(run.index, run["operator.T"], color=VERMILION)
    angle.set(ylabel="theta (deg)")
    torque.set(xlabel="Time (s)", ylabel="T of the operator (N m)")
    for axes in (angle, torque):
        dress(axes, zero=True)
    figure.align_ylabels()
    legend_above(figure, angle)
    return figure
