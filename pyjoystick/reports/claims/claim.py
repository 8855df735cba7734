"""A statement of the paper that can be checked, and what comes out here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from pyjoystick.reports.claims.workbench import Workbench


class Verdict(StrEnum):
    """How a statement fares."""

    AGREES = "agrees"
    IN_PART = "in part"
    DISAGREES = "disagrees"
    OPEN = "cannot be checked"
    SILENT = "silent"


@dataclass(frozen=True, slots=True)
class Finding:
    """What comes out for one statement.

    Attributes:
        verdict: how the statement fares, decided by `numbers`
        here: what we get, numbers and words
        remark: why it does not agree, or what is to be known besides
    """

    verdict: Verdict
    here: str
    remark: str = ""


@dataclass(frozen=True, slots=True)
class Claim:
    """A statement and the function that checks it.

    Attributes:
        where: section, figure, table or equation of the paper
        statement: what it says, in our words
        check: gives the finding from the runs of a workbench
    """

    where: str
    statement: str
    check: Callable[[Workbench], Finding]


def claim(where: str, statement: str) -> Callable[[Callable[[Workbench], Finding]], Claim]:
    """Decorator that makes a claim of the function that checks it."""
    return lambda check: Claim(where, statement, check)


def verdict(agrees: bool, in_part: bool = False) -> Verdict:
    """The verdict of what numbers say: fully, in part, or not."""
    if agrees:
        return Verdict.AGREES
    return Verdict.IN_PART if in_part else Verdict.DISAGREES
