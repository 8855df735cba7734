"""Options that commands share, and how their values are read."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any, Final

import typer

from pyjoystick import laboratory, model, motion, support
from pyjoystick.cli.plausibility import note_small_angle, require_plausible
from pyjoystick.support import ParameterError

_ANGLE: Final = re.compile(r"(?P<number>[-+0-9.eE]+)\s*(?P<unit>\D*)")
DEFAULT_RELEASE_ANGLE: Final = "-20deg"


def parse_angle(text: str, option: str = "--release-angle") -> float:
    """An angle in rad from text such as ``-20``, ``-20deg`` or ``-0.35rad``; a bare number is in degrees.

    Raises:
        BadParameter: the text is not an angle, or 90 degrees or more
    """
    match = _ANGLE.fullmatch(text.strip())
    try:
        number = float(match["number"]) if match else math.nan
    except ValueError:
        number = math.nan
    unit = motion.plain_unit(match["unit"]) if match else ""
    if unit not in ("", *motion.UNITS["angle"]) or not math.isfinite(number):
        raise typer.BadParameter(f"{text!r} is not an angle; write -20deg or -0.35rad", param_hint=option)
    if not unit:
        note_small_angle(option, text.strip(), number)
    angle = math.radians(number) if unit in ("", "deg") else number * motion.UNITS["angle"][unit]
    if abs(angle) >= math.pi / 2.0:
        hint = f"; did you mean {number:g}deg?" if unit == "rad" and abs(number) < 90.0 else ""
        raise typer.BadParameter(f"{text!r} must lie between -90deg and 90deg{hint}", param_hint=option)
    return angle


def parse_assignments(texts: Sequence[str] | None, option: str) -> dict[str, float]:
    """Numbers in SI units by name, from texts such as ``damping.C=0.05`` or ``a=24.1mm``; each name once.

    Raises:
        BadParameter: a text does not have that form, or a name is given twice
        ParameterError: a unit is not one of the parameter's
    """
    values: dict[str, float] = {}
    for text in texts or []:
        name, sign, value = (part.strip() for part in text.partition("="))
        number = math.nan
        try:
            number = _with_unit(name, value)
            if math.isfinite(number) and abs(number) >= 2.0**53 and value.lstrip("+-").isdecimal():
                number = int(value)  # beyond 2^53 the float may be another
        except ParameterError:
            raise
        except ValueError:
            sign = ""
        if not name or not sign:
            raise typer.BadParameter(
                f"{text!r} must be NAME=NUMBER, such as damping.C=0.05", param_hint=option
            )
        if name in values:
            raise typer.BadParameter(f"{name} is given twice", param_hint=option)
        values[name] = number
    return values


def _with_unit(name: str, text: str) -> float:
    """A number, with or without a unit of the parameter; raises ValueError where there is no number."""
    with suppress(ValueError):
        return float(text)
    units = model.units_of(name)
    try:
        return motion.amount(text, units or {})
    except KeyError:
        named = ", ".join(filter(None, units or ()))
        allowed = f"a number, or one with a unit: {named}" if named else "a number without a unit"
        raise ParameterError(name, text, allowed) from None


def quantity(kind: str, *names: str, metavar: str, text: str) -> Any:
    """An option for a number in the SI unit, or with another unit of that kind in `motion.UNITS`."""

    def read(given: str) -> float:
        try:
            return motion.amount(str(given), motion.UNITS[kind])
        except (KeyError, ValueError):
            units = ", ".join(motion.UNITS[kind])
            raise typer.BadParameter(f"{given!r} must be a number, or one with a unit: {units}") from None

    return typer.Option(*names, metavar=metavar, help=text, parser=read)


def parse_names(texts: Sequence[str] | None, option: str) -> dict[str, str]:
    """Texts by name from texts such as ``theta=Angle``.

    Raises:
        BadParameter: a text does not have that form
    """
    found = {}
    for text in texts or []:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (name and sign and value):
            raise typer.BadParameter(f"{text!r} must be NAME=TEXT", param_hint=option)
        found[name] = value
    return found


def parse_headings(columns: Sequence[str] | None, units: Sequence[str] | None) -> dict[str, dict[str, str]]:
    """The keyword arguments ``columns`` and ``units`` of a reader from --column and --unit."""
    return {"columns": parse_names(columns, "--column"), "units": parse_names(units, "--unit")}


def parse_curves(texts: Sequence[str] | None) -> dict[model.Side, Path]:
    """The files of --curve by side; raises BadParameter as `parse_names`, or for another side."""
    found: dict[model.Side, Path] = {}
    for name, file in parse_names(texts, "--curve").items():
        side = next((one for one in model.SIDES if one == name), None)
        if side is None:
            raise typer.BadParameter(f"{name!r} must be forward or backward", param_hint="--curve")
        found[side] = Path(file)
    return found


def refuse_given(reason: str, values: Mapping[str, object]) -> None:
    """Raise BadParameter for the first option that was given.

    Args:
        reason: why it is not allowed
        values: by option; None for an option that was not given
    """
    for option, value in values.items():
        if value is not None:
            raise typer.BadParameter(reason, param_hint=option)


def parameter_file(path: Path | None) -> model.ParameterFile:
    """The file of --parameters; the paper's by default.

    Raises:
        InputFileError, SettingsError: the file cannot be used
    """
    return model.PAPER if path is None else model.read_parameter_file(path)


def joystick_of(
    law: model.LawName | None,
    changes: Mapping[str, float],
    file: model.ParameterFile | None = None,
    own: model.JoystickParameters | None = None,
) -> model.JoystickParameters:
    """The joystick of a parameter file, the paper's by default, with some parameters changed.

    Args:
        law: damping law; that of the file by default
        changes: values by name (SI units)
        file: the parameter file
        own: the joystick to change instead of that of the file

    Raises:
        UnknownParameterError, ParameterError: a name or value is not allowed
        ImplausibleError: a value is one that no joystick has
        SettingsError: the file has no parameters of that damping law
    """
    for name in ("theta_start", "omega_start"):
        if name in changes:
            raise ParameterError(name, changes[name], "left out", "set the release with --release-angle")
    require_plausible(changes)
    if own is not None:
        return own.replace(changes)
    file = file or model.PAPER
    return (file.joystick if law is None else file.with_law(law)).replace(changes)


def chain_of(
    rate: float,
    cutoff: float,
    order: int,
    corrected: bool,
    longest_gap: float,
    velocity: int,
    acceleration: int,
) -> laboratory.Chain:
    """The signal chain of these options; raises ParameterError."""
    low_pass = laboratory.LowPass(cutoff, order, corrected)
    return laboratory.Chain(rate, low_pass, velocity, acceleration, longest_gap)


def column(names: str) -> Any:
    """--column of a file with these columns."""
    return typer.Option("--column", metavar="NAME=HEADING", help=f"Heading of {names}; repeatable.")


def ending_in(*suffixes: str) -> Any:
    """The callback of a file to write, or of several: another suffix is an OutputFileError at once."""

    def checked(given: Path | list[Path] | None) -> Path | list[Path] | None:
        for path in [given] if isinstance(given, Path) else given or []:
            support.check_suffix(path, *suffixes)
        return given

    return checked


def file(*names: str, text: str, suffixes: Sequence[str]) -> Any:
    """An option for a file to write."""
    return typer.Option(*names, metavar="FILE", help=text, callback=ending_in(*suffixes))


def plot(what: str, name: str = "--plot") -> Any:
    """--plot."""
    return file(name, text=f"Plot {what}: .png, .pdf or .svg.", suffixes=support.FIGURE_SUFFIXES)


def json(what: str) -> Any:
    """--json."""
    return file("--json", text=f"Write {what} as JSON.", suffixes=(".json",))


def csv(what: str, *names: str) -> Any:
    """--csv."""
    return file(*(names or ("--csv",)), text=f"Write {what} as CSV, in SI units.", suffixes=(".csv",))


def uncertainty(names: str) -> Any:
    """--uncertainty."""
    return typer.Option("--uncertainty", metavar="NAME=VALUE", help=f"Standard uncertainty of {names}.")


Records = Annotated[
    list[Path],
    typer.Argument(metavar="RECORD.csv", help="One file per release: columns time (s), theta (deg)."),
]
ReleaseAngle = Annotated[
    str,
    typer.Option(
        "--release-angle",
        "-a",
        metavar="ANGLE",
        help="Release angle: -20deg or -0.35rad; a bare number is in degrees.",
    ),
]
Duration = Annotated[float, typer.Option("--duration", "-d", metavar="SECONDS", help="Length of the run.")]
Law = Annotated[
    model.LawName | None,
    typer.Option("--damping", help="Damping law. Default: that of --parameters or --fmu, else constant."),
]
Parameters = Annotated[
    Path | None,
    typer.Option(
        "--parameters",
        "-p",
        metavar="FILE",
        help="Parameter file of the joystick (see `pyjoystick parameters`). Default: the paper's joystick. "
        "Other options take precedence.",
    ),
]
ParametersToUpdate = Annotated[
    Path | None,
    typer.Option(
        "--parameters",
        "-p",
        metavar="FILE",
        help="Parameter file to update; a new one starts with the paper's values.",
    ),
]
Columns = Annotated[list[str] | None, column("time, theta or omega")]
Units = Annotated[
    list[str] | None,
    typer.Option(
        "--unit", metavar="NAME=UNIT", help="Unit of a column whose heading gives none; repeatable."
    ),
]
Released = Annotated[
    model.Side | None,
    typer.Option("--released", help="Side of the release, if known; other records are rejected."),
]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        "-s",
        metavar="NAME=VALUE",
        help="Set a parameter, in SI units or with a unit such as a=24.1mm; repeatable. "
        "`pyjoystick info Joystick` lists them.",
    ),
]
FmuFile = Annotated[
    str | None,
    typer.Option(
        "--fmu",
        metavar="FILE",
        help="Run this FMU, which has its own damping law, instead of Joystick.fmu.",
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
        help="Tolerance of the FMU's integrator.",
    ),
]
Rest = Annotated[
    tuple[float, float] | None,
    typer.Option("--rest", metavar="START END", help="Interval at rest (s). Default: the last 0.25 s."),
]
Rate = Annotated[float, typer.Option("--rate", metavar="HZ", help="Sampling rate after interpolation.")]
Cutoff = Annotated[
    float, typer.Option("--cutoff", metavar="HZ", help="Cut-off frequency of the Butterworth filter.")
]
Order = Annotated[int, typer.Option("--order", metavar="N", help="Filter order of a single pass.")]
Corrected = Annotated[
    bool,
    typer.Option("--corrected", help="Raise the cut-off so that both passes together give -3 dB there."),
]
LongestGap = Annotated[
    float, typer.Option("--longest-gap", metavar="SECONDS", help="Longest gap between frames to bridge.")
]
VelocityPoints = Annotated[
    int, typer.Option("--velocity-points", metavar="N", help="Points of the first derivative: 3, 5 or 7.")
]
AccelerationPoints = Annotated[
    int,
    typer.Option("--acceleration-points", metavar="N", help="Points of the second derivative: 3, 5 or 7."),
]

Title = Annotated[
    str, typer.Option("--title", help="Heading. Default: the title of --parameters.", show_default=False)
]
HtmlFile = Annotated[Path, file("--output", "-o", text="HTML file to write.", suffixes=(".html", ".htm"))]
