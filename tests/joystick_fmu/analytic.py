"""The joystick's partial derivatives by hand, from the equations of motion, of the cam and of the springs.

Written from the equations (1)-(8) and (11); E = J*omega^2/2 + work of the springs + m*g*h*(cos(theta) - 1).
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping

Parameters = Mapping[str, float]
Jacobian = dict[tuple[str, str], float]
"""By (unknown, known)."""


def _spring(p: Parameters, name: str, x: float) -> tuple[float, float, dict[str, float]]:
    """Force, stiffness, and the force's derivatives with respect to the spring's parameters."""
    k_s, k_h, f_0, x_0 = (p[f"{name}.{key}"] for key in ("k_s", "k_h", "F_0", "x_0"))
    delta = x - x_0
    if delta <= 0.0:
        return 0.0, 0.0, {}
    if k_h * delta <= f_0:
        stiffness = k_h + k_s
        by = {"k_s": delta, "k_h": delta, "x_0": -stiffness}
        return stiffness * delta, stiffness, {f"{name}.{key}": value for key, value in by.items()}
    by = {"k_s": delta, "F_0": 1.0, "x_0": -k_s}
    return f_0 + k_s * delta, k_s, {f"{name}.{key}": value for key, value in by.items()}


def _damping(p: Parameters, theta: float, omega: float) -> tuple[float, dict[str, float]]:
    """The coefficient C and its derivatives."""
    if "damping.C" in p:
        return p["damping.C"], {"damping.C": 1.0}
    sign = "pos" if theta > 0.0 else "neg"
    alpha, a, n = p["damping.alpha"], p[f"damping.A_{sign}"], p[f"damping.n_{sign}"]
    b, m, eps_theta, eps_omega = (p[f"damping.{key}"] for key in ("B", "m", "eps_theta", "eps_omega"))
    phi, w = math.hypot(theta, eps_theta), math.hypot(omega, eps_omega)
    by_phi, by_w = alpha * a * n * phi ** (n - 1.0), (1.0 - alpha) * b * m * w ** (m - 1.0)
    by = {
        "theta": by_phi * theta / phi,
        "omega": by_w * omega / w,
        "damping.alpha": a * phi**n - b * w**m,
        f"damping.A_{sign}": alpha * phi**n,
        f"damping.n_{sign}": alpha * a * phi**n * math.log(phi),
        "damping.B": (1.0 - alpha) * w**m,
        "damping.m": (1.0 - alpha) * b * w**m * math.log(w),
        "damping.eps_theta": by_phi * eps_theta / phi,
        "damping.eps_omega": by_w * eps_omega / w,
    }
    return alpha * a * phi**n + (1.0 - alpha) * b * w**m, by


def jacobian(p: Parameters, theta: float, omega: float, torque: float) -> Jacobian:
    """Derivatives of alpha, M_s, M_d, M_g, x, f_x, C and E; what is missing is zero."""
    a, b, inertia = p["a"], p["b"], p["J"]
    s = math.copysign(1.0, theta)
    tan, sec, sin, cos = math.tan(theta), 1.0 / math.cos(theta), math.sin(theta), math.cos(theta)
    fall = -tan * math.tan(theta / 2.0)  # 1 - 1/cos(theta), without the difference of nearly equal numbers
    x = a * abs(tan) + b * fall
    lever = a * s + (x - b) * tan
    found: defaultdict[tuple[str, str], float] = defaultdict(float)
    found |= {("x", "theta"): lever, ("x", "a"): abs(tan), ("x", "b"): fall}

    force = stiffness = 0.0
    side = "forward" if theta > 0.0 else "backward"
    for spring in ("returnSpring", "balanceSpring"):
        own_force, own_stiffness, by = _spring(p, f"{side}.{spring}", x)
        force, stiffness = force + own_force, stiffness + own_stiffness
        for name, value in by.items():
            found["f_x", name] = value
            found["M_s", name] = lever * value
    by_lever = {
        "theta": 2.0 * a * s * sec**2 * tan - b * sec * (sec**2 + tan**2),
        "a": s * sec**2,
        "b": -tan * sec,
    }
    for name, value in by_lever.items():
        found["f_x", name] = stiffness * found["x", name]
        found["M_s", name] = value * force + lever * found["f_x", name]

    c, by_damping = _damping(p, theta, omega)
    for name, value in by_damping.items():
        found["C", name] = value
        found["M_d", name] = value * omega
    found["M_d", "omega"] += c
    m, g, h = p["m"], p["g"], p["h"]
    found |= {("M_g", "theta"): m * g * h * cos, ("M_g", "m"): g * h * sin}
    found |= {("M_g", "g"): m * h * sin, ("M_g", "h"): m * g * sin}

    moment = torque + m * g * h * sin - lever * force - c * omega
    for (unknown, name), value in list(found.items()):
        if unknown in ("M_s", "M_d", "M_g"):
            found["alpha", name] += (value if unknown == "M_g" else -value) / inertia
    found |= {("alpha", "T"): 1.0 / inertia, ("alpha", "J"): -moment / inertia**2}
    found |= {("E", "theta"): lever * force - m * g * h * sin, ("E", "omega"): inertia * omega}
    found |= {("E", "J"): omega**2 / 2.0, ("E", "m"): g * h * sin * -math.tan(theta / 2.0)}
    return found
