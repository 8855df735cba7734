"""The load-deflection curves of a joystick's actuators beside cubic polynomials (Fig. 7b)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from matplotlib.figure import Figure
from numpy.polynomial import Polynomial

from pyjoystick.model import ActuatorAssembly, JoystickParameters, assembly_force, contact_travel
from pyjoystick.support import BACKWARD, FORWARD, LONG_DASHES, FloatArray, angle, dress, legend_above

_MM: Final = 1e3
_POINTS: Final = 2001


@dataclass(frozen=True, slots=True, eq=False)
class CubicFit:
    """A cubic polynomial through the model's own curve, over equally spaced travel from contact to the end.

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
        """How far the cubic lies from the model, root mean square (N)."""
        return float(np.sqrt(np.mean((self.cubic(self.travel) - self.force) ** 2)))


def cubic_fits(parameters: JoystickParameters, largest_angle: float) -> dict[str, CubicFit]:
    """The curves of both sides up to the travel at an angle, with their cubics.

    Args:
        parameters: the joystick
        largest_angle: where the curves end (rad)
    """
    end = float(contact_travel(parameters, angle("largest_angle", largest_angle)))
    fits = {}
    for side, assembly in (("forward", parameters.forward), ("backward", parameters.backward)):
        travel = np.linspace(assembly.kinks[0], end, _POINTS)
        force = assembly_force(assembly, travel)
        fits[side] = CubicFit(assembly, travel, force, Polynomial.fit(travel, force, 3))
    return fits


def plot_load_deflection(
    fits: dict[str, CubicFit], *, title: str = "", size: tuple[float, float] = (7.0, 4.2)
) -> Figure:
    """Force over travel, the model solid and the cubics dashed.

    Args:
        fits: from `cubic_fits`
        title: a line above the figure
        size: width and height (inch)
    """
    figure = Figure(figsize=size, layout="constrained")
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
    legend_above(figure, axes, columns=2, title=title)
    return figure
