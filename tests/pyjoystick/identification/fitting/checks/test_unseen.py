"""Effects that a passed test may miss, on linear problems with formulas."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from pyjoystick.identification import Free
from pyjoystick.identification.fitting.checks.suspect import Suspect
from pyjoystick.identification.fitting.checks.unseen import Unseen, unseen
from pyjoystick.support import FloatArray
from tests.pyjoystick.identification.fitting.made import linear_problem

#: Two variables with columns at right angles, of lengths 3 and 2, and a third direction.
MATRIX = np.array([[3.0, 0.0], [0.0, 2.0], [0.0, 0.0], [0.0, 0.0]])
X = np.array([5.0, 7.0])
LEVEL, USUAL = 0.01, 0.05
#: Of a normal number: seen at the level in nine cases of ten.
SEEN = 2.5758293 + 1.2815516


def _unseen(*found: Suspect) -> list[Unseen]:
    free = (Free("J", start=1.0), Free("m", start=1.0))
    problem = linear_problem([MATRIX], [MATRIX @ X], free)
    return unseen(problem, X, MATRIX, found, LEVEL, USUAL)


def _suspect(name: str, *column: float, alternatives: int = 1, own: bool = False) -> Suspect:
    def says(sizes: FloatArray) -> str:
        return f"{sizes[0]:.6f}"

    return Suspect(name, (np.array(column)[:, np.newaxis],), says, own=own, alternatives=alternatives)


def test_the_size_that_is_seen_and_what_it_moves(fmus_by_name: Path) -> None:
    """The column (4, 1, 0.5, 0) has a rest of 0.5; its size moves J by 4/3 of it, eight parts of the rest."""
    assert pytest.approx(float(stats.norm.isf(LEVEL / 2.0) + stats.norm.ppf(0.9))) == SEEN
    (found,) = _unseen(_suspect("drift", 4.0, 1.0, 0.5, 0.0))
    size = SEEN / 0.5
    assert (found.suspect, found.parameter) == ("drift", "J")
    assert float(found.size) == pytest.approx(size, rel=1e-6)
    # The standard error of J is 1/3.
    assert found.errors == pytest.approx(4.0 * size)
    assert found.part == pytest.approx(4.0 / 3.0 * size / X[0])


def test_usual_suspects_are_seen_at_a_smaller_size(fmus_by_name: Path) -> None:
    (found,) = _unseen(replace(_suspect("friction", 4.0, 1.0, 0.5, 0.0), usual=True))
    size = (1.9599640 + 1.2815516) / 0.5
    assert float(found.size) == pytest.approx(size, rel=1e-6)


def test_the_variable_that_moves_most_is_named_and_the_worst_comes_first(fmus_by_name: Path) -> None:
    found = _unseen(_suspect("little", 1.5, -2.0, 1.0, 0.0), _suspect("much", 9.0, 0.0, 1.0, 0.0))
    assert [(one.suspect, one.parameter) for one in found] == [("much", "J"), ("little", "m")]
    assert found[1].part == pytest.approx(2.0 / 2.0 * SEEN / X[1])


def test_what_moves_less_than_three_errors_is_not_named(fmus_by_name: Path) -> None:
    assert SEEN * 0.7 < 3.0 < SEEN * 0.8
    found = _unseen(_suspect("less", 0.7, 0.0, 1.0, 0.0), _suspect("more", 0.8, 0.0, 1.0, 0.0))
    assert [one.suspect for one in found] == ["more"]


def test_what_cannot_be_told_from_the_variables_has_no_size_that_is_seen(fmus_by_name: Path) -> None:
    """The score test does not judge rests below a hundredth of the column."""
    found = _unseen(_suspect("like J", 1.0, 0.0, 0.008, 0.0), _suspect("nearly", 1.0, 0.0, 0.012, 0.0))
    assert [one.suspect for one in found] == ["nearly"]


def test_only_suspects_of_one_size_are_judged(fmus_by_name: Path) -> None:
    several = Suspect("two sizes", (np.eye(4)[:, [0, 2]] + np.eye(4)[:, [2, 3]],))
    by_record = _suspect("by record", 4.0, 1.0, 0.5, 0.0, own=True)
    one_of_three = _suspect("one of three", 4.0, 1.0, 0.5, 0.0, alternatives=3)
    assert _unseen(several, by_record, one_of_three) == []
