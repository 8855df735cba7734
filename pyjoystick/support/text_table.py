"""A small table of text for reports, and how it is rendered."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape


@dataclass(frozen=True, slots=True)
class TextTable:
    """Headings and rows, all text; the first column names the row.

    Attributes:
        header: headings, one a column
        rows: the cells of each row, as many as there are headings

    Raises:
        ValueError: on rendering, where a row has more or fewer cells than there are headings
    """

    header: Sequence[str]
    rows: Sequence[Sequence[str]]

    def markdown(self) -> str:
        """Markdown that is aligned as text too: the first column to the left, the others to the right."""
        widths = [max(map(len, column)) for column in zip(self.header, *self.rows, strict=True)]

        def line(cells: Sequence[str]) -> str:
            first, *others = zip(cells, widths, strict=True)
            texts = [first[0].ljust(first[1]), *(cell.rjust(width) for cell, width in others)]
            return f"| {' | '.join(texts)} |"

        rule = ["-" * widths[0], *("-" * (width - 1) + ":" for width in widths[1:])]
        return "\n".join((line(self.header), line(rule), *(line(row) for row in self.rows)))

    def html(self, caption: str, *, prose: bool = False, texts: int = 0) -> str:
        """HTML with a caption; but for the first and the last `texts`, columns are numbers unless `prose`."""
        numbers = 0 if prose else len(self.header) - 1 - texts
        kinds = [' class="number"'] * numbers + [""] * (len(self.header) - 1 - numbers)
        head = "".join(
            f'<th scope="col"{kind}>{escape(cell)}</th>'
            for cell, kind in zip(self.header, ["", *kinds], strict=True)
        )
        body = "".join(
            f'<tr><th scope="row">{escape(first)}</th>'
            + "".join(f"<td{kind}>{escape(text)}</td>" for kind, text in zip(kinds, others, strict=True))
            + "</tr>\n"
            for first, *others in self.rows
        )
        kind = ' class="prose"' if prose else ""
        return (
            f'<div class="wide"><table{kind}><caption>{escape(caption)}</caption>\n'
            f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>"
        )
