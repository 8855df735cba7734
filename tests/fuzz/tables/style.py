"""Tables of known contents, as instruments and people in several countries write them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Final

#: Delimiters with decimal marks, and encodings; readers of plain CSV know the first, and the first two.
_MARKS: Final = ((",", "."), (";", ","), (";", "."), ("\t", "."), ("\t", ","))
_ENCODINGS: Final = ("utf-8", "utf-8-sig", "cp1252", "utf-16")
_PREAMBLES: Final = (
    (),
    (),
    ("# joystick 3, released by hand",),
    ("Laboratory of biomechanics", ""),
    ("Recorder:{d}DL-7", "Operator:{d}M. Lee", "Date:{d}2026-03-01", ""),
)


@dataclass(frozen=True)
class Style:
    """How a table is written.

    Attributes:
        delimiter, decimal: between cells, and within numbers
        encoding, newline: of the file; the last line ends with a newline if `is_ended`
        preamble: lines above the headings
        units: below the headings, in brackets behind them, or behind a slash
        is_quoted: whether each cell is in quotation marks
    """

    delimiter: str
    decimal: str
    encoding: str
    newline: str
    is_ended: bool
    preamble: tuple[str, ...]
    units: str
    is_quoted: bool

    @classmethod
    def random(cls, random: Random, *, plain: bool) -> Style:
        """Return any style, or one that the readers of plain CSV files know."""
        delimiter, decimal = random.choice(_MARKS[:1] if plain else _MARKS)
        preamble = () if plain else random.choice(_PREAMBLES)
        return cls(
            delimiter=delimiter,
            decimal=decimal,
            encoding=random.choice(_ENCODINGS[:2] if plain else _ENCODINGS),
            newline=random.choice(("\n", "\r\n")),
            is_ended=random.random() < 0.8,
            preamble=tuple(line.format(d=delimiter) for line in preamble),
            units="brackets" if plain else random.choice(("brackets", "brackets", "slash", "below")),
            is_quoted=not plain and random.random() < 0.1,
        )


@dataclass(frozen=True)
class Series:
    """A column of numbers.

    Attributes:
        name: the quantity; empty for a column that is not read
        heading, unit: as in the file
        factor: from this unit to the SI unit
        cells: the numbers, with points
    """

    name: str
    heading: str
    unit: str
    factor: float
    cells: tuple[str, ...]


@dataclass(frozen=True)
class Table:
    """A table, as lines of cells.

    Attributes:
        style: how it is written
        head: the lines of headings and units
        rows: the samples as they are written, each with its number; None for what is no sample
    """

    style: Style
    head: tuple[tuple[str, ...], ...]
    rows: tuple[tuple[int | None, tuple[str, ...]], ...]

    @classmethod
    def of(cls, columns: Sequence[Series], style: Style) -> Table:
        """Write the columns in a style."""
        head = [tuple(_heading(one, style.units) for one in columns)]
        if style.units == "below":
            head.append(tuple(one.unit for one in columns))
        cells = zip(*(one.cells for one in columns), strict=True)
        rows = [(i, tuple(cell.replace(".", style.decimal) for cell in row)) for i, row in enumerate(cells)]
        return cls(style, tuple(head), tuple(rows))

    def with_rows(self, rows: Sequence[tuple[int | None, tuple[str, ...]]]) -> Table:
        """Return the table with other rows."""
        return replace(self, rows=tuple(rows))

    def text(self) -> str:
        """Return the whole file."""
        mark = '"' if self.style.is_quoted else ""
        lines = [*self.head, *(row for _, row in self.rows)]
        written = [self.style.delimiter.join(f"{mark}{cell}{mark}" for cell in line) for line in lines]
        return (
            self.style.newline.join([*self.style.preamble, *written])
            + self.style.newline * self.style.is_ended
        )


def _heading(one: Series, units: str) -> str:
    if not one.unit or units == "below":
        return one.heading
    return f"{one.heading}/{one.unit}" if units == "slash" else f"{one.heading} ({one.unit})"
