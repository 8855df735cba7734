"""The system of this project: a person who moves the joystick, as two FMUs."""

from __future__ import annotations

from collections.abc import Mapping

from pyjoystick.fmu import Value
from pyjoystick.runs.coupling.system import Component, Connection, CoupledSystem


def operator_and_joystick(
    *,
    operator: Mapping[str, Value] | None = None,
    joystick: Mapping[str, Value] | None = None,
) -> CoupledSystem:
    """The operator's torque drives the joystick, whose angle and angular velocity the operator feels.

    ``PreloadedSprings.Examples.OperatedJoystick`` is the same system as one model.

    Args:
        operator: parameters of the FMU ``Operator`` that differ from its own, such as ``handArm.K``
        joystick: parameters of the FMU ``Joystick`` that differ from its own
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
