"""Rows of one width, and rows whose cells are shifted against their headings."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from typing import Final

from pyjoystick.motion.logs.headings import meaning, understood
from pyjoystick.support import is_number_text

#: A line number and its cells.
Row = tuple[int, list[str]]
#: The number of a row that does not fit its headings, and of its cells.
Misfit = tuple[int, int]

_UNNAMED: Final = re.compile(r"Unnamed: \d+")
_WHOLE: Final = re.compile(r"[+-]?\d+")
_DIGITS: Final = re.compile(r"\d+([eE][+-]?\d+)?")


def of_one_width(rows: Sequence[Row]) -> tuple[int, list[int], dict[int, int], list[Row]]:
    """The usual width of a row, and the other rows fitted to this width.

    Rows without a filled cell at the end are dropped.

    Returns:
        width; numbers of the empty lines; cells by row of those with more than the width; rows
    """
    filled = [i for i, (_, cells) in enumerate(rows) if any(cells)]
    if not filled:
        return 0, [], {}, []
    width = Counter(len(rows[i][1]) for i in filled).most_common(1)[0][0]
    rows = rows[: filled[-1] + 1]
    empty = [number for number, cells in rows if not any(cells) and len(cells) < 2]
    longer = {number: len(cells) for number, cells in rows if any(cells) and len(cells) > width}
    return (
        width,
        empty,
        longer,
        [(number, _fitted(cells, width)) for number, cells in rows if any(cells) or len(cells) > 1],
    )


def _fitted(cells: list[str], width: int) -> list[str]:
    """A row without the empty cells beyond the usual width; one of empty cells has exactly this width."""
    if not any(cells):
        return [""] * width
    return cells if any(cells[width:]) else cells[:width]


def shifted(data: Sequence[Row], headings: Sequence[str], *, may_be_commas: bool) -> tuple[int, list[Misfit]]:
    """Find rows with filled cells under no heading, or whose cells may be shifted under the headings.

    An empty cell behind every row is mostly harmless; decimal commas between commas, and numbers of rows
    before the first column, shift the others.

    Args:
        data: the rows of data, all of one width
        headings: the row of headings, which may be shorter
        may_be_commas: whether decimal commas may be among the commas that separate the cells

    Returns:
        the number of headings, and the rows
    """
    width, headed = len(data[0][1]), _headed_columns(headings)
    is_short = len(headings) < width
    found = [
        (number, width)
        for number, cells in data
        if any(is_short or _DIGITS.search(cell) for cell in cells[headed:] if cell)
    ]
    samples = [cells for _, cells in data if any(cells)]
    if is_short and may_be_commas and not found and _may_have_decimal_commas(samples, headings[-1]):
        found = [(data[0][0], width)]
    return headed, found


def _headed_columns(headings: Sequence[str]) -> int:
    """Number of columns up to the last one with a heading; pandas calls one without ``Unnamed: 3``."""
    return max(i + 1 for i, cell in enumerate(headings) if cell and not _UNNAMED.fullmatch(cell))


def _may_have_decimal_commas(rows: Sequence[list[str]], last: str) -> bool:
    """Whether two neighboring cells may be a number with a decimal comma, in all rows between commas.

    The last column is then empty, and no number has a point.
    """
    heading = understood(last)
    if (
        heading.unit
        or meaning(heading.name)
        or any("." in cell and is_number_text(cell) for cells in rows for cell in cells)
    ):
        return False
    pairs = ([(cells[i], cells[i + 1]) for cells in rows] for i in range(len(rows[0]) - 1))
    return any(
        all(_WHOLE.fullmatch(before) and _DIGITS.fullmatch(behind) for before, behind in pair)
        for pair in pairs
    )
