"""One call of the command line: the options before the command, and what it has noted so far."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import Final

#: Exit code after Ctrl-C, as in shells.
INTERRUPTED: Final = 130


@dataclass
class Invocation:
    """What holds from the options to the exit code.

    Attributes:
        debug: show the traceback of an error
        implausible: take values that no joystick has
        quiet: no progress and no notes on standard error
        verbose: a log on standard error
        is_piped: ``--json -``: standard output is for the document alone
        notes: what was noted on the result, which documents repeat
    """

    debug: bool = False
    implausible: bool = False
    quiet: bool = False
    verbose: bool = False
    is_piped: bool = False
    notes: list[str] = field(default_factory=list)

    def begin(self) -> None:
        """As at the start of the program, also for a second call in one process."""
        for name, value in dataclasses.asdict(Invocation()).items():
            setattr(self, name, value)


invocation = Invocation()
