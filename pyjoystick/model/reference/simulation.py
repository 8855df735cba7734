"""Motion of the joystick to 1e-10 rad: eq. (1), with the torque of eq. (13) if one is given."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.reference.branches import PiecewiseEquation
from pyjoystick.model.reference.dormand_prince import Step
from pyjoystick.model.reference.integration import Integration, Rest
from pyjoystick.model.reference.stick_slip import StickSlipIntegration
from pyjoystick.model.reference.trajectory import Trajectory, trajectory
from pyjoystick.support import FloatArray, Torque, angle, finite, increasing_times, positive

#: Largest estimated error of a step (rad and rad/s).
DEFAULT_TOLERANCE: Final = 1e-13


def simulate(
    joystick: JoystickParameters,
    *,
    time: ArrayLike,
    theta_start: float,
    omega_start: float = 0.0,
    torque: Torque | None = None,
    torque_breakpoints: Iterable[float] = (),
    tolerance: float = DEFAULT_TOLERANCE,
) -> Trajectory:
    """Integrate the equation of motion; every kink and the middle are located and restarted from.

    With dry friction, so are the instants at which the joystick starts to stick or slip.

    The method is that of Dormand and Prince of eighth order. Each output point is the end of a step of the
    method, and thus as accurate as the integration, whatever the spacing.

    Args:
        joystick: parameters of the joystick
        time: output times (s), shape (n,), n >= 2, strictly increasing; the run starts at the first and ends
            at the last
        theta_start: angle at the start (rad), |theta_start| < pi/2
        omega_start: angular velocity at the start (rad/s)
        torque: driving torque (N m) as a function of time (s), smooth except for jumps and kinks at
            `torque_breakpoints`, where its value is the limit from the right; None for free oscillation.
            While the joystick sticks, only changes are detected that last 50 ms or, if longer, 1e-4 of the
            time until the next breakpoint or the end
        torque_breakpoints: instants (s), in any order; those outside the run are ignored
        tolerance: largest estimated error of a step (rad and rad/s); the default gives 1e-10 rad after 1.5 s

    Raises:
        ParameterError: a start value, a time or the tolerance is not finite or outside its range
        SimulationError: the motion reaches pi/2, or the torque is not finite or jumps between breakpoints
    """
    instants = increasing_times(time)
    kind = StickSlipIntegration if joystick.friction else Integration
    integration = kind(
        PiecewiseEquation(joystick, torque),
        float(instants[0]),
        angle("theta_start", theta_start),
        finite("omega_start", omega_start, "rad/s"),
        positive("tolerance", tolerance),
    )
    theta, omega = np.empty_like(instants), np.empty_like(instants)
    theta[0], omega[0] = theta_start, omega_start
    mode = np.zeros_like(instants)
    mode[0] = integration.mode
    position = 1
    for step, reached in _spans(integration, instants, torque_breakpoints):
        while position < len(instants) and instants[position] <= reached:
            theta[position], omega[position] = step.at(float(instants[position]) - step.time)
            mode[position] = step.mode
            position += 1
    return trajectory(
        joystick,
        instants,
        theta,
        omega,
        torque,
        mode,
        events=tuple(integration.events),
        turning_points=tuple(integration.turning_points),
        accepted=integration.accepted,
        rejected=integration.rejected,
    )


def _spans(
    integration: Integration, instants: FloatArray, breakpoints: Iterable[float]
) -> Iterator[tuple[Step | Rest, float]]:
    """Yield all steps of the run with the times they reach, which include the breakpoints of the torque."""
    start, end = float(instants[0]), float(instants[-1])
    inner = {finite("torque_breakpoints", value, "s") for value in breakpoints}
    for _, stop in pairwise([start, *sorted(value for value in inner if start < value < end), end]):
        yield from integration.steps(stop)
