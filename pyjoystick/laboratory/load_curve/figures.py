"""Figures of load-deflection curves: a record with its fit, and a joystick's actuators (Fig. 7b and c)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.polynomial import Polynomial

from pyjoystick.laboratory.load_curve.cubic import cubic_fit, segment_force
from pyjoystick.laboratory.load_curve.fit import LoadCurveFit
from pyjoystick.model import ActuatorAssembly, JoystickParameters, assembly_force, contact_travel
from pyjoystick.support import (
    BACKWARD,
    BLUE,
    FITTED,
    FORWARD,
    GRAY,
    LONG_DASHES,
    MEASURED,
    FloatArray,
    angle,
    dress,
    legend_above,
)

_MM: Final = 1e3
_POINTS: Final = 2001


def plot_load_curve(fit: LoadCurveFit, *, title: str = "") -> Figure:
    """Plot the whole curve with segments and cubic; below it, the steep segments enlarged.

    Args:
        fit: from `fit_load_curve`
        title: title of the figure
    """
    figure = Figure(figsize=(7.0, 6.4), layout="constrained")
    steep = list(range(0, len(fit.table.x) - 1, 2))[:2]
    grid = figure.add_gridspec(2, max(len(steep), 1), height_ratios=(3, 2) if steep else (1, 0))
    whole = figure.add_subplot(grid[0, :])
    _draw(whole, fit, cubic=True)
    for column, i in enumerate(steep):
        axes = figure.add_subplot(grid[1, column])
        _draw(axes, fit, cubic=False)
        _enlarge(axes, fit, i)
    legend_above(figure, whole, marker_scale=4.0, title=title)
    return figure


def _draw(axes: Axes, fit: LoadCurveFit, *, cubic: bool) -> None:
    colors = (MEASURED, GRAY)
    for branch, name, color in zip(fit.curve.branches, ("loading", "unloading"), colors, strict=False):
        axes.plot(branch.travel * _MM, branch.force - fit.zero, ".", color=color, markersize=2.0, label=name)
    travel = fit.curve.loading.travel
    x = np.sort(np.concatenate((np.linspace(np.min(travel), np.max(travel), _POINTS), fit.table.x)))
    axes.plot(x * _MM, segment_force(fit, x), color=FITTED, linewidth=1.4, label="segments")
    if cubic:
        inside = x[x >= fit.table.x[0]]
        force = cubic_fit(fit.curve, fit.table.x[0], fit.zero)(inside)
        axes.plot(inside * _MM, force, color=BLUE, linestyle=LONG_DASHES, linewidth=1.4, label="cubic")
    axes.set_xlabel("Travel (mm)")
    axes.set_ylabel("Force (N)")
    dress(axes)


def _enlarge(axes: Axes, fit: LoadCurveFit, i: int) -> None:
    """Limits of the window around segment i, with its kinks marked."""
    first, last = fit.table.x[i], fit.table.x[i + 1]
    margin = 0.6 * (last - first)
    low, high = segment_force(fit, [first, last])
    space = 0.15 * (high - low) + 2.0 * abs(fit.friction)
    axes.set_xlim((first - margin) * _MM, (last + margin) * _MM)
    axes.set_ylim(low - space, high + space)
    for number, kink in ((i, first), (i + 1, last)):
        axes.axvline(kink * _MM, color="0.6", linewidth=0.8, zorder=0)
        axes.annotate(
            f"$x_{number}$",
            (kink * _MM, 0.02),
            xycoords=("data", "axes fraction"),
            xytext=(3, 0),
            textcoords="offset points",
        )


@dataclass(frozen=True, slots=True, eq=False)
class CubicFit:
    """A cubic polynomial fitted to the model's own curve, at equally spaced travel from contact to the end.

    Attributes:
        assembly: the actuator
        travel: travel (m), shape (n,)
        force: force of the model (N), shape (n,)
        cubic: force (N) by travel (m)
    """

    assembly: ActuatorAssembly
    travel: FloatArray
    force: FloatArray
    cubic: Polynomial

    @property
    def rms(self) -> float:
        """Root mean square difference between cubic and model (N)."""
        return float(np.sqrt(np.mean((self.cubic(self.travel) - self.force) ** 2)))


def cubic_fits(parameters: JoystickParameters, largest_angle: float) -> dict[str, CubicFit]:
    """Curves of both sides up to the travel at an angle, with their cubics.

    Args:
        parameters: the joystick
        largest_angle: angle at the end of the curves (rad)
    """
    end = float(contact_travel(parameters, angle("largest_angle", largest_angle)))
    fits = {}
    for side, assembly in (("forward", parameters.forward), ("backward", parameters.backward)):
        travel = np.linspace(assembly.kinks[0], end, _POINTS)
        force = assembly_force(assembly, travel)
        fits[side] = CubicFit(assembly, travel, force, Polynomial.fit(travel, force, 3))
    return fits


def plot_load_deflection(fits: dict[str, CubicFit]) -> Figure:
    """Plot force over travel, solid for the model and dashed for the cubics of `cubic_fits`."""
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    axes = figure.subplots()
    for (side, fit), color in zip(fits.items(), (FORWARD, BACKWARD), strict=True):
        corners = [0.0, *fit.assembly.kinks, fit.travel[-1]]
        axes.plot(
            np.array(corners) * _MM,
            assembly_force(fit.assembly, corners),
            color=color,
            linewidth=1.5,
            label=f"{side}, straight segments",
        )
        axes.plot(
            fit.travel * _MM,
            fit.cubic(fit.travel),
            color=color,
            linewidth=1.2,
            linestyle=LONG_DASHES,
            label=f"{side}, cubic",
        )
    axes.set_xlabel("Travel (mm)")
    axes.set_ylabel("Force (N)")
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    dress(axes)
    legend_above(figure, axes, columns=2)
    return figure
