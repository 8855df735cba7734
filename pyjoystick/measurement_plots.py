"""Figures of measured motions beside the true ones."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from pyjoystick._types import FloatArray
from pyjoystick.measurements.chain_effect import ChainEffect
from pyjoystick.parameters import JoystickParameters
from pyjoystick.reference.moments import energy

_GRAY = "0.85"
_VISIBLE = 2e-3


def plot_chain_effect(parameters: JoystickParameters, effect: ChainEffect, *, title: str) -> Figure:
    """Velocity and energy of a simulated motion and of what the chain makes of it (Fig. 12).

    Args:
        parameters: the joystick of the simulation
        effect: what `chain_effect` found
        title: stands above the figure
    """
    run, motion = effect.run, effect.motion
    shown = (motion.time >= run.time[0]) & (motion.time <= run.time[0] + 1.5)
    time = motion.time[shown] - run.time[0]
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    above.plot(run.time - run.time[0], run.omega, color="C0", label="simulated")
    above.plot(time, motion.omega[shown], color="C1", linestyle="--", label="through the chain")
    above.set_ylabel("angular velocity (rad/s)")
    above.legend(loc="lower right")
    measured = energy(parameters, motion.theta[shown], motion.omega[shown])
    below.plot(run.time - run.time[0], run.E, color="C0")
    below.plot(time, measured, color="C1", linestyle="--")
    below.fill_between(
        time, 0.0, 1.05 * run.E[0], where=_above_before(measured), color=_GRAY, linewidth=0.0, zorder=0
    )
    below.text(
        0.98,
        0.92,
        "gray: the measured energy lies above its own least before",
        transform=below.transAxes,
        ha="right",
    )
    below.set(ylabel="energy (J)", xlabel="time after the release (s)", ylim=(0.0, 1.05 * run.E[0]))
    below.set_xlim(0.0, float(time[-1]))
    above.set_title(title)
    return figure


def _above_before(values: FloatArray) -> list[bool]:
    """Where the energy lies above its least before, by more than the width of a line."""
    rise = values - np.minimum.accumulate(values)
    return [bool(one > _VISIBLE * values[0]) for one in rise]
