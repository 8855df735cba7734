"""The page of claims matches the program's current output, and its verdicts follow from the numbers."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from pyjoystick.model import NOMINAL
from pyjoystick.reports import CHAPTERS, Claim, Finding, Verdict, Workbench, claims_page, findings, text_of
from pyjoystick.reports.claims import oscillation, springs

PAGE = Path(__file__).parents[4] / "docs" / "claims.md"
_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\w)")

Found = dict[str, list[tuple[Claim, Finding]]]


@pytest.fixture(scope="module")
def bench() -> Workbench:
    return Workbench()


@pytest.fixture(scope="module")
def found(joystick_fmus: Path, bench: Workbench) -> Found:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("pyjoystick.fmu.files.build_folder", lambda: joystick_fmus)
        return findings(bench)


def test_the_page_is_what_comes_out_today(found: Found) -> None:
    """Words are the same, and numbers are but for one unit of their last digit."""
    committed, today = PAGE.read_text(encoding="utf-8"), claims_page(found)
    assert _NUMBER.sub("#", today) == _NUMBER.sub("#", committed), (
        "run `make claims` and look at what changed"
    )
    for ours, theirs in zip(_NUMBER.findall(today), _NUMBER.findall(committed), strict=True):
        assert abs(float(ours) - float(theirs)) <= 1.01 * _last_digit(theirs), f"{theirs} is now {ours}"


def _last_digit(number: str) -> float:
    mantissa, _, power = number.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return float(f"1e{int(power or 0) - decimals}")


def test_every_statement_is_there_once(found: Found) -> None:
    rows = [claim.statement for chapter in CHAPTERS.values() for claim in chapter]
    assert len(rows) == len(set(rows)) >= 40
    assert [claim.statement for chapter in found.values() for claim, _ in chapter] == rows


def test_what_the_paper_has_wrong_is_called_so(found: Found) -> None:
    verdicts = {
        claim.where + claim.statement[:12]: one.verdict for rows in found.values() for claim, one in rows
    }
    assert verdicts["eq. (5)M_s = {a*(si"] is Verdict.DISAGREES
    assert verdicts["3.3, Fig. 9the lines ha"] is Verdict.IN_PART
    assert verdicts["3, Table 2(the acceler"] is Verdict.SILENT


def test_a_row_is_one_line_of_four_cells(found: Found) -> None:
    for line in claims_page(found).splitlines():
        if line.startswith("| "):
            assert len(re.findall(r"(?<!\\)\|", line)) == 5, line


def test_the_verdict_follows_the_joystick(monkeypatch: pytest.MonkeyPatch, bench: Workbench) -> None:
    """Another joystick, other verdicts: nothing is decided beforehand."""
    assert oscillation.clearance.check(bench).verdict is Verdict.IN_PART
    without = {f"{side}.returnSpring.x_0": 1e-9 for side in ("forward", "backward")}
    monkeypatch.setattr(oscillation, "NOMINAL", NOMINAL.replace(without))
    assert oscillation.clearance.check(bench).verdict is Verdict.AGREES
    assert springs.contact_moment_as_printed.check(bench).verdict is Verdict.DISAGREES
    monkeypatch.setattr(springs, "NOMINAL", NOMINAL.replace({"a": 1.0, "b": 0.0}))
    assert springs.contact_moment_as_printed.check(bench).verdict is Verdict.AGREES


def test_a_bar_does_not_end_a_cell() -> None:
    assert text_of(Finding(Verdict.AGREES, "|x|", "Why")) == "\\|x\\|. Why."
