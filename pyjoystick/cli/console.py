"""Where the command line writes: results to standard output, everything else to standard error."""

from __future__ import annotations

import os
from typing import Final

from rich.console import Console
from rich.markup import escape

#: Columns for tables where nobody looks on: more than any of them takes.
_UNBOUNDED: Final = 10_000


def output() -> Console:
    """Standard output; where it is no terminal nothing is wrapped or cut short, so that it can be piped."""
    console = Console(highlight=False, soft_wrap=True)
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = _UNBOUNDED
    return console


def messages() -> Console:
    """Standard error."""
    return Console(stderr=True, highlight=False, soft_wrap=True)


def print_error(message: str) -> None:
    """One message on what went wrong."""
    messages().print(f"[bold red]error:[/bold red] {escape(message)}")


def print_note(message: str) -> None:
    """A line on what is being done."""
    messages().print(f"[dim]{escape(message)}[/dim]")


def print_traceback() -> None:
    """Where the present exception comes from."""
    messages().print_exception()
