"""The outcome of fuzzing."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Outcome:
    """What came of one target.

    Attributes:
        target: what was fuzzed
        executions: how many inputs were tried
        fault: the faults that were found; empty if there are none
    """

    target: str
    executions: int
    fault: str
