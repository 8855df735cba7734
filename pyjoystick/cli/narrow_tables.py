"""Tables that fit a terminal: columns wrap between words, and within a word only as a last resort."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Any, Final

from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

#: Wider than any table.
_UNLIMITED: Final = 100_000


class NarrowConsole(Console):
    """A console that lays out tables, and Markdown tables within text, so that they fit its width."""

    def print(self, *objects: Any, **options: Any) -> None:
        """Print as `Console.print` does."""
        if not any(_is_wide(one, self.width) for one in objects):
            super().print(*objects, **options)
            return
        for one in objects:
            for part in _parts(one, self.width) if isinstance(one, str) else [one]:
                if isinstance(part, Table):
                    _fit(part, self)
                super().print(part, **options)


def _is_wide(printed: object, width: int) -> bool:
    if isinstance(printed, str):
        return any(line.startswith("|") and len(line) > width for line in printed.splitlines())
    return isinstance(printed, Table)


def _parts(text: str, width: int) -> Iterator[str | Table]:
    """Split a text into paragraphs and Markdown tables that are too wide."""
    for in_table, group in groupby(text.splitlines(), key=lambda line: line.startswith("|")):
        lines = list(group)
        yield _table(lines) if in_table and _is_wide("\n".join(lines), width) else "\n".join(lines)


def _table(lines: list[str]) -> Table:
    header, rule, *rows = ([cell[1:-1].rstrip() for cell in line[1:-1].split("|")] for line in lines)
    table = Table(box=None, pad_edge=False)
    for heading, mark in zip(header, rule, strict=True):
        table.add_column(Text(heading.strip()), justify="right" if mark.endswith(":") else "left")
    for row in rows:
        table.add_row(*(Text(cell.lstrip() if i else cell) for i, cell in enumerate(row)))
    return table


def _fit(table: Table, console: Console) -> None:
    """Set column widths; the widest column shrinks first, down to its longest word."""
    needs = []
    for column in table.columns:
        cells = [Measurement.get(console, console.options, one) for one in (column.header, *column.cells)]
        word, line = (max(getattr(one, name) for one in cells) for name in ("minimum", "maximum"))
        line = min(line, max(column.max_width or line, word))
        needs.append((line if column.no_wrap else word, line))
    words, widths = (list(sizes) for sizes in zip(*needs, strict=True))
    unlimited = console.options.update(width=_UNLIMITED)
    room = console.width - Measurement.get(console, unlimited, table).maximum + sum(widths)
    if sum(words) > room:
        table.padding, table.pad_edge = (0, 1, 0, 0), False
        room = console.width - len(widths) + 1
    for least in (words, [1] * len(words)):
        while sum(widths) > room:
            wider = [i for i, width in enumerate(widths) if width > least[i]]
            if not wider:
                break
            widths[max(wider, key=widths.__getitem__)] -= 1
    for column, width in zip(table.columns, widths, strict=True):
        column.width, column.overflow, column.no_wrap = width, "fold", False
