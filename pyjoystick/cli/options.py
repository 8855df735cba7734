"""Options that commands share, and how their text is understood."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pyjoystick.model import PAPER, SIDES, JoystickParameters, ParameterFile, Side, read_parameter_file
from pyjoystick.support import ParameterError

if TYPE_CHECKING:
    from pyjoystick.fmu import FmuDescription

_ANGLE = re.compile(r"(?P<number>[-+0-9.eE]+)\s*(?P<unit>deg|rad|)")


class DampingLaw(StrEnum):
    """The damping laws of the paper."""

    CONSTANT = "constant"
    POWER_LAW = "power-law"


class SideName(StrEnum):
    """The sides of the joystick."""

    FORWARD = "forward"
    BACKWARD = "backward"


def parse_angle(text: str, option: str = "--release-angle") -> float:
    """An angle in rad from text such as ``-20``, ``-20deg`` or ``-0.35rad``; a bare number is in degrees.

    Raises:
        BadParameter: it is no angle, or 90 degrees or more
    """
    match = _ANGLE.fullmatch(text.strip())
    try:
        number = float(match["number"]) if match else math.nan
    except ValueError:
        number = math.nan
    if match is None or not math.isfinite(number):
        raise typer.BadParameter(f"{text!r} is no angle; write it as -20deg or -0.35rad", param_hint=option)
    angle = number if match["unit"] == "rad" else math.radians(number)
    if abs(angle) >= math.pi / 2.0:
        hint = f"; did you mean {number:g}deg?" if match["unit"] == "rad" and abs(number) < 90.0 else ""
        raise typer.BadParameter(f"{text!r} must lie between -90deg and 90deg{hint}", param_hint=option)
    return angle


def parse_assignments(texts: list[str], option: str) -> dict[str, float]:
    """Numbers by name from texts such as ``damping.C=0.05``; each name at most once.

    Raises:
        BadParameter: it is not of that form, or a name is given twice
    """
    values: dict[str, float] = {}
    for text in texts:
        name, sign, value = (part.strip() for part in text.partition("="))
        try:
            number = float(value)
        except ValueError:
            sign = ""
            number = math.nan
        if not name or not sign:
            raise typer.BadParameter(
                f"{text!r} must be NAME=NUMBER, such as damping.C=0.05", param_hint=option
            )
        if name in values:
            raise typer.BadParameter(f"{name} is given twice", param_hint=option)
        values[name] = number
    return values


def parse_names(texts: Sequence[str] | None, option: str) -> dict[str, str]:
    """Names and what they stand for from texts such as ``theta=Angle``.

    Raises:
        BadParameter: it is not of that form
    """
    found = {}
    for text in texts or []:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (name and sign and value):
            raise typer.BadParameter(f"{text!r} must be NAME=TEXT", param_hint=option)
        found[name] = value
    return found


def parameter_file(path: Path | None) -> ParameterFile:
    """The file of --parameters; the paper's where none is given.

    Raises:
        InputFileError, SettingsError: the file cannot be used
    """
    return PAPER if path is None else read_parameter_file(path)


def joystick_of(
    law: DampingLaw | None, changes: dict[str, float], file: ParameterFile = PAPER
) -> JoystickParameters:
    """The joystick of a parameter file with a damping law, its own where None, and some parameters changed.

    Raises:
        UnknownParameterError, ParameterError: a name or value is not allowed
        SettingsError: the file has no numbers of that damping law
    """
    for name in ("theta_start", "omega_start"):
        if name in changes:
            raise ParameterError(name, changes[name], "left out", "the release is --release-angle, from rest")
    joystick = file.joystick if law is None else file.with_law(law.value)
    return joystick.replace(changes)


def side_of(name: SideName | None) -> Side | None:
    """The side as the rest of the package takes it."""
    return next((side for side in SIDES if side == name), None)


def law_of(fmu: FmuDescription) -> DampingLaw:
    """The damping law that an FMU's parameters belong to."""
    has_power_law = "damping.alpha" in fmu.variables
    return DampingLaw.POWER_LAW if has_power_law else DampingLaw.CONSTANT


DEFAULT_RELEASE_ANGLE = "-20deg"

ReleaseAngle = Annotated[
    str,
    typer.Option(
        "--release-angle",
        "-a",
        metavar="ANGLE",
        help="Angle at which the joystick is let go: -20deg or -0.35rad; a bare number is in degrees.",
    ),
]
Duration = Annotated[float, typer.Option("--duration", "-d", metavar="SECONDS", help="Length of the run.")]
Law = Annotated[
    DampingLaw | None,
    typer.Option(
        "--damping",
        help="Damping law; if not given that of --parameters or of an FMU, constant without either.",
        show_default=False,
    ),
]
Parameters = Annotated[
    Path | None,
    typer.Option(
        "--parameters",
        "-p",
        metavar="FILE",
        help="The joystick, a TOML file as `pyjoystick parameters` writes it; the paper's if not given. "
        "What other options say takes precedence.",
        show_default=False,
    ),
]
Columns = Annotated[
    list[str] | None,
    typer.Option(
        "--column",
        metavar="NAME=HEADING",
        help="Where time, theta or omega is found; repeatable.",
        show_default=False,
    ),
]
Units = Annotated[
    list[str] | None,
    typer.Option(
        "--unit",
        metavar="NAME=UNIT",
        help="Unit of a column that has none in its heading; repeatable.",
        show_default=False,
    ),
]
Released = Annotated[
    SideName | None,
    typer.Option(
        "--released",
        help="Side of release, where it is known: other records are refused.",
        show_default=False,
    ),
]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        "-s",
        metavar="NAME=VALUE",
        help="Set a parameter, in SI units; repeatable. `pyjoystick info Joystick` lists them.",
        show_default=False,
    ),
]
FmuFile = Annotated[
    str | None,
    typer.Option(
        "--fmu",
        metavar="FILE",
        help="Another FMU with the interface of Joystick.fmu; the damping law is then its own.",
        show_default=False,
    ),
]
OutputInterval = Annotated[
    float, typer.Option("--output-interval", metavar="SECONDS", help="Time between two rows of the result.")
]
Tolerance = Annotated[
    float,
    typer.Option(
        "--tolerance",
        metavar="NUMBER",
        min=1e-13,
        max=1e-2,
        help="Tolerance that the FMU's integrator keeps, 1e-13 to 0.01.",
    ),
]
