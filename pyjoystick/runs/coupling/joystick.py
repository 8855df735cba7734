"""The coupled system of this project: operator and joystick, as two FMUs."""

from __future__ import annotations

from collections.abc import Mapping

from pyjoystick.fmu import Value
from pyjoystick.runs.coupling.system import Component, Connection, CoupledSystem


def operator_and_joystick(
    *,
    operator: Mapping[str, Value] | None = None,
    joystick: Mapping[str, Value] | None = None,
) -> CoupledSystem:
    """Couple operator and joystick: the torque drives the joystick, whose angle and velocity are fed back.

    ``PreloadedSprings.Examples.OperatedJoystick`` is the same system as a single model.

    Args:
        operator: changed parameters of the FMU ``Operator``, such as ``handArm.K``
        joystick: changed parameters of the FMU ``Joystick``
    """
    return CoupledSystem(
        name="operator_and_joystick",
        description="A hand and arm move the joystick forward and back",
        components=(
            Component("joystick", "Joystick", joystick or {}),
            Component("operator", "Operator", operator or {}),
        ),
        connections=(
            Connection("joystick.theta", "operator.theta"),
            Connection("joystick.omega", "operator.omega"),
            Connection("operator.T", "joystick.T"),
        ),
        stop_time=1.2,
    )
