"""Text files of columns: headings with units, numbers, and the line that each row stands on."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.records.errors import RecordError
from pyjoystick.support import FloatArray

_COMMENT = "#"
DELIMITERS = ",;\t"
_HEADING = re.compile(r"(?P<name>.*?)\s*[(\[](?P<unit>[^()\[\]]*)[)\]]\s*")
_EMPTY = ("", "nan", "na", "n/a", "null", "none", "-")


@dataclass(frozen=True, slots=True)
class Heading:
    """The heading of a column: ``theta (deg)`` has the name theta and the unit deg, which may be empty."""

    text: str
    name: str
    unit: str


@dataclass(frozen=True, slots=True)
class CsvFile:
    """The cells of a file of columns as text.

    Attributes:
        path: the file
        comments: the lines that begin with #, without it
        headings: one a column
        cells: rows of text, each as long as `headings`
        lines: line number of each row, from 1, shape (rows,)
    """

    path: Path
    comments: tuple[str, ...]
    headings: tuple[Heading, ...]
    cells: tuple[tuple[str, ...], ...]
    lines: NDArray[np.int64]

    def numbers(self, heading: Heading) -> FloatArray:
        """The column under a heading; empty cells and words such as NA are NaN.

        Raises:
            RecordError: a cell holds something else than a number
        """
        position = self.headings.index(heading)
        values = np.empty(len(self.cells))
        for i, row in enumerate(self.cells):
            try:
                values[i] = np.nan if row[position].lower() in _EMPTY else float(row[position])
            except ValueError:
                advice = "write numbers with a decimal point" if "," in row[position] else "write a number"
                raise RecordError(
                    str(self.path),
                    "is no number",
                    advice,
                    column=heading.text,
                    rows=[self.lines[i]],
                    value=repr(row[position]),
                ) from None
        return values


def read_csv_file(path: Path) -> CsvFile:
    """Read a file of columns separated by commas, semicolons or tabs, headings first.

    Lines that begin with # are comments, wherever they stand; empty lines are skipped.

    Raises:
        RecordError: the file cannot be read, is no text, has no headings or no rows, or a row that is longer
            or shorter than the headings
    """
    text = _text(path)
    numbered = [(number, line.strip()) for number, line in enumerate(text.splitlines(), start=1)]
    comments = tuple(line.removeprefix(_COMMENT).strip() for _, line in numbered if line.startswith(_COMMENT))
    filled = [(number, line) for number, line in numbered if line and not line.startswith(_COMMENT)]
    if len(filled) < 2:
        raise RecordError(str(path), "has no rows under a heading", "write a heading, then one sample a row")
    delimiter = max(DELIMITERS, key=filled[0][1].count)
    rows = [split_cells(line, delimiter) for _, line in filled]
    headings = tuple(parse_heading(cell) for cell in rows[0])
    _require_headings(path, headings, filled[0][0])
    for (number, _), row in zip(filled, rows, strict=True):
        if len(row) != len(headings):
            reason = f"has {len(row)} cells under {len(headings)} headings"
            advice = "was the file cut off, or are the decimal marks commas?"
            raise RecordError(str(path), reason, advice, rows=[number])
    lines = np.array([number for number, _ in filled[1:]], dtype=np.int64)
    return CsvFile(path, comments, headings, tuple(rows[1:]), lines)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        reason = f"cannot be read: {error.strerror}"
        raise RecordError(str(path), reason, "check the path and its permissions") from error
    except UnicodeDecodeError as error:
        raise RecordError(str(path), "is no text in UTF-8", "export the record as CSV in UTF-8") from error


def split_cells(line: str, delimiter: str) -> tuple[str, ...]:
    """The cells of a line without the blanks around them."""
    cells = next(csv.reader(io.StringIO(line), delimiter=delimiter, skipinitialspace=True))
    return tuple(cell.strip() for cell in cells)


def parse_heading(text: str) -> Heading:
    """Name and unit of a heading such as ``theta (deg)`` or ``theta [deg]``."""
    match = _HEADING.fullmatch(text)
    return Heading(text, match["name"].strip(), match["unit"].strip()) if match else Heading(text, text, "")


def _require_headings(path: Path, headings: tuple[Heading, ...], line: int) -> None:
    for heading in headings:
        try:
            float(heading.text)
        except ValueError:
            continue
        raise RecordError(
            str(path),
            "has a number where a heading is expected",
            "begin with a line such as: time (s),theta (deg)",
            rows=[line],
            value=repr(heading.text),
        )
    texts = [heading.text for heading in headings]
    for text in texts:
        if texts.count(text) > 1:
            raise RecordError(
                str(path), "two columns have one heading", "rename one", column=text, rows=[line]
            )
