"""Tables in files: headings with units, numbers, and the line number of each row.

A reader lists the columns that it needs (`Column`: name, units, whether it is required) and gets arrays in SI
units; every mistake in the file is a `RecordError` with file, column and row. For files that are too long to
be read whole, `read_table_head` reads only the headings.
"""

from __future__ import annotations

import csv
import logging
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TextIO

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.columns import Column, Heading, TableHead
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.stumps import cut_short, is_cut_short, require_no_zeros
from pyjoystick.support import FloatArray, is_number_text, number_of_text

_LOG = logging.getLogger(__name__)

_COMMENT: Final = "#"
#: Errors that spreadsheets show in cells, as in #N/A, #DIV/0! or, in German, #WERT!.
_ERROR: Final = re.compile(r"#(N/A|NV\b|[^\W\d]+(/0)?[!?])", re.IGNORECASE)
DELIMITERS: Final = ",;\t"
#: Larger numbers are not measurements; their powers would overflow.
LARGEST: Final = 1e60
#: Number of bytes at the end of a file that show whether it ends within a number.
_END: Final = 4096
#: Cells without a number, in lower case.
EMPTY: Final = ("", "nan", "na", "n/a", "null", "none", "-")


@dataclass(frozen=True, slots=True, eq=False)
class TableFile:
    """A table whose cells are text.

    Attributes:
        head: its headings
        comments: the lines that begin with #, without the #
        cells: rows of text, each as long as the headings
        rows: line number of each row, from 1, shape (n,)
        empty: numbers of the empty lines between these, in order
        decimal: the decimal mark of all numbers, a point or a comma
        stump: the number within which the file ends, left out of the last row; empty if there is none
        remarks: numbers of the comment lines between these rows, in order, but for those in `empty`
        notes: doubts about the table, one sentence each
    """

    head: TableHead
    comments: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    rows: NDArray[np.int64]
    empty: tuple[int, ...] = ()
    decimal: str = "."
    stump: str = ""
    remarks: tuple[int, ...] = ()
    notes: tuple[str, ...] = ()

    def read(
        self,
        columns: Iterable[Column],
        *,
        headings: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> dict[str, FloatArray]:
        """Columns in SI units by name, shape (n,) each; missing optional ones are omitted.

        Args:
            columns: the requested columns
            headings: headings by name of the column, if they differ
            units: units by name of the column, if the headings have none

        Raises:
            RecordError: as `TableHead.match`; or a cell is empty, not a number or not finite
        """
        found = self.head.match(columns, headings=headings, units=units)
        return {
            name: self.finite_numbers(match.heading, match.column.advice) * match.factor
            for name, match in found.items()
        }

    def texts(self, heading: Heading) -> list[str]:
        """The cells of a column."""
        position = self.head.headings.index(heading)
        return [row[position] for row in self.cells]

    def numbers(self, heading: Heading) -> FloatArray:
        """The unconverted column under a heading, shape (n,); empty cells and words such as NA are NaN.

        Raises:
            RecordError: a cell contains something other than a number with the table's decimal mark, or one
                beyond `LARGEST`
        """
        values = np.empty(len(self.cells))
        for i, cell in enumerate(self.with_points(heading)):
            try:
                values[i] = np.nan if cell.lower() in EMPTY else number_of_text(cell)
            except ValueError:
                raise no_number(self.head.path, heading, int(self.rows[i]), cell) from None
        beyond = np.flatnonzero(np.isfinite(values) & (np.abs(values) > LARGEST))
        if beyond.size:
            raise RecordError(
                str(self.head.path),
                f"a number beyond {LARGEST:g}",
                "correct it",
                column=heading.text,
                rows=self.rows[beyond].tolist(),
                value=self.texts(heading)[beyond[0]],
            )
        return values

    def with_points(self, heading: Heading) -> list[str]:
        """The cells of a column of numbers with decimal points.

        Raises:
            RecordError: a cell contains a point, and the decimal mark is another
        """
        texts = self.texts(heading)
        if self.decimal == ".":
            return texts
        for row, cell in zip(self.rows, texts, strict=True):
            if "." in cell and is_number_text(cell):
                reason = "has a point, but the decimal mark of the table is the comma"
                advice = (
                    "does it separate thousands? Export the table with one decimal mark and no separators"
                )
                raise RecordError(
                    str(self.head.path),
                    reason,
                    advice,
                    column=heading.text,
                    rows=[int(row)],
                    value=repr(cell),
                )
        return [cell.replace(self.decimal, ".") for cell in texts]

    def finite_numbers(self, heading: Heading, advice: str) -> FloatArray:
        """As `numbers`, but missing values are an error.

        Raises:
            RecordError: a cell is empty, not a number or not finite
        """
        numbers = self.numbers(heading)
        bad = np.flatnonzero(~np.isfinite(numbers))
        if bad.size:
            if self.stump and bad[0] == len(numbers) - 1:
                raise cut_short(str(self.head.path), heading.text, self.rows[-1:].tolist(), self.stump)
            raise RecordError(
                str(self.head.path),
                "samples without a finite number",
                advice,
                column=heading.text,
                rows=self.rows[bad].tolist(),
                value=self.texts(heading)[bad[0]] or "nothing",
            )
        return numbers


def require_whole_end(head: TableHead) -> None:
    """Reject a file that ends within a number.

    Raises:
        RecordError: the last line has no end, and its last number fewer decimals than those above
    """
    with head.path.open("rb") as stream:
        stream.seek(max(0, head.path.stat().st_size - _END))
        end = stream.read().decode("utf-8", errors="replace")
    if end.endswith(("\n", "\r")):
        return
    lines = [line for line in end.splitlines()[1:] if not is_blank(line)]
    cells = [cells_of_line(head.path, 0, line, head.delimiter)[-1] for line in lines]
    if cells and is_cut_short(cells):
        raise cut_short(str(head.path), head.headings[-1].text, [], cells[-1])


def no_number(path: Path, heading: Heading, row: int, cell: str) -> RecordError:
    """Make the error for a cell that is not a number."""
    advice = "write numbers with a decimal point" if "," in cell else "write a number"
    if cell.startswith("'"):
        advice = "it is stored as text, and its point may separate thousands: store the cells as numbers"
    reason = "is not a number"
    if cell == heading.text:
        reason, advice = "the headings are repeated here", "keep one record a file: cut it before this row"
    return RecordError(str(path), reason, advice, column=heading.text, rows=[row], value=repr(cell))


def misfit(path: Path, row: int, cells: int, headings: int) -> RecordError:
    """Make the error for a row that is longer or shorter than the headings."""
    reason = f"has {cells} cell{'s' * (cells != 1)} under {headings} heading{'s' * (headings != 1)}"
    advice = "was the file cut off, or are the decimal marks commas?"
    return RecordError(str(path), reason, advice, rows=[row])


def read_table_file(path: Path) -> TableFile:
    """Read a table of columns separated by commas, semicolons or tabs, with headings first.

    Lines that begin with # are comments anywhere; empty lines are skipped, and rows without a cell that is
    filled, such as spreadsheets write below a table.

    Raises:
        RecordError: the file cannot be read, is not UTF-8 text, has no headings or no rows, or a row is
            longer or shorter than the headings
    """
    with open_text(path) as file:
        return table_of_text(path, file.read())


def table_of_text(path: Path, text: str) -> TableFile:
    """Read a table from the text of a file; see `read_table_file`."""
    require_no_zeros(str(path), text)
    lines = list(_numbered(text.split("\n")))
    filled = _filled(lines)
    head, rows = _head(path, filled), list(filled)
    if not rows:
        raise RecordError(
            str(path), "has no rows under a heading", "write a heading, then one sample per row"
        )
    cells = tuple(cells_of_line(path, number, line, head.delimiter) for number, line in rows)
    for (number, _), row in zip(rows, cells, strict=True):
        if len(row) != len(head.headings):
            raise misfit(path, number, len(row), len(head.headings))
    require_whole_end(head)
    headings = [one.text for one in head.headings]
    _LOG.info("read %s: %d rows of %s", path, len(rows), ", ".join(headings))
    comments = tuple(line.removeprefix(_COMMENT).strip() for _, line in lines if is_comment(line))
    return TableFile(head, comments, cells, np.array([number for number, _ in rows], dtype=np.int64))


def read_table_head(path: Path) -> TableHead:
    """Read only the headings of a table.

    Raises:
        RecordError: the file cannot be read, is not UTF-8 text, or has no headings
    """
    with open_text(path) as file:
        return _head(path, _filled(_numbered(file)))


@contextmanager
def open_text(path: Path, advice: str = "export the table as CSV in UTF-8") -> Iterator[TextIO]:
    """Open a text file.

    Args:
        path: the file
        advice: what to do if it is not text

    Raises:
        RecordError: it cannot be read, or is not UTF-8 text
    """
    try:
        with path.open(encoding="utf-8-sig") as file:
            yield file
    except OSError as error:
        reason = f"cannot be read: {error.strerror}"
        raise RecordError(str(path), reason, "check the path and its permissions") from error
    except UnicodeDecodeError as error:
        raise RecordError(str(path), "is not UTF-8 text", advice) from error


def _numbered(lines: Iterable[str]) -> Iterator[tuple[int, str]]:
    return ((number, line.strip(" \r\n")) for number, line in enumerate(lines, start=1))


def _filled(lines: Iterable[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    """The lines that are neither without content nor comments."""
    return ((number, line) for number, line in lines if not is_blank(line) and not is_comment(line))


def is_comment(line: str, marks: tuple[str, ...] = (_COMMENT,)) -> bool:
    """Whether a line is a comment, and not a row whose first cell shows the error of a spreadsheet."""
    first = line.lstrip()
    return first.startswith(marks) and _ERROR.match(first) is None


def is_blank(line: str, delimiters: str = DELIMITERS) -> bool:
    """Whether a line has nothing but spaces and delimiters."""
    return not line.strip(f" {delimiters}")


def _head(path: Path, filled: Iterator[tuple[int, str]]) -> TableHead:
    """The headings on the first nonempty line."""
    example = "begin with a line such as: time (s),theta (deg)"
    number, line = next(filled, (0, ""))
    if not line:
        advice = "begin with one line of column names and units, such as time (s)"
        raise RecordError(str(path), "has no headings", advice)
    delimiter = max(DELIMITERS, key=line.count)
    headings = tuple(Heading.of(cell) for cell in cells_of_line(path, number, line, delimiter))
    counts = Counter(heading.text for heading in headings)
    for text, count in counts.items():
        if is_number_text(text):
            reason = "has a number where a heading is expected"
            raise RecordError(str(path), reason, example, rows=[number], value=repr(text))
        if count > 1:
            reason = "two columns have one heading"
            raise RecordError(str(path), reason, "rename one", column=text, rows=[number])
    return TableHead(path, headings, delimiter, number)


def cells_of_line(path: Path, number: int, line: str, delimiter: str) -> tuple[str, ...]:
    """The cells of a line without surrounding spaces."""
    if '"' not in line:
        return tuple(cell.strip() for cell in line.split(delimiter))
    try:
        cells = next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))
    except csv.Error as error:
        raise RecordError(
            str(path), f"is not a row of cells: {error}", "export it again", rows=[number]
        ) from error
    return tuple(cell.strip() for cell in cells)
