"""Figures that compare measured with true motions."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from matplotlib.figure import Figure

from pyjoystick.laboratory.measurement_errors import ChainEffect
from pyjoystick.laboratory.measurements.chain import Motion
from pyjoystick.model import JoystickParameters, Trajectory, energy, law_name
from pyjoystick.motion import GRAVITY
from pyjoystick.support import LAWS, LONG_DASHES, MEASURED, SOLID, FloatArray, dress, legend_above

_DEG: Final = math.degrees(1.0)
_MJ: Final = 1e3
_VISIBLE: Final = 2e-3
#: As in Fig. 12: solid for the simulation, dashed for the experiment.
_MEASURED: Final = {"color": MEASURED, "linestyle": LONG_DASHES, "linewidth": 1.1}


def plot_chain_effect(parameters: JoystickParameters, effect: ChainEffect) -> Figure:
    """Plot velocity and energy of a simulated motion, true and after the signal chain (Fig. 12).

    Args:
        parameters: the joystick of the simulation
        effect: from `chain_effect`
    """
    run, motion = effect.run, effect.motion
    shown = (motion.time >= run.time[0]) & (motion.time <= run.time[0] + 1.5)
    time = motion.time[shown] - run.time[0]
    law = law_name(parameters.damping)
    true = LAWS[law] | {"linestyle": SOLID}
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    above.plot(run.time - run.time[0], run.omega * _DEG, label="simulated", **true)
    above.plot(time, motion.omega[shown] * _DEG, label="through the measuring chain", **_MEASURED)
    above.set_ylabel("Velocity (deg/s)")
    measured = energy(parameters, motion.theta[shown], motion.omega[shown])
    below.plot(run.time - run.time[0], run.E * _MJ, **true)
    below.plot(time, measured * _MJ, **_MEASURED)
    below.fill_between(
        time,
        0.0,
        1.05 * run.E[0] * _MJ,
        where=_above_before(measured),
        color="0.88",
        linewidth=0.0,
        zorder=0,
        label="where it seems to have risen",
    )
    below.set(ylabel="Energy (mJ)", xlabel="Time (s)", ylim=(0.0, 1.05 * run.E[0] * _MJ))
    below.set_xlim(0.0, float(time[-1]))
    dress(above, zero=True)
    dress(below)
    figure.align_ylabels([above, below])
    legend_above(figure, [above, below])
    return figure


def plot_instruments(motion: Motion, true: Trajectory, *, release_time: float, distance: float) -> Figure:
    """Plot what camera and accelerometer record of a free oscillation, in the four panels of Fig. 4.

    Args:
        motion: output of the measuring chain
        true: the motion from the release, which an ideal accelerometer reads; distortions of its signal,
            such as ringing, are not simulated
        release_time: time of release on the clock of `motion` (s)
        distance: pivot to accelerometer (m)
    """
    duration = float(true.time[-1] - true.time[0])
    shown = (motion.time >= release_time) & (motion.time <= release_time + duration)
    time = motion.time[shown] - release_time
    # As in `pyjoystick.laboratory.measurements.accelerometer`: minus the component of gravity.
    reading = true.alpha - GRAVITY * np.sin(true.theta) / distance
    panels = (
        ("Displacement (deg)", time, motion.theta[shown] * _DEG),
        ("Velocity (deg/s)", time, motion.omega[shown] * _DEG),
        ("Acceleration,\ncamera (deg/s²)", time, motion.alpha[shown] * _DEG),
        ("Acceleration,\naccelerometer (deg/s²)", true.time - true.time[0], reading * _DEG),
    )
    figure = Figure(figsize=(7.0, 8.0), layout="constrained")
    axes = figure.subplots(len(panels), 1, sharex=True)
    for letter, panel, (label, instants, values) in zip("abcd", axes, panels, strict=True):
        panel.plot(instants, values, color=MEASURED, linewidth=1.1)
        panel.set_ylabel(label)
        panel.text(0.985, 0.93, f"({letter})", transform=panel.transAxes, ha="right", va="top")
        panel.margins(y=0.08)
        dress(panel, zero=True)
    axes[-1].set_xlabel("Time (s)")
    axes[-1].set_xlim(0.0, duration)
    figure.align_ylabels(axes)
    return figure


def _above_before(values: FloatArray) -> list[bool]:
    """Where the energy is above its minimum so far, by more than the width of a line."""
    rise = values - np.minimum.accumulate(values)
    return [bool(one > _VISIBLE * values[0]) for one in rise]
