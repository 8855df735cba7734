"""Long series of samples from CSV and .npy files, read in pieces to limit memory."""

from __future__ import annotations

import csv
import mmap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from tokenize import TokenError
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.laboratory.measurements.sample_counts import SampleCount
from pyjoystick.motion import (
    LARGEST,
    TIME,
    Column,
    Heading,
    Match,
    RecordError,
    TableHead,
    cells_of_line,
    misfit,
    no_number,
    open_text,
    read_table_head,
    require_whole_end,
)
from pyjoystick.support import FloatArray

#: Number of samples in a piece.
PIECE: Final = 1 << 16
_TIME: Final = replace(TIME, required=False)


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
        column: heading of its column; the name of an .npy file
        unit: unit of the samples as `UNITS` spells it; empty for an .npy file
        rate: sampling rate (Hz) if the file has no times
    """

    path: Path
    column: str
    unit: str
    rate: float | None
    _layout: _Layout | None

    def pieces(self, size: int = PIECE) -> Iterator[Piece]:
        """Read the samples in pieces of `size`; the last one may be shorter.

        Raises:
            RecordError: a cell is not a finite number, the time does not increase, or the file is truncated
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
    """A table with the positions of values and time; None if there is no time."""

    head: TableHead
    values: Match
    time: Match | None


def open_samples(
    path: Path, column: Column, *, heading: str = "", unit: str = "", rate: float | None = None
) -> SampleFile:
    """Inspect the head of a file of samples.

    Args:
        path: a CSV file with one line of headings, or a one-dimensional .npy file
        column: name of the quantity
        heading: heading of its column in a CSV file, if it differs
        unit: unit if the heading has none, and for .npy files
        rate: sampling rate (Hz), for files without a column ``time (s)``

    Raises:
        RecordError: the file cannot be read, lacks this column or its unit, or has neither a time nor a rate
    """
    if path.suffix.casefold() == ".npy":
        _require_rate(path, rate)
        head = TableHead(path, (Heading(path.name, column.name, ""),), "", 0)
        match = head.match([column], units={column.name: unit})[column.name]
        return SampleFile(path, path.name, match.unit, rate, None)
    head = read_table_head(path)
    names = {column.name: heading} if heading else {}
    found = head.match([_TIME, column], headings=names, units={column.name: unit})
    if "time" not in found:
        _require_rate(path, rate)
    require_whole_end(head)
    _require_width(head)
    _require_closed_marks(head)
    layout = _Layout(head, found[column.name], found.get("time"))
    return SampleFile(path, layout.values.heading.text, layout.values.unit, rate, layout)


def _require_width(head: TableHead) -> None:
    """Reject a first sample of more cells than headings, of which pandas takes the first for an index."""
    with open_text(head.path) as file:
        for number, line in enumerate(file, start=1):
            if number <= head.line:
                continue
            cells = len(cells_of_line(head.path, number, line.rstrip("\r\n"), head.delimiter))
            if cells > len(head.headings):
                raise misfit(head.path, number, cells, len(head.headings))
            return


def _require_closed_marks(head: TableHead) -> None:
    """Reject a quotation mark that pandas would close in a later line, without the rows between."""
    with head.path.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as content:
        if content.find(b'"') < 0:
            return
        for number, line in enumerate(iter(content.readline, b""), start=1):
            if b'"' not in line:
                continue
            text = line.decode("utf-8", errors="replace").rstrip("\r\n")
            try:
                next(csv.reader([text], delimiter=head.delimiter, strict=True))
            except csv.Error as error:
                reason = f"has a quotation mark that is not closed ({error})"
                advice = "remove it, or close it in its row"
                raise RecordError(str(head.path), reason, advice, rows=[number]) from error


def _require_rate(path: Path, rate: float | None) -> None:
    if rate is None:
        raise RecordError(str(path), "has no time", "give the rate of its samples in Hz")
    if not (np.isfinite(rate) and rate > 0.0):
        raise RecordError(str(path), "the rate must be above 0 Hz", "give the rate", value=f"{rate} Hz")


def _csv_pieces(file: SampleFile, layout: _Layout, size: int) -> Iterator[Piece]:
    head = layout.head
    counts = [] if layout.time else _counts(file, layout)
    first = head.line + 1
    try:
        with pd.read_csv(
            file.path,
            sep=head.delimiter,
            header=None,
            skiprows=head.line,
            names=list(range(len(head.headings))),
            chunksize=size,
            skip_blank_lines=False,
            low_memory=False,
            encoding="utf-8-sig",
        ) as tables:
            for table in _without_empty_end(tables):
                values = _numbers(file, layout.values, table, first)
                if layout.time is not None:
                    time = _numbers(file, layout.time, table, first) * layout.time.factor
                else:
                    _follow(file, counts, table, first)
                    index = np.arange(first, first + len(values)) - head.line - 1
                    time = index / (file.rate or 1.0)
                yield Piece(first, time, values)
                first += len(values)
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
        advice = "was the file cut off, or are the decimal marks commas? Export it with decimal points"
        reason = f"is not a table of columns: {str(error).strip()}"
        raise RecordError(str(file.path), reason, advice) from error


def _counts(file: SampleFile, layout: _Layout) -> list[tuple[Match, SampleCount]]:
    """The columns beside the values, which may count the samples."""
    others = (
        Match(Column(heading.name, {"": 1.0}), heading, i, "")
        for i, heading in enumerate(layout.head.headings)
        if i != layout.values.index
    )
    return [(one, SampleCount(str(file.path), one.heading, file.rate or 1.0)) for one in others]


def _follow(
    file: SampleFile, counts: list[tuple[Match, SampleCount]], table: pd.DataFrame, first: int
) -> None:
    """Raise RecordError where a column that counts skips samples; drop columns that do not count."""
    for match, count in list(counts):
        try:
            numbers = _numbers(file, match, table, first)
        except RecordError:
            if count.counts:
                raise
            numbers = np.empty(0)  # words
        if numbers.size:
            count.follow(numbers, first)
        if not count.counts:
            counts.remove((match, count))


def _without_empty_end(tables: Iterable[pd.DataFrame]) -> Iterator[pd.DataFrame]:
    """The tables without empty lines after the last sample."""
    held: list[pd.DataFrame] = []
    for table in tables:
        filled = np.flatnonzero(table.notna().any(axis=1))
        if filled.size:
            end = int(filled[-1]) + 1
            yield from held
            yield table.iloc[:end]
            held, table = [], table.iloc[end:]
        if len(table):
            held.append(table)


def _numbers(file: SampleFile, match: Match, table: pd.DataFrame, first: int) -> FloatArray:
    """Numbers of a column; NaN only for empty cells."""
    column = table[match.index]
    if column.dtype == np.object_:  # as text: integers may exceed all floats
        column = column.astype("string")
    numbers = pd.to_numeric(column, errors="coerce").to_numpy(dtype=np.float64, na_value=np.nan)
    bad = np.flatnonzero(np.isnan(numbers) & np.asarray(column.notna(), dtype=np.bool_))
    if bad.size:
        i = int(bad[0])
        raise no_number(file.path, match.heading, first + i, str(column.iloc[i]))
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
                    source, "is not a series of numbers", advice, value=f"{dtype} of shape {shape}"
                )
            first, count = 0, int(shape[0])
            while first < count:
                values = np.fromfile(stream, dtype=dtype, count=min(size, count - first)).astype(np.float64)
                if not len(values):
                    reason = f"is cut off: it declares {count} samples and has {first}"
                    raise RecordError(source, reason, "copy or save the file again")
                yield Piece(first, np.arange(first, first + len(values)) / file.rate, values)
                first += len(values)
    except OSError as error:
        reason = f"cannot be read: {error.strerror or error}"
        raise RecordError(source, reason, "check the path and its permissions") from error
    except (ValueError, SyntaxError, TokenError, TypeError, KeyError) as error:  # NumPy: bad header
        if isinstance(error, RecordError):
            raise
        raise RecordError(source, f"is not a .npy file: {error}", "save it by numpy.save") from error


def _require_finite(file: SampleFile, piece: Piece) -> None:
    bad = np.flatnonzero(~(np.abs(piece.values) <= LARGEST) | ~(np.abs(piece.time) <= LARGEST))
    if bad.size:
        raise RecordError(
            str(file.path),
            f"samples without a finite number below {LARGEST:g}",
            "an empty line or a lost sample? An accelerometer's series has no gaps: cut the file there",
            column=file.column,
            rows=(piece.first + bad).tolist(),
        )
