"""Output of the command line: results to standard output, everything else to standard error."""

from __future__ import annotations

import logging
import math
import os
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from rich.console import Console
from rich.markup import escape

from pyjoystick import fmu, model, support
from pyjoystick.cli.invocation import invocation

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.progress import Progress, ProgressColumn

#: Width of tables outside terminals, wider than any table.
_UNBOUNDED: Final = 10_000
#: Fraction of the paper's stop angle ("about" 20 degrees) above which an angle is beyond the stops.
_ABOUT: Final = 1.05
#: The logger of the module that compiles, by name: loading the module takes long.
_COMPILER: Final = logging.getLogger("pyjoystick.fmu.stepping.compiled")


def output() -> Console:
    """Standard output, or standard error if a document is piped.

    Outside terminals nothing is wrapped or truncated, so that it can be piped.
    """
    from pyjoystick.cli.narrow_tables import NarrowConsole  # not needed for lists of commands

    is_piped = invocation.is_piped
    console = NarrowConsole(
        highlight=False, emoji=False, stderr=is_piped, quiet=is_piped and invocation.quiet
    )
    console.soft_wrap = not console.is_terminal
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _UNBOUNDED
    return console


def progress_console() -> Console:
    """Standard error for moving output: a status, a bar, a table of steps; nothing with --quiet.

    Nothing with --verbose either, because lines of the log would break it up.
    """
    return _messages(quiet=invocation.quiet or invocation.verbose)


def progress_bar(*columns: str | ProgressColumn) -> Progress:
    """Progress bar on standard error that vanishes at its end; drawn only on a terminal."""
    from rich.progress import Progress  # not needed for lists of commands

    console = progress_console()
    return Progress(*columns, console=console, transient=True, disable=not console.is_terminal)


def print_error(message: str) -> None:
    """Print an error."""
    _messages().print(f"[bold red]error:[/bold red] {escape(message)}")


def print_warning(message: str) -> None:
    """Print what a reader must know to rely on the result; shown with --quiet and repeated in documents."""
    invocation.notes.append(message)
    _messages().print(f"[yellow]{escape(message)}[/yellow]")


def print_warnings(source: object, messages: Iterable[str]) -> None:
    """Print warnings about a file or a record."""
    for message in messages:
        print_warning(f"{source}: {message}")


def print_note(message: str) -> None:
    """Print how the options were understood; repeated in documents."""
    invocation.notes.append(message)
    print_progress(message)


def print_progress(message: str) -> None:
    """Print what is being done or was written."""
    _messages(quiet=invocation.quiet).print(f"[dim]{escape(message)}[/dim]")


class _ProgressHandler(logging.Handler):
    """Prints log records as progress lines."""

    def emit(self, record: logging.LogRecord) -> None:
        print_progress(record.getMessage())


@contextmanager
def compilation_announced() -> Iterator[None]:
    """Announce, until the body ends, that the loop of the runs is being compiled: it takes some seconds."""
    handler, before = _ProgressHandler(), _COMPILER.level
    _COMPILER.addHandler(handler)
    _COMPILER.setLevel(logging.INFO)
    try:
        yield
    finally:
        _COMPILER.removeHandler(handler)
        _COMPILER.setLevel(before)


@contextmanager
def warnings_printed() -> Iterator[None]:
    """Print the warnings of runs, until the body ends, as `print_warning` does; each message once."""
    show_others = warnings.showwarning

    def show(message: Warning | str, category: type[Warning], *place: Any, **where: Any) -> None:
        if not issubclass(category, fmu.NotFiniteWarning):
            show_others(message, category, *place, **where)
        elif str(message) not in invocation.notes:
            print_warning(str(message))

    with warnings.catch_warnings():
        warnings.simplefilter("always", fmu.NotFiniteWarning)
        warnings.showwarning = show
        yield


def print_log(name: str, message: str) -> None:
    """Print a log record with the name of its logger."""
    _messages().print(f"[dim]{escape(name)}:[/dim] {escape(message)}")


def print_traceback() -> None:
    """Print the traceback of the current exception."""
    _messages().print_exception()


def write(path: Path | None, writer: Callable[[Path], object], remark: str = "") -> None:
    """Write a result if its file was given, and report it.

    Args:
        path: the file; None if its option was not given
        writer: writes the result to a path
        remark: text to add to the report
    """
    if path is not None:
        writer(path)
        print_progress(f"wrote {path}{remark}")


def write_plot(path: Path | None, draw: Callable[[], Figure]) -> None:
    """Draw a figure and write it if its file was given, and report it."""
    write(path, lambda file: support.save_figure(draw(), file))


def write_json(path: Path | None, text: Callable[[Sequence[str]], str]) -> None:
    """Write the document of --json if it was requested.

    Print all notes before, because the document contains them.

    Args:
        path: the file; None without the option, or if the document goes to standard output
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
    """Console for standard error."""
    console = Console(stderr=True, highlight=False, emoji=False, quiet=quiet)
    console.soft_wrap = not console.is_terminal
    return console
