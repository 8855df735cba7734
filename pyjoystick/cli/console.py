"""What the command line prints and writes: results to standard output, everything else to standard error."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from rich.console import Console
from rich.markup import escape

from pyjoystick import model, support
from pyjoystick.cli.invocation import invocation

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.progress import Progress, ProgressColumn

#: Width of tables that are not shown on a terminal: more than any of them takes.
_UNBOUNDED: Final = 10_000
#: Part of the paper's stop angle, "about" 20 degrees, from which on an angle is beyond the stops.
_ABOUT: Final = 1.05


def output() -> Console:
    """Standard output, or standard error beside a document that is piped.

    Unless it is a terminal, nothing is wrapped or truncated, so that it can be piped.
    """
    from pyjoystick.cli.narrow_tables import NarrowConsole  # the lists of commands need no tables

    is_piped = invocation.is_piped
    console = NarrowConsole(highlight=False, stderr=is_piped, quiet=is_piped and invocation.quiet)
    console.soft_wrap = not console.is_terminal
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _UNBOUNDED
    return console


def progress_console() -> Console:
    """Standard error, for what moves: a status, a bar, a table of steps; nothing with --quiet.

    With --verbose nothing either: the lines of the log would tear it apart.
    """
    return _messages(quiet=invocation.quiet or invocation.verbose)


def progress_bar(*columns: str | ProgressColumn) -> Progress:
    """A bar on standard error, gone at its end; nothing is drawn unless that is a terminal."""
    from rich.progress import Progress  # the lists of commands need no bars

    console = progress_console()
    return Progress(*columns, console=console, transient=True, disable=not console.is_terminal)


def print_error(message: str) -> None:
    """A message that reports an error."""
    _messages().print(f"[bold red]error:[/bold red] {escape(message)}")


def print_warning(message: str) -> None:
    """What the reader must know to rely on the result; --quiet does not hide it, documents repeat it."""
    invocation.notes.append(message)
    _messages().print(f"[yellow]{escape(message)}[/yellow]")


def print_warnings(source: object, messages: Iterable[str]) -> None:
    """What is doubtful in a file or a record."""
    for message in messages:
        print_warning(f"{source}: {message}")


def print_note(message: str) -> None:
    """How the options were understood; documents repeat it."""
    invocation.notes.append(message)
    print_progress(message)


def print_progress(message: str) -> None:
    """A line about what is being done or was written."""
    _messages(quiet=invocation.quiet).print(f"[dim]{escape(message)}[/dim]")


def print_log(name: str, message: str) -> None:
    """A record of the log, with the name of its logger."""
    _messages().print(f"[dim]{escape(name)}:[/dim] {escape(message)}")


def print_traceback() -> None:
    """The traceback of the current exception."""
    _messages().print_exception()


def write(path: Path | None, writer: Callable[[Path], object], remark: str = "") -> None:
    """Write a result if its file was given, and report it.

    Args:
        path: the file, None if its option was not given
        writer: writes the result to a path
        remark: is added to the report
    """
    if path is not None:
        writer(path)
        print_progress(f"wrote {path}{remark}")


def write_plot(path: Path | None, draw: Callable[[], Figure]) -> None:
    """Draw a figure and write it if its file was given, and report it."""
    write(path, lambda file: support.save_figure(draw(), file))


def write_json(path: Path | None, text: Callable[[Sequence[str]], str]) -> None:
    """Write the document of --json if one was wanted.

    All notes must have been printed before: they are in the document.

    Args:
        path: the file; None without the option, and where standard output takes the document
        text: makes the document from the notes
    """
    if invocation.is_piped:
        sys.stdout.write(text(invocation.notes))
    write(path, lambda file: support.write_text(file, text(invocation.notes)))


def note_stops(largest: float, joystick: model.JoystickParameters) -> None:
    """Report an angle (rad) beyond the stops of the real joystick, if the simulated one has none."""
    if largest > _ABOUT * model.STOP_ANGLE and not joystick.stops:
        print_warning(
            f"note: {math.degrees(largest):.4g} degrees are beyond the stops of the paper's joystick at "
            f"about {math.degrees(model.STOP_ANGLE):.0f} degrees; none are set here (stops.theta_stop)"
        )


def _messages(*, quiet: bool = False) -> Console:
    """Standard error."""
    console = Console(stderr=True, highlight=False, quiet=quiet)
    console.soft_wrap = not console.is_terminal
    return console
