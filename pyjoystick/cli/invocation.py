"""State of one call of the command line: global options and notes."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import Final

#: Exit code after Ctrl-C, as in shells.
INTERRUPTED: Final = 130


@dataclass
class Invocation:
    """State from the global options to the exit code.

    Attributes:
        debug: show tracebacks of errors
        implausible: accept implausible values
        quiet: no progress and no notes on standard error
        verbose: log to standard error
        is_piped: ``--json -``: only the document goes to standard output
        notes: notes on the result, which documents repeat
    """

    debug: bool = False
    implausible: bool = False
    quiet: bool = False
    verbose: bool = False
    is_piped: bool = False
    notes: list[str] = field(default_factory=list)

    def begin(self) -> None:
        """Reset to the initial state, also for a second call in one process."""
        for name, value in dataclasses.asdict(Invocation()).items():
            setattr(self, name, value)


invocation = Invocation()
