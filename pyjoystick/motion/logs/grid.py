"""Detection of a table in rows of cells: preamble, headings, units and numbers."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.columns import Heading, TableHead
from pyjoystick.motion.logs.headings import is_unit, meaning, understood
from pyjoystick.motion.logs.row_widths import Misfit, Row, of_one_width, shifted
from pyjoystick.motion.logs.time_cells import NOTHING, clock_of, of_another_kind, plain_numbers
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.stumps import is_cut_short
from pyjoystick.motion.table_files import TableFile, misfit

_NUMBERS: Final = {
    mark: re.compile(rf"[+-]?(\d+{part}|{dot}\d+)([eE][+-]?\d+)?|[+-]?inf(inity)?", re.IGNORECASE)
    for mark, dot, part in ((".", r"\.", r"(\.\d*)?"), (",", ",", r"(,\d+)?"))
}
_THOUSANDS: Final = re.compile(r"[+-]?[1-9]\d{0,2}([.,]\d{3})+")
#: What a wrong delimiter leaves between two cells.
_JOINED: Final = re.compile(r"[-+.,\d]+[;\t|][-+.,\d;\t|]*")
_EMPTY_CELL, _NUMBER_CELL, _TEXT_CELL = range(3)


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A table as read with one delimiter and one decimal mark.

    Attributes:
        delimiter: separator of the cells
        decimal: the decimal mark
        names: rows of headings and units, or of headings alone; empty if the file has none
        rows: the rows of data, all of one width
        empty: numbers of the lines between them without cells, or with a sample that is commented out
        numeric: indices of the columns of numbers
        ragged: number of the first row of data of another width, or with a filled cell under no heading, and
            of its cells; or None
        headed: the number of headings
        faults: non-numeric cells in columns of numbers, and ragged rows
        doubtful: whether every decimal mark may be a thousands separator
        remarks: numbers of the other comment lines between the rows
        stump: a number that was cut short
        surplus: whether every row ends with an empty cell that the headings lack
        again: number of the line of headings, if lines above them are samples under some of the same headings
    """

    delimiter: str
    decimal: str
    names: tuple[Row, ...]
    rows: Sequence[Row]
    empty: tuple[int, ...]
    numeric: tuple[int, ...]
    ragged: Misfit | None
    headed: int
    faults: int
    doubtful: bool
    remarks: tuple[int, ...] = ()
    stump: str = ""
    surplus: bool = False
    again: int | None = None

    def without_stump(self) -> Candidate:
        """The table of a file without an end of its last line; the cell of a number cut short is emptied."""
        number, last = self.rows[-1]
        if not is_cut_short([cells[-1] for _, cells in self.rows]):
            return self
        return replace(self, rows=[*self.rows[:-1], (number, [*last[:-1], ""])], stump=last[-1])

    def _notes(self) -> Iterator[str]:
        if self.stump:
            yield f"the file seems to end within the number {self.stump}, which is left out"
        if self.surplus:
            yield "every row ends with an empty cell beyond the headings: are these above the right columns?"

    def table(self, path: Path, comments: tuple[str, ...]) -> TableFile:
        """The table, with times of day and durations in s.

        Raises:
            RecordError: a row is longer or shorter than the headings
        """
        width = len(self.rows[0][1])
        if self.ragged is not None:
            raise misfit(path, *self.ragged, self.headed)
        if self.again is not None:
            reason = "headings are repeated here, below samples"
            advice = "keep one record a file: cut it before this row"
            raise RecordError(str(path), reason, advice, rows=[self.again])
        units = self.names[1][1] if len(self.names) > 1 else [""] * width
        texts = self.names[0][1] if self.names else [""] * width
        headings = _headings(texts, units)
        columns = [list(column) for column in zip(*(cells for _, cells in self.rows), strict=True)]
        for i in self.numeric:
            others = of_another_kind(columns[i])
            if others:
                raise RecordError(
                    str(path),
                    "has other cells than the rest: times of day, dates, durations and numbers do not mix",
                    "give all cells of the column the same format",
                    column=headings[i].text,
                    rows=[self.rows[row][0] for row in others],
                )
            columns[i], is_clock = plain_numbers(columns[i])
            if is_clock:
                columns[i] = [cell.replace(".", self.decimal) for cell in columns[i]]
                headings[i] = Heading(headings[i].text, headings[i].name, "s")
        line = self.names[-1][0] if self.names else 0
        rows = np.array([number for number, _ in self.rows], dtype=np.int64)
        head = TableHead(path, tuple(headings), self.delimiter, line)
        return TableFile(
            head,
            comments,
            tuple(zip(*columns, strict=True)),
            rows,
            empty=self.empty,
            decimal=self.decimal,
            stump=self.stump,
            remarks=self.remarks,
            notes=tuple(self._notes()),
        )


def find_table(
    rows: Sequence[Row], remarks: Sequence[Row], delimiter: str, decimal: str, *, is_given: bool = False
) -> Candidate | None:
    """Find the table in rows of cells; None if there is none with at least two columns of numbers.

    Args:
        rows: the lines; rows of empty cells between the numbers are samples, elsewhere they are skipped
        remarks: the comment lines; the one before the numbers may contain their headings
        delimiter: separator of the cells
        decimal: the decimal mark
        is_given: whether the decimal mark is certain
    """
    width, empty, longer, rows = of_one_width(rows)
    fitting = [i for i, (_, cells) in enumerate(rows) if len(cells) == width]
    kinds = np.array([[_kind(cell, decimal) for cell in rows[i][1]] for i in fitting], dtype=np.int8)
    if width < 2 or len(fitting) < 2:
        return None
    numeric = (kinds == _NUMBER_CELL).sum(axis=0) > (kinds == _TEXT_CELL).sum(axis=0)
    bad = kinds[:, numeric] == _TEXT_CELL
    is_data = ~bad.any(axis=1) & (kinds[:, numeric] == _NUMBER_CELL).any(axis=1)
    starts = np.flatnonzero(is_data[:-1] & is_data[1:])
    if numeric.sum() < 2 or not starts.size:
        return None
    start = _with_missing_before(kinds, rows, fitting, int(starts[0]))
    first = fitting[start]
    data = [rows[i] for i in fitting[start:]]
    samples = [cells for _, cells in data if any(cells)]
    if any(all(_JOINED.fullmatch(cells[i]) for cells in samples) for i in np.flatnonzero(~numeric)):
        return None
    above = [row for row in rows[:first] if any(row[1])]
    names = _names(above, [row for row in remarks if row[0] < rows[first][0]], width)
    if names is None:
        return None
    used = [i for i in range(width) if any(cells[i] for _, cells in (*names[:1], *data))]
    ragged = [
        (number, longer.get(number, len(cells)))
        for number, cells in rows[first:]
        if len(cells) != width or number in longer
    ]
    # In a sheet, a column has its place even without a heading.
    headings = dict([*rows, *remarks])[names[0][0]] if names and delimiter else [" "] * width
    headed, unheaded = shifted(data, headings, may_be_commas=delimiter == "," and not is_given)
    columns = [i for i in used if numeric[i]]
    marked = [
        cells[i] for _, cells in data for i in columns if decimal in cells[i] and not clock_of(cells[i])
    ]
    lost = [number for number, cells in remarks if _is_sample(cells, width, columns, decimal)]
    inside = range(data[0][0], data[-1][0])
    return Candidate(
        delimiter,
        decimal,
        tuple((number, [cells[i] for i in used]) for number, cells in names),
        [(number, [cells[i] for i in used]) for number, cells in data],
        tuple(number for number in sorted([*empty, *lost]) if number in inside),
        tuple(used.index(i) for i in columns),
        min([*ragged[:1], *unheaded[:1]], default=None),
        headed if unheaded else len(used),
        int(bad[start:].sum()) + len(ragged) + len(unheaded),
        bool(marked) and all(map(is_thousands, marked)),
        tuple(number for number, _ in remarks if number in inside and number not in lost),
        surplus=len(headings) < width,
        again=_repeated(above, names, decimal),
    )


def _repeated(above: Sequence[Row], names: Sequence[Row], decimal: str) -> int | None:
    """Return the number of the line of headings if some of them stand above other numbers before."""
    if not names:
        return None
    number, headings = names[0]
    before = [cells for row, cells in above if row < number]
    for i, cells in enumerate(before):
        below = before[i + 1 : i + 3]  # one may be a row of units
        shared = {cell for cell in cells if cell} & set(headings)
        if shared and any(_is_all_numbers(one, decimal) for one in below):
            return number
    return None


def _is_all_numbers(cells: Sequence[str], decimal: str) -> bool:
    filled = [cell for cell in cells if cell]
    return len(filled) > 1 and all(_kind(cell, decimal) == _NUMBER_CELL for cell in filled)


def _is_sample(cells: Sequence[str], width: int, numeric: Sequence[int], decimal: str) -> bool:
    """Whether the cells of a comment are those of a row of data."""
    return len(cells) == width and all(_kind(cells[i], decimal) == _NUMBER_CELL for i in numeric)


def _with_missing_before(
    kinds: NDArray[np.int8], rows: Sequence[Row], fitting: Sequence[int], start: int
) -> int:
    """Start of the samples including the first ones, if these are missing: NaN or NA in every cell.

    Before these, dashes in every cell are units, and rows of empty cells are skipped.
    """
    first = start
    while start and (kinds[start - 1] == _EMPTY_CELL).all():
        start -= 1
        if any(cell.strip("-") for cell in rows[fitting[start]][1]):
            first = start
    return first


def _kind(cell: str, decimal: str) -> int:
    if _NUMBERS[decimal].fullmatch(cell):
        return _NUMBER_CELL
    if cell.casefold() in NOTHING:
        return _EMPTY_CELL
    return _NUMBER_CELL if clock_of(cell) else _TEXT_CELL


def _names(above: Sequence[Row], remarks: Sequence[Row], width: int) -> tuple[Row, ...] | None:
    """Row of headings and, optionally, of units; empty if there is nothing above the numbers.

    Returns None if the lines above do not match the numbers.
    """
    last = [(number, cells + [""] * (width - len(cells))) for number, cells in above[-2:]]
    if not above:
        headed = [row for row in remarks[-1:] if _is_heading(row[1], width)]
        return tuple(headed)
    if not _is_heading(last[-1][1], width) and not _is_units(last[-1][1]):
        return None
    if len(last) == 2 and _is_units(last[1][1]) and _is_heading(last[0][1], width):
        return last[0], last[1]
    return (last[-1],) if _is_heading(last[-1][1], width) and len(above[-1][1]) >= width - 1 else None


def _is_heading(cells: Sequence[str], width: int) -> bool:
    filled = [cell for cell in cells if cell]
    is_text = all(_kind(cell, mark) == _TEXT_CELL for cell in filled for mark in ".,")
    return len(cells) == width and len(filled) >= 2 and is_text


def _is_units(cells: Sequence[str]) -> bool:
    """Whether the cells may be units, in brackets or not; headings with units of their own are none."""
    filled = [cell.strip("[](){}<> ") for cell in cells if cell.strip("-[](){}<> ")]
    may_be = any(map(is_unit, filled)) and all(len(cell) <= 8 for cell in filled)
    return may_be and not any(map(_is_name_with_unit, cells))


def _is_name_with_unit(cell: str) -> bool:
    """Whether a cell is ``Time(s)`` or ``t/s`` rather than ``(s)`` or ``m/s``."""
    heading = understood(cell)
    return is_unit(heading.unit) and meaning(heading.name) is not None


def _headings(texts: Sequence[str], units: Sequence[str]) -> list[Heading]:
    """Headings with their units; missing or duplicate ones are numbered."""
    joined = [
        f"{text} [{unit.strip('[](){}<> ')}]" if unit.strip("-[](){}<> ") else text
        for text, unit in zip(texts, units, strict=True)
    ]
    found = [understood(text, joined) for text in joined]
    counts = Counter(joined)
    for i, heading in enumerate(found):
        if not heading.text:
            found[i] = Heading(f"#{i + 1}", f"#{i + 1}", heading.unit)
        elif counts[heading.text] > 1:
            found[i] = Heading(f"{heading.text} #{i + 1}", heading.name, heading.unit)
    return found


def is_thousands(cell: object) -> bool:
    """Whether a cell is a text whose decimal mark, if it is one, may separate thousands."""
    return isinstance(cell, str) and _THOUSANDS.fullmatch(cell) is not None
