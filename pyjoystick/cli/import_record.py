"""``pyjoystick import record``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import laboratory, motion, support
from pyjoystick.cli import options, parsing, table_options
from pyjoystick.cli.console import output, print_warnings, write, write_json, write_plot
from pyjoystick.support import ParameterError

EXAMPLES: Final = """
Examples:

    pyjoystick import record log.csv --preview log.png

    pyjoystick import record log.xlsx --sheet "Run 3" --column theta=Joystick --unit theta=deg \\
        --output trial1.csv

    pyjoystick import record log.csv --scale theta=0.0879deg/count --zero theta=2048 \\
        --scale T=2.5N.m/V --from 1.5 --to 6 --output trial1.csv

The quantities are time, theta, omega, T (torque) and F (force). `pyjoystick peaks`, `pyjoystick fit` and
`pyjoystick torque` read the record.
"""


def run(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="CSV, XLSX, ODS, MAT or Parquet.")],
    record_file: Annotated[Path | None, options.csv("the record", "--output", "-o")] = None,
    preview: Annotated[
        Path | None,
        options.plot("what was understood; without --output, nothing else is written", "--preview"),
    ] = None,
    json: Annotated[Path | None, options.json("what was understood")] = None,
    columns: Annotated[list[str] | None, options.column("time, theta, omega, T or F")] = None,
    units: Annotated[
        list[str] | None,
        typer.Option(
            "--unit", metavar="NAME=UNIT", help="Unit of a column, overriding its heading; repeatable."
        ),
    ] = None,
    scales: Annotated[
        list[str] | None,
        typer.Option(
            "--scale",
            metavar="NAME=FACTOR",
            help="Calibration of counts or voltages, such as theta=0.0879deg/count; repeatable.",
        ),
    ] = None,
    zeros: Annotated[
        list[str] | None,
        typer.Option("--zero", metavar="NAME=NUMBER", help="Reading at zero, in the unit of --scale."),
    ] = None,
    start: Annotated[
        float | None, typer.Option("--from", metavar="SECONDS", help="Discard samples before this time.")
    ] = None,
    end: Annotated[
        float | None, typer.Option("--to", metavar="SECONDS", help="Discard samples after this time.")
    ] = None,
    samples_per_second: Annotated[
        float | None,
        typer.Option(
            "--samples-per-second", metavar="HZ", help="Sampling rate, instead of a column of times."
        ),
    ] = None,
    sheet: table_options.Sheet = "",
    delimiter: table_options.Delimiter = "",
    decimal: table_options.Decimal = "",
    encoding: table_options.Encoding = "",
) -> None:
    """Make a record from a laboratory's table of time, angle, torque and force.

    Anything ambiguous is an error, which names the option that resolves it.
    """
    if record_file is None and preview is None:
        raise typer.BadParameter("give --output, --preview or both")
    if record_file is not None and record_file.exists() and file.exists() and record_file.samefile(file):
        raise typer.BadParameter("is the table itself", param_hint="--output")
    layout = table_options.layout(delimiter, decimal, encoding, sheet)
    if samples_per_second is not None and not (0.0 < samples_per_second < math.inf):
        raise typer.BadParameter("must be above 0", param_hint="--samples-per-second")
    support.check_outputs(record_file, preview, json)
    log = motion.read_log(
        file,
        **parsing.parse_headings(columns, units),
        layout=layout,
        scales=_scales(scales, zeros),
        rate=samples_per_second,
        start=-math.inf if start is None else start,
        end=math.inf if end is None else end,
    )
    print_warnings(file, log.notes)
    output().print(laboratory.log_report(log), markup=False)
    write_plot(preview, lambda: laboratory.plot_log(log))
    write(record_file, lambda path: laboratory.write_log(log, path))
    write_json(json, lambda notes: laboratory.log_json(log, notes))


def _scales(texts: Sequence[str] | None, zeros: Sequence[str] | None) -> dict[str, motion.Scale]:
    """Calibrations of --scale and --zero by quantity.

    Raises:
        BadParameter: a text is not a calibration, or a zero has no scale
    """
    # A reading at zero is in the unit of the readings, whatever quantity they stand for.
    readings = parsing.parse_amounts(zeros, "--zero")
    at_zero = parsing.numbers_of(readings, lambda name, text: motion.amount_of(f"--zero {name}", text, {}))
    found = {}
    for name, text in parsing.parse_names(texts, "--scale").items():
        try:
            found[name] = motion.scale_of(name, text, at_zero.pop(name, 0.0))
        except ParameterError as error:
            raise typer.BadParameter(
                f"{name}={text} must be NAME=FACTOR, {error.allowed}", param_hint="--scale"
            ) from None
    for name in at_zero:
        raise typer.BadParameter(f"{name} has no --scale", param_hint="--zero")
    return found
