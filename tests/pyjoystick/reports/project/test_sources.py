"""The origin of numbers, in the tables of a parameter file."""

from __future__ import annotations

from pyjoystick.model import NOMINAL, PAPER
from pyjoystick.reports.project.sources import table_sources


def test_what_was_not_measured_keeps_its_source() -> None:
    """The length of the handle too, which is no parameter of the motion."""
    paper = PAPER.sources["geometry"]
    found = table_sources({"a": "drawing 7"}, NOMINAL, PAPER)
    assert found == {"geometry": f"a: drawing 7; b, pivot_to_top: {paper}"}
    every = dict.fromkeys(("a", "b", "pivot_to_top"), "drawing 7")
    assert table_sources(every, NOMINAL, PAPER) == {"geometry": "drawing 7"}
