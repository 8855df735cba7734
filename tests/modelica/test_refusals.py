"""Impossible parameters are refused at initialization, with the parameter's name and value."""

from __future__ import annotations

import re

import pytest

from tests.modelica.library import Simulate, SimulationFailedError


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ("m = 0", "gravity.m must be positive, but is 0 kg"),
        ("h = -0.1", "gravity.h must not be negative, but is -0.1 m"),
        ("g = -9.8", "gravity.g must not be negative, but is -9.8 m/s2"),
        ("a = 0", "camPlate.a must be positive, but is 0 m"),
        ("b = -0.005", "camPlate.b must not be negative, but is -0.005 m"),
        ("J = -1", "handle.J must be positive, but is -1 kg.m2"),
        ("theta_start = -20", "j.theta_start must be between -pi/2 and pi/2, but is -20 rad"),
        ("theta_start = 1.6", "j.theta_start must be between -pi/2 and pi/2, but is 1.6 rad"),
        ("damping(C = -0.1)", "damping.C must not be negative, but is -0.1 N.m.s/rad"),
        ("forward(returnSpring(k_s = 0))", "forward.returnSpring.k_s must be positive, but is 0 N/m"),
        ("backward(returnSpring(k_h = -5))", "backward.returnSpring.k_h must be positive, but is -5 N/m"),
        ("forward(balanceSpring(F_0 = -1))", "forward.balanceSpring.F_0 must not be negative, but is -1 N"),
        ("backward(returnSpring(x_0 = -1))", "backward.returnSpring.x_0 must not be negative, but is -1 m"),
        (
            "forward(returnSpring(x_0 = 0.075), balanceSpring(x_0 = 0.05))",
            "forward.balanceSpring.x_0 must not be less than returnSpring.x_0 = 0.075 m, but is 0.05 m",
        ),
    ],
)
def test_joystick(simulate: Simulate, changes: str, message: str) -> None:
    _refused(simulate, f"PreloadedSprings.Joystick.Joystick j(T = 0, {changes});", message)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ("alpha = 1.5", "damping.alpha must be between 0 and 1, but is 1.5"),
        ("alpha = -0.5", "damping.alpha must be between 0 and 1, but is -0.5"),
        ("A_pos = -1", "damping.A_pos must not be negative, but is -1 N.m.s/rad"),
        ("A_neg = -1", "damping.A_neg must not be negative, but is -1 N.m.s/rad"),
        ("B = -1", "damping.B must not be negative, but is -1 N.m.s/rad"),
        ("eps_theta = -1", "damping.eps_theta must be positive, but is -1 rad"),
        ("eps_omega = -1", "damping.eps_omega must be positive, but is -1 rad/s"),
    ],
)
def test_power_law(simulate: Simulate, changes: str, message: str) -> None:
    _refused(simulate, f"PreloadedSprings.Joystick.JoystickPowerLaw j(T = 0, damping({changes}));", message)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("x_i = {0, 2, 1}, k_i = {1, 2, 3}", "c.x_i[3] must be greater than x_i[2] = 2 m, but is 1 m"),
        ("x_i = {0, 1, 1}, k_i = {1, 2, 3}", "c.x_i[3] must be greater than x_i[2] = 1 m, but is 1 m"),
        ("x_i = {-1, 1}, k_i = {1, 2}", "c.x_i[1] must not be negative, but is -1 m"),
        ("x_i = {0, 1}, k_i = {1, 0}", "c.k_i[2] must be positive, but is 0 N/m"),
    ],
)
def test_table(simulate: Simulate, table: str, message: str) -> None:
    declarations = (
        f"PreloadedSprings.Springs.TableAssembly c({table}); PreloadedSprings.Parts.Fixed wall; "
        "PreloadedSprings.Parts.Press press(v = 1);"
    )
    _refused(
        simulate,
        declarations,
        message,
        "connect(press.flange, c.flange_a); connect(c.flange_b, wall.flange);",
    )


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ("clearance = -0.001", "leftSpring.x_0 must not be negative, but is -0.001 m"),
        ("mass(m = -1)", "mass.m must be positive, but is -1 kg"),
        ("damper(d = -1)", "damper.d must not be negative, but is -1 N.s/m"),
    ],
)
def test_mass_between_springs(simulate: Simulate, changes: str, message: str) -> None:
    _refused(simulate, f"extends PreloadedSprings.Examples.OpposingSprings({changes});", message)


def test_motion_without_duration(simulate: Simulate) -> None:
    _refused(
        simulate,
        "PreloadedSprings.Examples.Utilities.ForwardAndReturn c(theta_max = 1, duration = -1);",
        "c.duration must be positive, but is -1 s",
    )


def test_angle_beyond_a_right_angle(simulate: Simulate) -> None:
    equations = "c.theta = 10*time; c.omega = 10; c.alpha = 0;"
    _refused(
        simulate,
        "PreloadedSprings.Joystick.JoystickInverse c;",
        # rumoca notices first that the lever of the plunger is infinite there.
        "(`c.friction.lever`|c.theta must stay between -pi/2 and pi/2)",
        equations,
        is_pattern=True,
    )


def _refused(
    simulate: Simulate, declarations: str, message: str, equations: str = "", *, is_pattern: bool = False
) -> None:
    with pytest.raises(SimulationFailedError, match=message if is_pattern else re.escape(message)):
        simulate(declarations, 0.5, equations=equations)
