"""Energy loss in a free oscillation: the steps of Fig. 12 and the damping function of Fig. 13."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from pyjoystick.model import PAPER_STEP, JoystickParameters, Trajectory, simulate
from pyjoystick.support import BLACK, GRAY, LAWS, SKY, SOLID, dress, legend_above

#: A plateau is where the energy falls more slowly than this part of the largest rate in the adjacent swings.
REST: Final = 0.05

_COLUMNS: Final = ["time", "theta", "energy", "start", "end", "lost", "swing_lost"]


#: Sampling interval away from events (s), and first and last distance of samples from each event (s).
_INTERVAL: Final = 0.1e-3
_NEAREST: Final = 1e-9


def sampled_closely(joystick: JoystickParameters, *, release_angle: float, duration: float) -> Trajectory:
    """Simulate a free oscillation with samples ever closer to its events and turning points.

    There eq. (11) has jumps and spikes that last microseconds, which evenly spaced samples would meet by
    chance.

    Args:
        joystick: the joystick
        release_angle: release angle (rad)
        release_angle: angle of release (rad)
        duration: length of the run (s)

    Raises:
        ParameterError, SimulationError: as `simulate` does
    """
    even = np.linspace(0.0, duration, round(duration / _INTERVAL) + 1)
    found = simulate(joystick, time=even, theta_start=release_angle)
    events = [event.time for event in found.events]
    instants = np.array([*events, *(point.time for point in found.turning_points)])
    steps = np.geomspace(_NEAREST, 2.0 * PAPER_STEP, 120)
    around = instants[:, np.newaxis] + np.concatenate([-steps[::-1], [0.0], steps])
    time = np.unique(np.concatenate([even, around[(around > 0.0) & (around < duration)]]))
    return simulate(joystick, time=time, theta_start=release_angle)


def plateaus(run: Trajectory) -> pd.DataFrame:
    """Find the plateau around each turning point of a free oscillation that starts at rest.

    Args:
        run: a motion without torque; plateaus end at its samples, which `sampled_closely` makes
            dense there

    Returns:
        one row per turning point with a swing before and after it: ``time`` (s), ``theta`` (rad), ``energy``
        (J) there, ``start`` and ``end`` of the plateau (s), ``lost`` on it (J), and ``swing_lost`` (J), the
        energy lost in the swing before the turning point; empty if no energy is lost
    """
    power = np.abs((run.M_d + run.M_f) * run.omega)
    if not power.any():
        return pd.DataFrame(columns=_COLUMNS, dtype=np.float64)
    points = run.turning_points
    turns = np.array([run.time[0], *(point.time for point in points)])
    at = np.searchsorted(run.time, turns)
    # No power is dissipated at zero velocity: between samples the energy is level.
    energy = np.interp(turns, run.time, run.E)
    lost = -np.diff(energy)
    rows = []
    for i, ((before, here), after) in enumerate(zip(pairwise(at), at[2:], strict=False)):
        rest = REST * min(np.max(power[before:here]), np.max(power[here:after]))
        start = before + int(np.flatnonzero(power[before:here] >= rest)[-1]) + 1
        end = here + int(np.flatnonzero(power[here:after] >= rest)[0]) - 1
        rows.append(
            {
                "time": points[i].time,
                "theta": points[i].theta,
                "energy": energy[i + 1],
                "start": run.time[start],
                "end": run.time[end],
                "lost": run.E[start] - run.E[end],
                "swing_lost": lost[i],
            }
        )
    return pd.DataFrame(rows, columns=_COLUMNS, dtype=np.float64)


def damping_jumps(run: Trajectory) -> pd.DataFrame:
    """Change of C within the paper's time step around each zero of the angle and of the velocity.

    Eq. (11) jumps where theta = 0, from one side to the other, and has a peak where omega = 0. With negative
    exponents, only eps_theta and eps_omega keep it finite, so the sizes depend on them.

    Args:
        run: a motion without torque, from `sampled_closely`

    Returns:
        one row per zero in order of time: ``time`` (s), ``zero`` (``theta`` or ``omega``), ``amplitude``
        (rad; of the turning point before it, or at it) and ``jump``, the largest minus the smallest
        C (N m s/rad)
    """
    middles = [(event.time, "theta", math.nan) for event in run.events if event.kind == "theta = 0"]
    turns = [(point.time, "omega", abs(point.theta)) for point in run.turning_points]
    amplitude = abs(float(run.theta[0]))
    rows = []
    for time, zero, height in sorted(middles + turns):
        amplitude = amplitude if math.isnan(height) else height
        near = run.C[np.abs(run.time - time) <= PAPER_STEP]
        rows.append({"time": time, "zero": zero, "amplitude": amplitude, "jump": float(np.ptp(near))})
    return pd.DataFrame(rows)


def mean_damping(run: Trajectory) -> float:
    """The mean of C over time (N m s/rad)."""
    return float(np.trapezoid(run.C, run.time) / (run.time[-1] - run.time[0]))


def equivalent_damping(run: Trajectory) -> float:
    """Constant that dissipates as much energy along the same motion (N m s/rad).

    As dE/dt = -C*omega^2, it is the energy loss divided by the integral of omega^2; dissipation by dry
    friction counts as damping.
    """
    return float((run.E[0] - run.E[-1]) / np.trapezoid(run.omega**2, run.time))


_DEG: Final = math.degrees(1.0)
_MJ: Final = 1e3


def plot_energy(run: Trajectory, rests: pd.DataFrame, *, title: str = "") -> Figure:
    """Plot energy over time with shaded plateaus and, below, the power dissipated by damping and friction.

    Args:
        run: a free oscillation
        rests: its `plateaus`
        title: title of the figure
    """
    figure = Figure(figsize=(7.0, 5.4), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    above.plot(run.time, run.E * _MJ, color=BLACK, linewidth=1.3, label="energy")
    below.plot(run.time, (run.M_d + run.M_f) * run.omega, color=BLACK, linewidth=1.1)
    for axes in (above, below):
        for i, (start, end) in enumerate(zip(rests["start"], rests["end"], strict=True)):
            label = "plateau, around a turning point" if i == 0 and axes is above else None
            axes.axvspan(start, end, color=SKY, alpha=0.45, linewidth=0.0, label=label)
        dress(axes)
        axes.set_ylim(bottom=0.0)
    above.set_ylabel("Energy (mJ)")
    below.set_ylabel("Power lost (W)")
    below.set_xlabel("Time (s)")
    below.set_xlim(0.0, float(run.time[-1]))
    figure.align_ylabels([above, below])
    legend_above(figure, above, title=title)
    return figure


def plot_damping_function(run: Trajectory, *, constant: float, equivalent: float, title: str = "") -> Figure:
    """Plot C over time with constants and, below, the angle, which shows where the jumps are.

    Args:
        run: a free oscillation with the power law
        constant: a constant C (N m s/rad) to compare with
        equivalent: the one that dissipates as much energy (N m s/rad), see `equivalent_damping`
        title: title of the figure
    """
    figure = Figure(figsize=(7.0, 5.4), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    style = LAWS["power-law"] | {"linestyle": SOLID, "linewidth": 1.1}
    above.plot(run.time, run.C, label="damping function, eq. (11)", **style)
    above.axhline(constant, label=f"constant {constant:g}", **LAWS["constant"])
    above.axhline(equivalent, color=GRAY, linewidth=1.2, label=f"{equivalent:.3f}, takes as much energy")
    below.plot(run.time, run.theta * _DEG, color=BLACK, linewidth=1.1)
    for point in run.turning_points:
        for axes in (above, below):
            axes.axvline(point.time, color="0.85", linewidth=0.7, zorder=0)
    above.set_ylabel("C (N m s/rad)")
    above.set_ylim(bottom=0.0)
    below.set_ylabel("Displacement (deg)")
    below.set_xlabel("Time (s); vertical lines where it turns")
    below.set_xlim(0.0, float(run.time[-1]))
    dress(above)
    dress(below, zero=True)
    for axes in (above, below):
        axes.grid(visible=False, axis="x")
    figure.align_ylabels([above, below])
    legend_above(figure, above, title=title)
    return figure
