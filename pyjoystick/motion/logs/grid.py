"""Detection of a table in rows of cells: preamble, headings, units and numbers."""

from __future__ import annotations

import datetime
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.columns import Heading, TableHead
from pyjoystick.motion.logs.headings import is_unit, understood
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.table_files import EMPTY, TableFile

#: A line number and its cells.
Row = tuple[int, list[str]]

_NUMBERS: Final = {
    mark: re.compile(rf"[+-]?(\d+{part}|{dot}\d+)([eE][+-]?\d+)?|[+-]?inf(inity)?", re.IGNORECASE)
    for mark, dot, part in ((".", r"\.", r"(\.\d*)?"), (",", ",", r"(,\d+)?"))
}
_CLOCK: Final = re.compile(
    r"(?:(?P<date>\d{4}-\d\d-\d\d)[T ])?(?P<h>\d{1,2}):(?P<m>\d\d):(?P<s>\d\d(?:[.,]\d+)?)"
    r"(?P<zone>Z|[+-]\d\d:?\d\d)?"
    r"|(?P<m2>\d{1,3}):(?P<s2>\d\d[.,]\d+)"
    r"|PT(?P<duration>-?\d+\.\d+)S"
)
_SECOND: Final = datetime.timedelta(seconds=1)
_THOUSANDS: Final = re.compile(r"[+-]?[1-9]\d{0,2}([.,]\d{3})+")
#: What a wrong delimiter leaves between two cells.
_JOINED: Final = re.compile(r"[-+.,\d]+[;\t|][-+.,\d;\t|]*")
_DIGIT: Final = re.compile(r"\d")
_UNNAMED: Final = re.compile(r"Unnamed: \d+")
_ERRORS: Final = ("#n/a", "#nv", "#div/0!", "#num!", "#value!", "nat", "<na>")
_NOTHING: Final = (*EMPTY, *_ERRORS)
_EMPTY_CELL, _NUMBER_CELL, _TEXT_CELL = range(3)


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A table as read with one delimiter and one decimal mark.

    Attributes:
        delimiter: separator of the cells
        decimal: the decimal mark
        names: rows of headings and units, or of headings alone; empty if the file has none
        rows: the rows of data, all of one width
        empty: numbers of the empty lines between them, which have no cells
        numeric: indices of the columns of numbers
        ragged: the first row of data of another width, or with a number under no heading; or None
        headed: the number of headings
        faults: non-numeric cells in columns of numbers, and ragged rows
        doubtful: whether every decimal mark may be a thousands separator
    """

    delimiter: str
    decimal: str
    names: tuple[Row, ...]
    rows: Sequence[Row]
    empty: tuple[int, ...]
    numeric: tuple[int, ...]
    ragged: Row | None
    headed: int
    faults: int
    doubtful: bool

    def table(self, path: Path, comments: tuple[str, ...]) -> TableFile:
        """The table, with decimal points in its numbers, and times of day and durations in s.

        Raises:
            RecordError: a row is longer or shorter than the headings
        """
        width = len(self.rows[0][1])
        if self.ragged is not None:
            number, cells = self.ragged
            advice = "was the file cut off, or are the decimal marks commas?"
            reason = f"has {len(cells)} cells under {self.headed} headings"
            raise RecordError(str(path), reason, advice, rows=[number])
        units = self.names[1][1] if len(self.names) > 1 else [""] * width
        texts = self.names[0][1] if self.names else [""] * width
        headings = _headings(texts, units)
        columns = [list(column) for column in zip(*(cells for _, cells in self.rows), strict=True)]
        for i in self.numeric:
            others = _of_another_kind(columns[i])
            if others:
                raise RecordError(
                    str(path),
                    "has other cells than the rest: times of day, dates, durations and numbers do not mix",
                    "give all cells of the column the same format",
                    column=headings[i].text,
                    rows=[self.rows[row][0] for row in others],
                )
            columns[i], is_clock = _plain_numbers(columns[i], self.decimal)
            if is_clock:
                headings[i] = Heading(headings[i].text, headings[i].name, "s")
        line = self.names[-1][0] if self.names else 0
        rows = np.array([number for number, _ in self.rows], dtype=np.int64)
        head = TableHead(path, tuple(headings), self.delimiter, line)
        return TableFile(head, comments, tuple(zip(*columns, strict=True)), rows, self.empty)


def find_table(rows: Sequence[Row], remarks: Sequence[Row], delimiter: str, decimal: str) -> Candidate | None:
    """Find the table in rows of cells; None if there is none with at least two columns of numbers.

    Args:
        rows: the lines; rows of empty cells between the numbers are samples, elsewhere they are skipped
        remarks: the comment lines; the one before the numbers may contain their headings
        delimiter: separator of the cells
        decimal: the decimal mark
    """
    width, empty, rows = _of_one_width(rows)
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
    ragged = [row for row in rows[first:] if len(row[1]) != width]
    # In a sheet, a column has its place even without a heading.
    headed = _headed_columns(names[0][1]) if names and delimiter else width
    unheaded = [row for row in data if any(map(_DIGIT.search, row[1][headed:]))]
    columns = [i for i in used if numeric[i]]
    marked = [
        cells[i]
        for _, cells in data
        for i in columns
        if decimal in cells[i] and not _CLOCK.fullmatch(cells[i])
    ]
    return Candidate(
        delimiter,
        decimal,
        tuple((number, [cells[i] for i in used]) for number, cells in names),
        [(number, [cells[i] for i in used]) for number, cells in data],
        tuple(number for number in empty if data[0][0] < number < data[-1][0]),
        tuple(used.index(i) for i in columns),
        min([*ragged[:1], *unheaded[:1]], default=None),
        headed if unheaded else len(used),
        int(bad[start:].sum()) + len(ragged) + len(unheaded),
        bool(marked) and all(_THOUSANDS.fullmatch(cell) for cell in marked),
    )


def _of_one_width(rows: Sequence[Row]) -> tuple[int, list[int], list[Row]]:
    """The usual width of a row, the numbers of the empty lines, and the other rows fitted to this width.

    Rows without a filled cell at the end are dropped.
    """
    filled = [i for i, (_, cells) in enumerate(rows) if any(cells)]
    if not filled:
        return 0, [], []
    width = Counter(len(rows[i][1]) for i in filled).most_common(1)[0][0]
    rows = rows[: filled[-1] + 1]
    empty = [number for number, cells in rows if not any(cells) and len(cells) < 2]
    return (
        width,
        empty,
        [(number, _fitted(cells, width)) for number, cells in rows if any(cells) or len(cells) > 1],
    )


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


def _fitted(cells: list[str], width: int) -> list[str]:
    """A row without the empty cells beyond the usual width; one of empty cells has exactly this width."""
    if not any(cells):
        return [""] * width
    return cells if any(cells[width:]) else cells[:width]


def _kind(cell: str, decimal: str) -> int:
    if _NUMBERS[decimal].fullmatch(cell):
        return _NUMBER_CELL
    if cell.casefold() in _NOTHING:
        return _EMPTY_CELL
    return _NUMBER_CELL if _CLOCK.fullmatch(cell) else _TEXT_CELL


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


def _headed_columns(headings: Sequence[str]) -> int:
    """Number of columns up to the last one with a heading; pandas calls one without ``Unnamed: 3``."""
    return max(i + 1 for i, cell in enumerate(headings) if cell and not _UNNAMED.fullmatch(cell))


def _is_heading(cells: Sequence[str], width: int) -> bool:
    filled = [cell for cell in cells if cell]
    is_text = all(_kind(cell, mark) == _TEXT_CELL for cell in filled for mark in ".,")
    return len(cells) == width and len(filled) >= 2 and is_text


def _is_units(cells: Sequence[str]) -> bool:
    filled = [cell.strip("[](){}<> ") for cell in cells if cell.strip("-[](){}<> ")]
    return any(map(is_unit, filled)) and all(len(cell) <= 8 for cell in filled)


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


def _of_another_kind(cells: Sequence[str]) -> list[int]:
    """Indices of the cells of another kind than most, if a column has times of day, dates or durations."""
    kinds = {i: _kind_of_time(cell) for i, cell in enumerate(cells) if cell.casefold() not in _NOTHING}
    if not any(kinds.values()):
        return []
    usual, _ = Counter(kinds.values()).most_common(1)[0]
    return [i for i, kind in kinds.items() if kind != usual]


def _kind_of_time(cell: str) -> str:
    """Kind of a time of day, date or duration; empty for other cells."""
    match = _CLOCK.fullmatch(cell)
    if match is None:
        return ""
    return "duration" if match["duration"] else "date" if match["date"] else "clock"


def _plain_numbers(cells: Sequence[str], decimal: str) -> tuple[list[str], bool]:
    """Numbers with decimal points, and whether they are times of day or durations, converted to s."""
    matches = [_CLOCK.fullmatch(cell) for cell in cells]
    if not any(matches):
        return ["" if cell.casefold() in _ERRORS else cell.replace(decimal, ".") for cell in cells], False
    first = next(match for match in matches if match)
    return [
        _seconds(match, first) if match else cell for match, cell in zip(matches, cells, strict=True)
    ], True


def _seconds(match: re.Match[str], first: re.Match[str]) -> str:
    """A duration (s), or the time since the midnight before the first sample, in its time zone (s)."""
    if match["duration"]:
        return match["duration"]
    second = (match["s"] or match["s2"]).replace(",", ".")
    whole = 60 * int(match["m"] or match["m2"]) + 3600 * int(match["h"] or 0)
    whole -= _ahead(match["zone"]) - _ahead(first["zone"])
    if match["date"] and first["date"]:
        day, begun = (datetime.date.fromisoformat(one["date"]) for one in (match, first))
        whole += 86_400 * (day - begun).days
    return f"{whole + int(second[:2])}{second[2:]}"


def _ahead(zone: str | None) -> int:
    """Offset of a time zone (``Z``, ``+01:00``) from UTC (s)."""
    if zone in (None, "Z"):
        return 0
    return (-1 if zone[0] == "-" else 1) * (3600 * int(zone[1:3]) + 60 * int(zone[-2:]))


def text_of(value: object) -> str:
    """Text of a typed value: times of day, dates and durations in ISO 8601."""
    if value is None:
        return ""
    if isinstance(value, datetime.timedelta):
        return f"PT{value / _SECOND:.9f}S"
    if isinstance(value, bool):
        return str(value)
    if isinstance(value, datetime.date | datetime.time):
        return value.isoformat()
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return repr(value) if isinstance(value, float) else str(value).strip()
