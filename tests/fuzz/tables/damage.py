"""Damage to a table that a careful human sees in it."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Final, TypeAlias

from tests.fuzz.tables.style import Table

Row: TypeAlias = tuple[int | None, tuple[str, ...]]
_Change: TypeAlias = Callable[[list[str], Random, Table], list[str]]
_Kind: TypeAlias = Callable[[Table, Random], "Damaged"]
_WORDS: Final = (
    *("n/a", "overload", "-", "ERROR", "#DIV/0!", "?", "sensor off", "NaN", ""),
    *("1.2.3", "--5", "0x1F", "12:61"),
)
_REMARKS: Final = ("start of motion", "battery low", "END", "# pause")


@dataclass(frozen=True)
class Damaged:
    """A damaged file.

    Attributes:
        what: the kind of damage
        text: the file
        lost: numbers of the samples of which nothing is left, or only what was cut short
    """

    what: str
    text: str
    lost: frozenset[int] = frozenset()


def damaged(table: Table, random: Random) -> Damaged:
    """Damage a table in one way."""
    kind = random.choice(_KINDS)
    return kind(table, random)


def _place(table: Table, random: Random) -> int:
    return random.choice((0, len(table.rows) - 1, *[random.randrange(len(table.rows))] * 4))


def _in_a_row(change: _Change, what: str) -> _Kind:
    """Change the cells of one row, of some, or of all from one on."""

    def kind(table: Table, random: Random) -> Damaged:
        rows = list(table.rows)
        at = _place(table, random)
        for i in range(at, random.choice((at + 1, at + 1, min(at + 5, len(rows)), len(rows)))):
            number, cells = rows[i]
            rows[i] = number, tuple(change(list(cells), random, table))
        return Damaged(f"{what} at row {at}", table.with_rows(rows).text())

    return kind


def _cell_lost(cells: list[str], random: Random, table: Table) -> list[str]:
    del cells[random.randrange(len(cells))]
    return cells


def _cell_more(cells: list[str], random: Random, table: Table) -> list[str]:
    cells.insert(random.randrange(len(cells) + 1), random.choice(("", "0", *cells)))
    return cells


def _word(cells: list[str], random: Random, table: Table) -> list[str]:
    cells[random.randrange(len(cells))] = random.choice(_WORDS)
    return cells


def _other_decimal(cells: list[str], random: Random, table: Table) -> list[str]:
    other = "." if table.style.decimal == "," else ","
    return [cell.replace(table.style.decimal, other) for cell in cells]


def _thousands(cells: list[str], random: Random, table: Table) -> list[str]:
    mark = random.choice((" ", "'", "\u00a0", "," if table.style.decimal == "." else "."))
    return [re.sub(r"^(-?\d{1,3})(\d{3})(?=\D|$)", rf"\g<1>{mark}\2", cell) for cell in cells]


def _other_delimiter(cells: list[str], random: Random, table: Table) -> list[str]:
    others = [one for one in (",", ";", "\t") if one not in (table.style.delimiter, table.style.decimal)]
    return [random.choice(others).join(cells)]


def _unit_behind(cells: list[str], random: Random, table: Table) -> list[str]:
    at = random.randrange(len(cells))
    cells[at] += random.choice((" deg", "ms", " V", "%", "*"))
    return cells


def _joined(cells: list[str], random: Random, table: Table) -> list[str]:
    at = random.randrange(len(cells))
    return [*cells[:at], "".join(cells[at : at + 2]), *cells[at + 2 :]]


def _cut(table: Table, random: Random) -> Damaged:
    """The file ends anywhere after the first ten samples, which show the usual number of digits."""
    text, first = table.text(), table.with_rows(table.rows[:10]).text().rstrip("\r\n")
    end = random.randrange(len(first), len(text))
    whole = 9 + text[len(first) : end].count("\n")
    return Damaged("cut", text[:end], frozenset(range(whole, len(table.rows))))


def _rows_lost(table: Table, random: Random) -> Damaged:
    at = _place(table, random)
    end = at + random.choice((1, 2, 5, 20))
    lost = frozenset(i for i, _ in table.rows[at:end] if i is not None)
    return Damaged(f"rows lost at {at}", table.with_rows([*table.rows[:at], *table.rows[end:]]).text(), lost)


def _rows_moved(table: Table, random: Random) -> Damaged:
    rows, at, to = list(table.rows), _place(table, random), _place(table, random)
    if random.random() < 0.5:
        rows.insert(to, rows[at])
        return Damaged(f"row {at} again at {to}", table.with_rows(rows).text())
    rows.insert(to, rows.pop(at))
    return Damaged(f"row {at} moved to {to}", table.with_rows(rows).text())


def _lines_between(table: Table, random: Random) -> Damaged:
    """Headings again, remarks, empty lines, or a row of statistics between or below the samples."""
    rows, at = list(table.rows), random.choice((_place(table, random), len(table.rows)))
    width = len(table.head[0])
    mean = tuple(random.choice(table.rows)[1])
    line = random.choice(
        (
            *table.head,
            (random.choice(_REMARKS),),
            ("",) * width,
            ("",),
            ("Mean", *mean[1:]),
            (f"Max {mean[-1]}",),
        )
    )
    rows.insert(at, (None, line))
    return Damaged(f"line {line} at {at}", table.with_rows(rows).text())


def _twice(table: Table, random: Random) -> Damaged:
    """Two recordings in one file, with or without the headings between them."""
    head: list[Row] = [(None, line) for line in table.head] if random.random() < 0.5 else []
    return Damaged("twice", table.with_rows([*table.rows, *head, *table.rows]).text())


def _halves(table: Table, random: Random) -> Damaged:
    at = random.randrange(1, len(table.rows))
    return Damaged(f"halves exchanged at {at}", table.with_rows([*table.rows[at:], *table.rows[:at]]).text())


def _columns(table: Table, random: Random) -> Damaged:
    """A column without its heading, or a heading without its column."""
    at = random.randrange(len(table.head[0]))

    def without(cells: Sequence[str]) -> tuple[str, ...]:
        return tuple(cell for i, cell in enumerate(cells) if i != at)

    if random.random() < 0.5:
        head = tuple(map(without, table.head))
        return Damaged(f"heading {at} lost", replace(table, head=head).text())
    rows = [(i, without(cells)) for i, cells in table.rows]
    return Damaged(f"column {at} lost", table.with_rows(rows).text())


def _bytes(table: Table, random: Random) -> Damaged:
    """Bytes that no text has, in place of some of the file."""
    text = table.text()
    first = len(replace(table, rows=()).text())
    at, count = random.randrange(first, len(text)), random.choice((1, 8, 64))
    return Damaged(f"NUL at {at}", text[:at] + "\0" * count + text[at + count :])


_KINDS: Final = (
    _in_a_row(_cell_lost, "cell lost"),
    _in_a_row(_cell_more, "cell more"),
    _in_a_row(_word, "word"),
    _in_a_row(_other_decimal, "other decimal mark"),
    _in_a_row(_thousands, "thousands"),
    _in_a_row(_other_delimiter, "other delimiter"),
    _in_a_row(_unit_behind, "unit"),
    _in_a_row(_joined, "cells joined"),
    _cut,
    _rows_lost,
    _rows_moved,
    _lines_between,
    _twice,
    _halves,
    _columns,
    _bytes,
)
