"""Options for the layout of a laboratory's table."""

from __future__ import annotations

from typing import Annotated

import typer

from pyjoystick import motion

Sheet = Annotated[
    str, typer.Option("--sheet", metavar="NAME", help="Sheet of a workbook, or structure of a .mat file.")
]
Delimiter = Annotated[
    str,
    typer.Option(
        "--delimiter",
        metavar="NAME",
        help="Separator: comma, semicolon, tab, bar, space, or another character.",
    ),
]
Decimal = Annotated[str, typer.Option("--decimal", metavar="MARK", help="Decimal mark: . or ,")]
Encoding = Annotated[
    str, typer.Option("--encoding", metavar="NAME", help="Encoding of a text file, such as cp1252.")
]


def layout(delimiter: str, decimal: str, encoding: str, sheet: str) -> motion.Layout:
    """Layout given by these options."""
    if decimal not in ("", ".", ","):
        raise typer.BadParameter(f"{decimal!r} must be . or ,", param_hint="--decimal")
    return motion.Layout(delimiter, decimal, encoding, sheet)
