"""A joystick as a Modelica class that extends one of the library's with other parameter values."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Final, Literal

from pyjoystick.model import STOP_NAMES, FmuValue, LawName
from pyjoystick.support import ParameterError, TextTable, version_of

Direction = Literal["forward", "inverse"]

#: The library's classes from torque to motion, by parts of the joystick; each has constant damping, and a
#: counterpart with eq. (11) whose name ends in PowerLaw.
_BASES: Final = {
    "stops": "Operator.MountedJoystick",
    "friction": "Joystick.JoystickFriction",
    "": "Joystick.Joystick",
}
#: From motion to torque: dry friction is a parameter, and motions end at the stops.
_INVERSE: Final = "Joystick.JoystickInverse"
#: Names of all these classes.
BASE_NAMES: Final = frozenset(
    base.rpartition(".")[2] + law for base in (*_BASES.values(), _INVERSE) for law in ("", "PowerLaw")
)
_INPUTS: Final[Mapping[Direction, str]] = {
    "forward": "torque in, motion out (eq. 1)",
    "inverse": "motion in, torque out (eq. 13)",
}
_NAME: Final = re.compile(r"[A-Z]\w*", re.ASCII)


def check_name(name: str) -> str:
    """Return the name if it is valid for a Modelica class, an FMU and a C library; raise `ParameterError`."""
    if not _NAME.fullmatch(name) or name == "PreloadedSprings":
        raise ParameterError("name", name, "letters, digits and underscores, a capital letter first")
    return name


def modelica_class(
    name: str,
    values: Sequence[FmuValue],
    *,
    direction: Direction = "forward",
    law: LawName,
    title: str = "",
    more: str = "",
) -> str:
    """Make a Modelica class for this joystick.

    All values are written in full precision, including those that equal the library's, because compilers
    differ in how they merge modifiers of nested components.

    Args:
        name: name of the class
        values: all parameters for that damping law
        direction: from torque to motion, or from motion to torque
        law: the damping law
        title: title of the joystick; may be empty
        more: HTML to append to the documentation

    Raises:
        ParameterError: the name cannot be that of a class
    """
    check_name(name)
    description = f"{title or name}: {_INPUTS[direction]}"
    if direction == "inverse":
        more = f"{_without_stops(values)}{more}"
        values = [v for v in values if v.name not in STOP_NAMES]
    base = base_class(values, direction, law)
    modifiers = _modifiers({tuple(v.name.split(".")): f"{v.value!r}" for v in values}, "    ")
    return (
        f"model {name} {_string(description)}\n"
        f"  extends PreloadedSprings.{base}(\n{modifiers});\n"
        "  annotation (\n"
        "    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),\n"
        f"    Documentation(info = {_string(_page(title or name, values, more))}));\n"
        f"end {name};\n"
    )


def _without_stops(values: Sequence[FmuValue]) -> str:
    """What the documentation of an inverse says of stops, which end its motions."""
    stop = next((v.value for v in values if v.name == "stops.theta_stop"), None)
    if stop is None:
        return ""
    return (
        f"<p><b>Valid within the stops only</b>, at {math.degrees(stop):.6g} degrees. This model has no "
        "stops: beyond that angle, its torque means nothing.</p>"
    )


def base_class(values: Sequence[FmuValue], direction: Direction, law: LawName) -> str:
    """The class of the library ``PreloadedSprings`` to extend, such as ``Joystick.Joystick``."""
    parts = {v.name.partition(".")[0] for v in values}
    forward = next(base for part, base in _BASES.items() if not part or part in parts)
    return (_INVERSE if direction == "inverse" else forward) + ("PowerLaw" if law == "power-law" else "")


def _modifiers(values: Mapping[tuple[str, ...], str], indent: str) -> str:
    """Nested modifiers, one value or component per line."""
    nested: dict[str, dict[tuple[str, ...], str]] = {}
    lines = []
    for path, text in values.items():
        if len(path) == 1:
            lines.append(f"{indent}{path[0]} = {text}")
        else:
            nested.setdefault(path[0], {})[path[1:]] = text
    for name, inner in nested.items():
        lines.append(f"{indent}{name}(\n{_modifiers(inner, indent + '  ')})")
    return ",\n".join(lines)


def _page(title: str, values: Sequence[FmuValue], more: str) -> str:
    """The documentation: all values with uncertainties and sources."""
    rows = [
        [
            v.name,
            f"{v.value:.9g}",
            "" if v.uncertainty is None else f"{v.uncertainty:.2g}",
            v.unit,
            v.source,
        ]
        for v in values
    ]
    header = ("parameter", "value", "standard uncertainty", "unit", "source")
    table = TextTable(header, rows).html("Parameters", prose=True)
    made = f"Written by pyjoystick {version_of('pyjoystick')} from a parameter file."
    return f"<html>\n<p>{escape(title)}. {made}</p>\n{table}\n{more}\n</html>"


def _string(text: str) -> str:
    """A Modelica string."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
