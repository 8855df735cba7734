"""Where the command line writes: results to standard output, everything else to standard error."""

from __future__ import annotations

from rich.console import Console
from rich.markup import escape


def output() -> Console:
    """Standard output, wrapped nowhere so that it can be piped."""
    return Console(highlight=False, soft_wrap=True)


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
