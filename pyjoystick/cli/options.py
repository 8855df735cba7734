"""Options that commands share."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Final

import typer

from pyjoystick import laboratory, model, motion, support
from pyjoystick.cli.invocation import invocation

DEFAULT_RELEASE_ANGLE: Final = "-20deg"


def quantity(kind: str, *names: str, metavar: str, text: str) -> Any:
    """An option for a number in the SI unit, or with another unit of its kind in `motion.UNITS`."""

    def read(given: str) -> float:
        try:
            return motion.amount(str(given), motion.UNITS[kind])
        except (KeyError, ValueError):
            units = ", ".join(motion.UNITS[kind])
            raise typer.BadParameter(f"{given!r} must be a number, or one with a unit: {units}") from None

    return typer.Option(*names, metavar=metavar, help=text, parser=read)


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
    """--column for a file with these columns."""
    return typer.Option("--column", metavar="NAME=HEADING", help=f"Heading of {names}; repeatable.")


def ending_in(*suffixes: str) -> Any:
    """Callback for one or several files to write; a wrong suffix is an immediate OutputFileError."""

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
    """--json; for ``-`` the file is None, and `console.write_json` writes to standard output."""

    def checked(given: Path | None) -> Path | None:
        if given is not None and str(given) == "-":
            invocation.is_piped = True
            return None
        if given is not None:
            support.check_suffix(given, ".json")
        return given

    text = f"Write {what} as JSON; - writes to standard output."
    return typer.Option("--json", metavar="FILE", help=text, callback=checked)


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
    str,
    typer.Option(
        "--title", metavar="TEXT", help="Heading. Default: the title of --parameters.", show_default=False
    ),
]
HtmlFile = Annotated[Path, file("--output", "-o", text="HTML file to write.", suffixes=(".html", ".htm"))]
