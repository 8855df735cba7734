"""Where a joystick comes to rest."""

from __future__ import annotations

from pyjoystick.model import JoystickParameters, Side, angle_of_travel


def rest_angle(joystick: JoystickParameters, side: Side) -> float:
    """The angle (rad) at which a joystick leans against the springs of one side, positive forward.

    Gravity tips it over within its clearance. What it presses into the springs is left out: with the paper's
    stiffnesses 0.3 % of the angle.
    """
    actuator = joystick.forward if side == "forward" else joystick.backward
    angle = angle_of_travel(joystick, actuator.return_spring.x_0)
    return angle if side == "forward" else -angle
