"""Round trip: drive the joystick's FMU by the torque computed for a motion, and compare the motions."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu, Interface, find_fmu, read_description, run_model_exchange
from pyjoystick.forced_motion.motions import ForwardAndReturn, Kinematics
from pyjoystick.forced_motion.samples import smooth_spans
from pyjoystick.model import Friction, JoystickParameters, inverse_torque, sliding_friction, values_for
from pyjoystick.runs import fmu_of_joystick
from pyjoystick.support import FloatArray, positive

#: Largest deviation of the torque from the lines between rows (N m); reproduces the motion to 1e-7 rad.
TORQUE_TOLERANCE: Final = 2e-8

#: Number of points per smooth span for estimating the curvature of the torque.
_POINTS: Final = 800
#: A difference below this part of the largest torque is not a jump.
_ROUNDING: Final = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class RoundTrip:
    """A motion, and the joystick's motion under the torque computed for it.

    Attributes:
        rows: number of rows of the input table
        wanted: the motion at the recorded times
        found: table from the run: ``theta``, ``omega`` (SI units) over time (s)
    """

    rows: int
    wanted: Kinematics
    found: pd.DataFrame

    @property
    def theta_error(self) -> float:
        """Largest difference of the angle (rad)."""
        return float(np.max(np.abs(self.found["theta"] - self.wanted.theta)))

    @property
    def omega_error(self) -> float:
        """Largest difference of the angular velocity (rad/s)."""
        return float(np.max(np.abs(self.found["omega"] - self.wanted.omega)))


def round_trip(
    joystick: JoystickParameters,
    motion: ForwardAndReturn,
    *,
    interface: Interface = "CoSimulation",
    torque: pd.DataFrame | None = None,
    output_interval: float = 1e-3,
) -> RoundTrip:
    """Drive the joystick's FMU by the torque required for a motion.

    In Co-Simulation, the FMU gets the slopes of the piecewise linear torque (input derivatives); in Model
    Exchange, CVode evaluates the torque at its own time steps.

    Args:
        joystick: parameters for both directions
        motion: the motion
        interface: interface for running the FMU
        torque: input table; by default from `torque_rows`
        output_interval: time between two recorded samples (s), rounded so that it divides the motion

    Raises:
        ParameterError: the interval is not above 0
        FmuNotFoundError, FmuFileError, UnsupportedFmuError, FmuRunError, SimulationError: as for any run
    """
    steps = max(1, round(motion.duration / positive("output_interval", output_interval, "s")))
    time = motion.duration * np.arange(steps + 1) / steps
    inputs = torque_rows(joystick, motion) if torque is None else torque
    path = find_fmu(fmu_of_joystick(joystick))
    parameters = values_for(joystick, read_description(path).variables)
    outputs = ("theta", "omega")
    if interface == "ModelExchange":
        found = run_model_exchange(path, time, parameters=parameters, inputs=inputs, outputs=outputs)
    else:
        with Fmu(path) as opened:
            found = opened.run(time, parameters=parameters, inputs=inputs, outputs=outputs)
    return RoundTrip(len(inputs), motion.at(time), found)


def torque_rows(
    joystick: JoystickParameters, motion: ForwardAndReturn, *, tolerance: float = TORQUE_TOLERANCE
) -> pd.DataFrame:
    """Torque of a motion as a piecewise linear input table.

    The curvature of the torque determines the density of rows. Each corner of the motion or the springs has
    one row, and each jump of the torque two.

    Args:
        joystick: the joystick
        motion: the motion
        tolerance: largest deviation of the lines from the torque (N m)

    Returns:
        a table with the column ``T`` (N m) over time (s), for `Fmu.run`
    """
    allowed = positive("tolerance", tolerance, "N.m")
    times, torques = [], []
    for start, end in pairwise(smooth_spans(joystick, motion)):
        torque = _SpanTorque(joystick, motion, start, end)
        instants = _rows(torque, start, end, allowed)
        inner = torque.at(motion.at(instants))
        # The end belongs to this span, whatever follows.
        inner[-1:] = torque.at(motion.at(instants[-1:], "before"))
        times.append(instants)
        torques.append(inner)
    time, values = np.concatenate(times), np.concatenate(torques)
    same = np.abs(np.diff(values)) < _ROUNDING * np.max(np.abs(values))
    repeated = np.append(False, (np.diff(time) == 0.0) & same)
    return pd.DataFrame({"T": values[~repeated]}, index=pd.Index(time[~repeated], name="time"))


def _rows(torque: _SpanTorque, start: float, end: float, tolerance: float) -> FloatArray:
    """Times from `start` to `end` such that chords deviate from the torque by at most `tolerance`.

    The deviation of a chord over a step h is h^2/8 times the second derivative.
    """
    unit = np.sin(np.linspace(0.0, 0.5 * np.pi, _POINTS)) ** 2
    time = start + (end - start) * unit
    inside = time[1:-1]
    values = torque.at(torque.motion.at(inside))
    curvature = np.abs(np.gradient(np.gradient(values, inside), inside))
    density = np.sqrt(curvature / (8.0 * tolerance))
    steps = np.concatenate(([0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(inside))))
    count = max(2, int(np.ceil(steps[-1])) + 1)
    rows = np.interp(np.linspace(0.0, steps[-1], count), steps, inside)
    rows[0], rows[-1] = start, end
    return rows


class _SpanTorque:
    """The torque within a span with one direction of motion, including ends at rest."""

    def __init__(
        self, joystick: JoystickParameters, motion: ForwardAndReturn, start: float, end: float
    ) -> None:
        self.motion = motion
        self._joystick = joystick
        self._without = dataclasses.replace(joystick, friction=Friction())
        self._direction = np.sign(motion.at(np.array([0.5 * (start + end)])).omega)

    def at(self, motion: Kinematics) -> FloatArray:
        """Torque (N m) at times within the span."""
        torque = inverse_torque(self._without, motion.theta, motion.omega, motion.alpha).T
        if not self._joystick.friction:
            return torque
        return torque + self._direction * sliding_friction(self._joystick, motion.theta, motion.omega)
