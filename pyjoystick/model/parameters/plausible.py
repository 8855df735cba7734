"""Plausible ranges of a joystick's parameters: values far outside were most likely meant in another unit.

The physics is valid for any values, and studies use them, so `JoystickParameters` does not check. Values
entered by people are checked where they are read: in parameter files and on the command line.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, NamedTuple

from pyjoystick.motion import UNITS
from pyjoystick.support import ParameterError

_STIFFNESS: Final = UNITS["stiffness"]
_DAMPING: Final = UNITS["damping"]
_INERTIA: Final = {**UNITS["moment of inertia"], "kg.cm2": 1e-4}


class Range(NamedTuple):
    """Magnitudes from `low` to `high`, `typical` among them, in the first of `units` (factors to it)."""

    low: float
    typical: float
    high: float
    units: Mapping[str, float]

    @property
    def unit(self) -> str:
        """The SI unit."""
        return next(iter(self.units))


#: From thumb sticks to the levers of excavators, with a margin. Zero is never a mistaken unit.
RANGES: Final[Mapping[str, Range]] = {
    "J": Range(1e-6, 1e-2, 2.0, _INERTIA),
    "m": Range(1e-3, 1.0, 20.0, UNITS["mass"]),
    "h": Range(1e-3, 0.1, 1.0, UNITS["length"]),
    "g": Range(1e-2, 10.0, 30.0, UNITS["acceleration"]),
    "a": Range(1e-3, 0.02, 0.5, UNITS["length"]),
    "b": Range(1e-6, 5e-3, 0.5, UNITS["length"]),
    "pivot_to_top": Range(5e-3, 0.25, 2.0, UNITS["length"]),
    "k": Range(10.0, 5e3, 1e13, _STIFFNESS),
    "k_s": Range(10.0, 2.5e3, 1e6, _STIFFNESS),
    "k_h": Range(1e3, 5e5, 1e13, _STIFFNESS),
    "F_0": Range(1e-3, 50.0, 5e3, UNITS["force"]),
    "x_0": Range(1e-8, 1e-3, 0.1, UNITS["length"]),
    **dict.fromkeys(
        ("damping.C", "damping.A_pos", "damping.A_neg", "damping.B"), Range(1e-7, 0.05, 10.0, _DAMPING)
    ),
    **dict.fromkeys(("damping.n_pos", "damping.n_neg", "damping.m"), Range(0.0, 0.1, 5.0, {"": 1.0})),
    "damping.eps_theta": Range(1e-9, 1e-4, 0.1, UNITS["angle"]),
    "damping.eps_omega": Range(1e-9, 1e-3, 1.0, UNITS["angular velocity"]),
    **dict.fromkeys(("friction.T_c", "friction.T_s"), Range(1e-7, 0.01, 5.0, UNITS["torque"])),
    "friction.F_c": Range(1e-5, 0.3, 200.0, UNITS["force"]),
    "friction.omega_s": Range(1e-6, 0.02, 20.0, UNITS["angular velocity"]),
    "stops.theta_stop": Range(1e-3, 0.35, 1.57, UNITS["angle"]),
    "stops.K": Range(1.0, 1e3, 1e7, {"N.m/rad": 1.0}),
    "stops.D": Range(1e-6, 0.7, 1e3, _DAMPING),
    "travel_noise": Range(1e-10, 1e-6, 1e-4, UNITS["length"]),
    "force_noise": Range(1e-7, 0.05, 50.0, UNITS["force"]),
}
#: Below zero they are as plausible; anything else below zero is refused for that.
_SIGNED: Final = ("g", "damping.n_pos", "damping.n_neg", "damping.m")
#: Units of what is not judged.
_OTHERS: Final[Mapping[str, Mapping[str, float]]] = {
    "damping.alpha": {"": 1.0},
    **dict.fromkeys(("theta", "theta_start"), UNITS["angle"]),
    **dict.fromkeys(("omega", "omega_start"), UNITS["angular velocity"]),
    "alpha": UNITS["angular acceleration"],
    "x": UNITS["length"],
    "f_x": UNITS["force"],
    **dict.fromkeys(("T", "M_s", "M_d", "M_g", "M_f", "M_stop", "M_base"), UNITS["torque"]),
    "C": _DAMPING,
}


@dataclass(eq=False)
class ImplausibleError(ParameterError):
    """A value that is implausible for a joystick, most likely in another unit."""


def require_plausible(name: str, value: float, *, field: str = "", insist: str = "") -> None:
    """Reject an implausible value; names that are not in `RANGES` are not checked.

    Args:
        name: FMU name of a parameter, such as ``forward.returnSpring.k_s``, or a name of `RANGES`
        value: in SI units
        field: name in the message; by default `name`
        insist: how to have the value accepted, for the message

    Raises:
        ImplausibleError: its magnitude is neither 0 nor within the range
    """
    known = _range_of(name)
    size = abs(value)
    if known is None or known.low <= size <= known.high or size == 0.0 or not math.isfinite(size):
        return
    if value < 0.0 and name not in _SIGNED:
        return
    meant = {
        unit: size * factor
        for unit, factor in known.units.items()
        if known.low <= size * factor <= known.high
    }
    hints = [insist] if insist else []
    if meant:
        unit = min(meant, key=lambda one: abs(math.log(meant[one] / known.typical)))
        sign = math.copysign(1.0, value)
        hints.insert(0, f"did you mean {value:g} {unit} = {sign * meant[unit]:.6g} {known.unit}?")
    allowed = f"between {known.low:g} and {known.high:g} {known.unit}".rstrip() + ", as a joystick's is"
    raise ImplausibleError(field or name, value, allowed, " ".join(hints))


def units_of(name: str) -> Mapping[str, float] | None:
    """The units of a parameter or output of the joystick, by its FMU name, with factors to the SI unit.

    Returns:
        the SI unit first; the unit of a pure number is empty; None for a name that is not known
    """
    known = _range_of(name)
    return known.units if known else _OTHERS.get(name)


def _range_of(name: str) -> Range | None:
    return RANGES.get(name) or RANGES.get(name.rpartition(".")[2] if "Spring." in name else "")
