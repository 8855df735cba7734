"""Array positions as affine functions of loop variables."""

from __future__ import annotations

from itertools import product

import pytest

from fmu_build.codegen.functions.index import Index, LoopVariable, flat, positions

ROW, COLUMN = LoopVariable("i", 1, 4), LoopVariable("j", 2, 3)


@pytest.mark.parametrize(
    ("index", "text"),
    [
        (Index(3), "3"),
        (Index.of(ROW), "i"),
        (Index.of(ROW) + -1, "i - 1"),
        (Index.of(ROW) * -2 + 8, "-2 * i + 8"),
        (Index.of(ROW) * 3 + Index.of(COLUMN) + -4, "3 * i + j - 4"),
        (Index.of(ROW) + Index.of(COLUMN) * -1, "i - j"),
        (Index.of(ROW) + Index.of(ROW) * -1 + 2, "2"),
        (Index.of(ROW) * 0, "0"),
    ],
)
def test_text(index: Index, text: str) -> None:
    assert index.text() == text


@pytest.mark.parametrize("size", range(8))
@pytest.mark.parametrize(("a", "b", "c"), [(1, 0, -1), (1, 1, -3), (-1, 0, 4), (1, -1, 2), (0, 0, 3)])
def test_bounds_are_those_of_all_turns(a: int, b: int, c: int, size: int) -> None:
    index = Index.of(ROW) * a + Index.of(COLUMN) * b + c
    turns = product(range(ROW.minimum, ROW.maximum + 1), range(COLUMN.minimum, COLUMN.maximum + 1))
    assert index.lies_in(size) == all(0 <= a * i + b * j + c < size for i, j in turns)


def test_elements_follow_each_other_row_by_row() -> None:
    places = [flat(position, (2, 3, 4)).constant for position in positions((2, 3, 4))]
    assert places == list(range(24))
