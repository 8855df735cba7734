"""What the command line prints and writes: results to standard output, everything else to standard error."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Final

from rich.console import Console
from rich.markup import escape

from pyjoystick import model

#: Width of tables that are not shown on a terminal: more than any of them takes.
_UNBOUNDED: Final = 10_000
#: Part of the paper's stop angle, "about" 20 degrees, from which on an angle is beyond the stops.
_ABOUT: Final = 1.05


def output() -> Console:
    """Standard output; unless it is a terminal, nothing is wrapped or truncated, so that it can be piped."""
    from pyjoystick.cli.narrow_tables import NarrowConsole  # the lists of commands need no tables

    console = NarrowConsole(highlight=False)
    console.soft_wrap = not console.is_terminal
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _UNBOUNDED
    return console


def messages() -> Console:
    """Standard error."""
    console = Console(stderr=True, highlight=False)
    console.soft_wrap = not console.is_terminal
    return console


def print_error(message: str) -> None:
    """A message that reports an error."""
    messages().print(f"[bold red]error:[/bold red] {escape(message)}")


def print_note(message: str) -> None:
    """A line about what is being done."""
    messages().print(f"[dim]{escape(message)}[/dim]")


def print_notes(source: object, notes: Iterable[str]) -> None:
    """Notes on a file or a record."""
    for note in notes:
        print_note(f"{source}: {note}")


def print_traceback() -> None:
    """The traceback of the current exception."""
    messages().print_exception()


def write(path: Path | None, writer: Callable[[Path], object], remark: str = "") -> None:
    """Write a result if its file was given, and report it.

    Args:
        path: the file, None if its option was not given
        writer: writes the result to a path
        remark: is added to the report
    """
    if path is not None:
        writer(path)
        print_note(f"wrote {path}{remark}")


def note_stops(largest: float, joystick: model.JoystickParameters) -> None:
    """Report an angle (rad) beyond the stops of the real joystick, if the simulated one has none."""
    if largest > _ABOUT * model.STOP_ANGLE and not joystick.stops:
        print_note(
            f"note: {math.degrees(largest):.4g} degrees are beyond the stops of the paper's joystick at "
            f"about {math.degrees(model.STOP_ANGLE):.0f} degrees; none are set here (stops.theta_stop)"
        )
