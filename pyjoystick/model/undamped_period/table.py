"""Undamped and observed periods over amplitudes, as tables and as a figure."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.undamped_period.closed_form import linearized_joystick
from pyjoystick.model.undamped_period.quadrature import undamped_oscillation
from pyjoystick.motion import periods
from pyjoystick.support import AMBER, BLACK, BLUE, GRAY, LONG_DASHES, SKY, FloatArray, dress, legend_above

#: Segments of the path: the clearance, the steep ones of Table 1 (k_0, k_2), the soft ones (k_1, k_3).
CLEARANCE, STEEP, SOFT = (0,), (1, 3), (2, 4)


def period_table(joystick: JoystickParameters, release_angles: Iterable[float]) -> pd.DataFrame:
    """Undamped periods after releases at rest.

    Args:
        joystick: the joystick
        release_angles: release angles (rad), positive forward

    Returns:
        one row per release, with the columns ``release`` (rad), ``amplitude`` (rad; the mean of the largest
        angles on both sides), ``period`` (s), ``linearized`` (s; in closed form, with linearized geometry),
        and ``clearance``, ``steep``, ``soft``: fractions of the period spent in such segments

    Raises:
        ParameterError, NoOscillationError: as `undamped_oscillation`
    """
    linearized = linearized_joystick(joystick)
    rows = []
    for release in release_angles:
        exact = undamped_oscillation(joystick, release)
        rows.append(
            {
                "release": release,
                "amplitude": 0.5 * (exact.forward + exact.backward),
                "period": exact.period,
                "linearized": linearized.oscillation(release).period,
                "clearance": exact.share(*CLEARANCE),
                "steep": exact.share(*STEEP),
                "soft": exact.share(*SOFT),
            }
        )
    return pd.DataFrame(rows)


def exponent(table: pd.DataFrame) -> FloatArray:
    """Slope of ln(period) over ln(amplitude) at each row of a table of rising amplitudes, shape (rows,).

    It is 0 for a linear spring and 1/2 for a constant restoring force, as for a bouncing ball.
    """
    slopes = np.gradient(np.log(table["period"].to_numpy()), np.log(table["amplitude"].to_numpy()))
    return np.asarray(slopes)


def decaying_periods(peaks: pd.DataFrame) -> pd.DataFrame:
    """Period and amplitude around each peak of a decaying oscillation.

    Args:
        peaks: alternating peaks of the angle as `find_peaks` gives them

    Returns:
        ``amplitude`` (rad; the mean of the peak and its neighbors on the other side) and ``period`` (s)
    """
    heights = peaks["value"].abs().to_numpy()
    amplitude = 0.5 * heights[1:-1] + 0.25 * (heights[:-2] + heights[2:])
    return pd.DataFrame({"amplitude": amplitude, "period": periods(peaks)["period"].to_numpy()})


_DEG: Final = math.degrees(1.0)
_MS: Final = 1e3
_ANGLE_TICKS: Final = (0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
_PERIOD_TICKS: Final = (50.0, 70.0, 100.0, 150.0, 200.0, 300.0)
_SHARES: Final = {
    "clearance": (AMBER, "time in the clearance"),
    "steep": ("0.3", "in steep segments"),
    "soft": (SKY, "in soft segments"),
}
_OPACITY: Final = 0.75
_MARKERS: Final = ("o", "^", "s", "D")


def plot_periods(
    table: pd.DataFrame, decaying: Mapping[str, tuple[pd.DataFrame, str]], *, title: str = ""
) -> Figure:
    """Plot period over amplitude, log-log; below, the fractions of the period in each kind of segment.

    Args:
        table: from `period_table`, with increasing amplitudes
        decaying: by label, results of `decaying_periods` and a color
        title: title of the figure
    """
    figure = Figure(figsize=(7.0, 6.6), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[5, 3])
    amplitude = table["amplitude"] * _DEG
    above.plot(amplitude, table["period"] * _MS, color=BLACK, linewidth=1.2, label="undamped")
    above.plot(
        amplitude,
        table["linearized"] * _MS,
        color=BLUE,
        linestyle=LONG_DASHES,
        linewidth=1.2,
        label="undamped, linearized geometry",
    )
    for (label, (points, color)), marker in zip(decaying.items(), _MARKERS, strict=False):
        style = {"color": color, "marker": marker, "linestyle": "", "markersize": 5.0, "fillstyle": "none"}
        above.plot(points["amplitude"] * _DEG, points["period"] * _MS, label=label, **style)
    _guide(above, table)
    _shares(below, table)
    above.set_ylabel("Period (ms)")
    below.set_ylabel("Part of the period (%)")
    below.set_xlabel("Amplitude, mean of both sides (deg)")
    below.set_ylim(0.0, 100.0)
    _logarithmic(above)
    margin = 0.93 * _MS * float(table["period"].min())
    above.set_ylim(margin, 1.1 * _MS * float(table["period"].iloc[-1]))
    for axes in (above, below):
        dress(axes)
    below.set_xlim(float(amplitude.min()), float(amplitude.max()))
    legend_above(figure, [above, below], columns=3, title=title)
    return figure


def _guide(axes: Axes, table: pd.DataFrame) -> None:
    """The slope for a constant force, next to the curve where it comes closest to it."""
    nearest = table.iloc[int(np.argmin(np.abs(exponent(table) - 0.5)))]
    amplitude, period = float(nearest["amplitude"]) * _DEG, float(nearest["period"]) * _MS
    ends = [0.5 * amplitude, 2.0 * amplitude]
    axes.plot(ends, [0.8 * period * math.sqrt(end / amplitude) for end in ends], color=GRAY, linewidth=1.0)
    axes.annotate(
        "constant force:\nsquare root of the amplitude",
        (amplitude, 0.8 * period),
        xytext=(6.0, -6.0),
        textcoords="offset points",
        va="top",
        fontsize="small",
        color="0.35",
    )


def _shares(axes: Axes, table: pd.DataFrame) -> None:
    colors = [color for color, _ in _SHARES.values()]
    parts = [100.0 * table[name].to_numpy() for name in _SHARES]
    axes.stackplot(table["amplitude"] * _DEG, *parts, colors=colors, alpha=_OPACITY, linewidth=0.0)
    for color, label in _SHARES.values():
        axes.plot([], [], "s", color=color, alpha=_OPACITY, label=label)


def _logarithmic(axes: Axes) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis, ticks in ((axes.xaxis, _ANGLE_TICKS), (axes.yaxis, _PERIOD_TICKS)):
        axis.set_major_locator(FixedLocator(ticks))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
