"""The claims as a page in Markdown."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Final

from pyjoystick.reports.claims import damping, energy, oscillation, springs, torque
from pyjoystick.reports.claims.claim import Claim, Finding, Verdict, Workbench
from pyjoystick.support import Shown

CHAPTERS: Final[Mapping[str, Sequence[Claim]]] = {
    "Free oscillation": oscillation.CLAIMS,
    "Geometry and springs": springs.CLAIMS,
    "Damping": damping.CLAIMS,
    "Energy and measuring chain": energy.CLAIMS,
    "Torque": torque.CLAIMS,
}
_INTRODUCTION: Final = """\
# The paper's claims, checked

<!-- Made by `make claims`; a test compares it with what the program gives today. Edit its source. -->

This page lists every statement of Rogers, Garland and Oliver (J. Sound Vib. 274 (2004) 73-89) that the model
can check, in our words, beside our result for the joystick of Tables 1 and 2. Unless stated otherwise, the
joystick is released from rest at -20 degrees, eq. (11) is taken at alpha = 0.9, and the constant is
C = 0.045 N m s/rad.

For each line, a small function in `pyjoystick/reports/claims/` computes the numbers and derives the verdict
from them. `make claims` writes the page, and a test keeps it up to date.
"""


class Findings(dict[str, list[tuple[Claim, Finding]]], Shown):
    """Claims and their findings, by chapter, in order."""

    _shown_by = "pyjoystick.reports.claims.notebook"


def findings(bench: Workbench | None = None) -> Findings:
    """Check every claim; by chapter, in order."""
    used = Workbench() if bench is None else bench
    return Findings(
        {chapter: [(one, one.check(used)) for one in claims] for chapter, claims in CHAPTERS.items()}
    )


def claims_page(found: Mapping[str, Sequence[tuple[Claim, Finding]]]) -> str:
    """The page: an introduction, the number of claims by verdict, and a table per chapter."""
    counted = Counter(finding.verdict for chapter in found.values() for _, finding in chapter)
    total = ", ".join(f"{one} {counted[one]}" for one in Verdict if counted[one])
    parts = [_INTRODUCTION, f"Of {counted.total()} statements: {total}.\n"]
    for chapter, rows in found.items():
        lines = [f"## {chapter}", "", "| where | the paper | here | verdict |", "|---|---|---|---|"]
        lines += [
            f"| {claim.where} | {_cell(claim.statement)} | {text_of(finding)} | **{finding.verdict}** |"
            for claim, finding in rows
        ]
        parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


def text_of(finding: Finding) -> str:
    """The result with its remark, for a cell."""
    return _cell(finding.text)


def _cell(text: str) -> str:
    """Escape text for a cell: a bar would end it, and two products would be emphasis."""
    return re.sub(r"[|*]", r"\\\g<0>", text)
