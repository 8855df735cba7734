"""Tables 1 and 2 and the other parameters of a joystick as rows of text."""

from __future__ import annotations

from collections.abc import Iterator

from pyjoystick.model.parameters.joystick import (
    ConstantDamping,
    Friction,
    JoystickParameters,
    PowerLawDamping,
)
from pyjoystick.model.parameters.stops import Stops
from pyjoystick.model.reference.moments import swing_frequency
from pyjoystick.support import TextTable

_MM = 1e3


def segment_table(joystick: JoystickParameters) -> TextTable:
    """Table 1: displacements (mm) and stiffnesses (N/m) of the segments on both sides."""
    sides = joystick.forward.to_table(), joystick.backward.to_table()
    rows = []
    for i in range(len(sides[0].x)):
        cells = [text for side in sides for text in (f"{side.x[i] * _MM:.6g}", f"{side.k[i]:.7g}")]
        rows.append([str(i), *cells])
    header = ("i", "forward x_i (mm)", "forward k_i (N/m)", "backward x_i (mm)", "backward k_i (N/m)")
    return TextTable(header, rows)


def body_table(joystick: JoystickParameters, pivot_to_top: float | None = None) -> TextTable:
    """Table 2, with gravity, which it lacks, and the frequency of the swing test.

    Args:
        joystick: the joystick
        pivot_to_top: distance from the pivot to the top of the handle (m), if known
    """
    rows = [
        ["mass", f"{joystick.m:.6g}", "kg"],
        ["moment of inertia about the pivot", f"{joystick.J:.6g}", "kg m2"],
        ["pivot to center of mass", f"{joystick.h:.6g}", "m"],
        *([] if pivot_to_top is None else [["pivot to top", f"{pivot_to_top:.6g}", "m"]]),
        ["pivot to plunger contact (a)", f"{joystick.a * _MM:.6g}", "mm"],
        ["pivot to cam surface (b)", f"{joystick.b * _MM:.6g}", "mm"],
        ["acceleration of gravity", f"{joystick.g:.7g}", "m/s2"],
        ["frequency of the swing test", f"{swing_frequency(joystick):.4g}", "Hz"],
    ]
    return TextTable(("", "value", "unit"), rows)


def spring_table(joystick: JoystickParameters) -> TextTable:
    """The restrained springs that make up the segments."""
    rows = []
    for side, assembly in (("forward", joystick.forward), ("backward", joystick.backward)):
        for name, spring in (("return", assembly.return_spring), ("balance", assembly.balance_spring)):
            numbers = (spring.k_s, spring.k_h, spring.F_0, spring.x_0 * _MM)
            rows.append([f"{side} {name} spring", *(f"{number:.7g}" for number in numbers)])
    return TextTable(("", "k_s (N/m)", "k_h (N/m)", "preload F_0 (N)", "engages at x_0 (mm)"), rows)


def damping_table(*laws: ConstantDamping | PowerLawDamping) -> TextTable:
    """Parameters of damping laws."""
    return TextTable(("", "value", "unit"), [row for law in laws for row in _damping_rows(law)])


def friction_table(friction: Friction) -> TextTable:
    """Parameters of the dry friction."""
    rows = [
        ["T_c, Coulomb friction moment at the pivot", f"{friction.T_c:.6g}", "N m"],
        ["F_c, Coulomb friction force along the plunger", f"{friction.F_c:.6g}", "N"],
        ["T_s, static friction moment at the pivot", f"{max(friction.T_s, friction.T_c):.6g}", "N m"],
    ]
    if friction.T_s > friction.T_c:
        rows.append(["omega_s, Stribeck velocity", f"{friction.omega_s:.6g}", "rad/s"])
    return TextTable(("", "value", "unit"), rows)


def stops_table(stops: Stops) -> TextTable:
    """Parameters of the stops."""
    rows = [
        ["theta_stop, angle of the stops to either side", f"{stops.theta_stop:.6g}", "rad"],
        ["K, stiffness of a stop about the pivot", f"{stops.K:.6g}", "N m/rad"],
        ["D, damping of a stop about the pivot", f"{stops.D:.6g}", "N m s/rad"],
    ]
    return TextTable(("", "value", "unit"), rows)


def _damping_rows(law: ConstantDamping | PowerLawDamping) -> Iterator[list[str]]:
    coefficient = "N m s/rad"
    if isinstance(law, ConstantDamping):
        yield ["constant C", f"{law.C:.6g}", coefficient]
        return
    yield ["alpha, weight of the displacement term", f"{law.alpha:.6g}", "1"]
    yield ["beta = 1 - alpha, weight of the velocity term", f"{law.beta:.6g}", "1"]
    for name, size, exponent, power in (
        ("A_pos", law.A_pos, "n_pos", law.n_pos),
        ("A_neg", law.A_neg, "n_neg", law.n_neg),
        ("B", law.B, "m", law.m),
    ):
        yield [name, f"{size:.6g}", coefficient]
        yield [exponent, f"{power:.6g}", "1"]
    yield ["eps_theta, rounds the angle off near 0", f"{law.eps_theta:.4g}", "rad"]
    yield ["eps_omega, rounds the velocity off near 0", f"{law.eps_omega:.4g}", "rad/s"]
