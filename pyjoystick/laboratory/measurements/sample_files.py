"""Long series of samples from CSV and .npy files, a piece at a time: a file is never in memory as a whole."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.motion import DELIMITERS, Heading, RecordError, parse_heading, split_cells
from pyjoystick.support import FloatArray

#: Samples in a piece.
PIECE: Final = 1 << 16
_TIME: Final = {"s": 1.0, "ms": 1e-3}
#: Lines of comments before the headings that are looked through.
_MOST_COMMENTS: Final = 1000


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """Consecutive samples.

    Attributes:
        first: row of the first sample: its line in a CSV file, its index from 0 in an .npy file
        time: instants (s), shape (n,)
        values: in the unit of the file, shape (n,)
    """

    first: int
    time: FloatArray
    values: FloatArray


@dataclass(frozen=True, slots=True)
class SampleFile:
    """A series of samples in a file.

    Attributes:
        path: the file
        heading: heading of its column; of an .npy file its name, without a unit
        rate: samples a second (Hz) where the file has no time
    """

    path: Path
    heading: Heading
    rate: float | None
    _layout: _Layout | None

    def pieces(self, size: int = PIECE) -> Iterator[Piece]:
        """The samples, `size` at a time, the last piece perhaps fewer.

        Raises:
            RecordError: a cell holds no finite number, the time does not increase, or the file is cut off
        """
        series = _npy_pieces(self, size) if self._layout is None else _csv_pieces(self, self._layout, size)
        last = -np.inf
        for piece in series:
            _require_finite(self, piece)
            backward = np.flatnonzero(~(np.diff(piece.time, prepend=last) > 0.0))
            if backward.size:
                raise RecordError(
                    str(self.path),
                    "the time does not increase from the sample before",
                    "export the samples of one recording in order, with enough digits of the time",
                    column="time",
                    rows=[piece.first + int(backward[0])],
                    value=f"{piece.time[backward[0]]:.9g} s",
                )
            last = float(piece.time[-1])
            yield piece


@dataclass(frozen=True, slots=True)
class _Layout:
    """A CSV file: line of its headings, their number, positions of the time, or None, and of the values."""

    line: int
    delimiter: str
    width: int
    time: int | None
    time_factor: float
    value: int


def open_samples(path: Path, *, column: str, rate: float | None = None) -> SampleFile:
    """Look at the head of a file of samples.

    Args:
        path: a CSV file with one line of headings, or an .npy file of one dimension
        column: heading or name of the column in a CSV file
        rate: samples a second (Hz), for files without a column ``time (s)``

    Raises:
        RecordError: the file cannot be read, has not this column, or neither a time nor a rate
    """
    if path.suffix.casefold() == ".npy":
        _require_rate(path, rate)
        return SampleFile(path, Heading(path.name, path.name, ""), rate, None)
    line, text = _heading_line(path)
    delimiter = max(DELIMITERS, key=text.count)
    headings = [parse_heading(cell) for cell in split_cells(text, delimiter)]
    wanted = column.casefold()
    found = [i for i, one in enumerate(headings) if wanted in (one.name.casefold(), one.text.casefold())]
    if len(found) != 1:
        texts = ", ".join(repr(one.text) for one in headings)
        reason = f"has {len(found) or 'no'} columns {column!r}"
        raise RecordError(str(path), reason, f"name one of {texts}", rows=[line])
    times = [i for i, one in enumerate(headings) if one.name.casefold() in ("time", "t")]
    factor = 1.0
    if not times:
        _require_rate(path, rate)
    elif headings[times[0]].unit not in _TIME:
        text = headings[times[0]].text
        raise RecordError(str(path), "has no known unit", "write time (s) or time (ms)", column=text)
    else:
        factor = _TIME[headings[times[0]].unit]
    layout = _Layout(line, delimiter, len(headings), times[0] if times else None, factor, found[0])
    return SampleFile(path, headings[found[0]], rate, layout)


def _require_rate(path: Path, rate: float | None) -> None:
    if rate is None:
        raise RecordError(str(path), "has no time", "give the rate of its samples in Hz")
    if not (np.isfinite(rate) and rate > 0.0):
        raise RecordError(str(path), "the rate must be above 0 Hz", "give the rate", value=f"{rate} Hz")


def _heading_line(path: Path) -> tuple[int, str]:
    """Number and text of the first line that is neither empty nor a comment."""
    try:
        with path.open(encoding="utf-8-sig") as file:
            for number, line in zip(range(1, _MOST_COMMENTS), file, strict=False):
                if line.strip() and not line.lstrip().startswith("#"):
                    return number, line.strip()
    except OSError as error:
        reason = f"cannot be read: {error.strerror}"
        raise RecordError(str(path), reason, "check the path and its permissions") from error
    except UnicodeDecodeError as error:
        advice = "name an array of NumPy .npy, export a table as CSV in UTF-8"
        raise RecordError(str(path), "is no text in UTF-8", advice) from error
    raise RecordError(str(path), "has no headings", "begin with a line such as: time (s),acceleration (m/s2)")


def _csv_pieces(file: SampleFile, layout: _Layout, size: int) -> Iterator[Piece]:
    first = layout.line + 1
    try:
        with pd.read_csv(
            file.path,
            sep=layout.delimiter,
            header=None,
            skiprows=layout.line,
            names=list(range(layout.width)),
            chunksize=size,
            skip_blank_lines=False,
            low_memory=False,
            encoding="utf-8-sig",
        ) as tables:
            for table in tables:
                _require_width(file, table, first)
                values = _column(file, table[layout.value], first)
                index = np.arange(first, first + len(values)) - layout.line - 1
                time = index / (file.rate or 1.0)
                if layout.time is not None:
                    time = _column(file, table[layout.time], first) * layout.time_factor
                yield Piece(first, time, values)
                first += len(values)
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
        advice = "was the file cut off, or are the decimal marks commas? Export it with decimal points"
        reason = f"is no table of columns: {str(error).strip()}"
        raise RecordError(str(file.path), reason, advice) from error


def _require_width(file: SampleFile, table: pd.DataFrame, first: int) -> None:
    """Where all rows are too long, pandas takes their first cells for an index."""
    if not isinstance(table.index, pd.RangeIndex):
        advice = "are the decimal marks commas? Export it with decimal points"
        raise RecordError(str(file.path), "has more cells than headings", advice, rows=[first])


def _column(file: SampleFile, column: pd.Series, first: int) -> FloatArray:
    """Numbers of a column; NaN only where the cell is empty."""
    numbers = np.asarray(pd.to_numeric(column, errors="coerce"), dtype=np.float64)
    bad = np.flatnonzero(np.isnan(numbers) & np.asarray(column.notna(), dtype=np.bool_))
    if bad.size:
        text = str(column.iloc[int(bad[0])])
        advice = "write numbers with a decimal point" if "," in text else "write a number"
        raise RecordError(
            str(file.path), "is no number", advice, rows=[first + int(bad[0])], value=repr(text)
        )
    return numbers


def _npy_pieces(file: SampleFile, size: int) -> Iterator[Piece]:
    assert file.rate is not None
    source = str(file.path)
    try:
        with file.path.open("rb") as stream:
            version = np.lib.format.read_magic(stream)
            read = (
                np.lib.format.read_array_header_1_0
                if version == (1, 0)
                else np.lib.format.read_array_header_2_0
            )
            shape, _, dtype = read(stream)
            if len(shape) != 1 or dtype.kind not in "iuf" or not shape[0]:
                advice = "save a single channel as numbers of one dimension"
                raise RecordError(
                    source, "is no series of numbers", advice, value=f"{dtype} of shape {shape}"
                )
            first, count = 0, int(shape[0])
            while first < count:
                values = np.fromfile(stream, dtype=dtype, count=min(size, count - first)).astype(np.float64)
                if not len(values):
                    reason = f"is cut off: it says {count} samples and holds {first}"
                    raise RecordError(source, reason, "copy or save the file again")
                yield Piece(first, np.arange(first, first + len(values)) / file.rate, values)
                first += len(values)
    except OSError as error:
        reason = f"cannot be read: {error.strerror or error}"
        raise RecordError(source, reason, "check the path and its permissions") from error
    except ValueError as error:
        if isinstance(error, RecordError):
            raise
        raise RecordError(source, f"is no .npy file: {error}", "save it by numpy.save") from error


def _require_finite(file: SampleFile, piece: Piece) -> None:
    bad = np.flatnonzero(~np.isfinite(piece.values) | ~np.isfinite(piece.time))
    if bad.size:
        raise RecordError(
            str(file.path),
            "samples without a finite number",
            "an empty line or a lost sample? An accelerometer's series has no gaps: cut the file there",
            column=file.heading.text,
            rows=(piece.first + bad).tolist(),
        )
