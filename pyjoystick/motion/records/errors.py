"""The error of records that cannot be used."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import KW_ONLY, dataclass
from itertools import groupby

from pyjoystick.support import PyJoystickError

_MOST_ROWS_SHOWN = 5


@dataclass(eq=False)
class RecordError(PyJoystickError, ValueError):
    """A record of a motion cannot be used as it is.

    Attributes:
        source: the file or other source of the record
        reason: what is wrong
        advice: what to do about it
        column: heading of the column concerned, or an empty string
        rows: the rows concerned (a tuple): line numbers of the file as in an editor, or indices of
            samples if the record comes from arrays; may be empty
        value: the offending value, or None
    """

    source: str
    reason: str
    advice: str
    _: KW_ONLY
    column: str = ""
    rows: Iterable[int] = ()
    value: object = None

    def __post_init__(self) -> None:
        self.rows = tuple(int(row) for row in self.rows)
        super().__post_init__()

    def __str__(self) -> str:
        places = [self.source]
        if self.column:
            places.append(f"column {self.column!r}")
        if self.rows:
            places.append(rows_in_words(self.rows))
        value = "" if self.value is None else f" (found {self.value})"
        return f"{', '.join(places)}: {self.reason}{value}; {self.advice}"


def rows_in_words(rows: Iterable[int]) -> str:
    """Row numbers as text with ranges: ``row 7`` or ``rows 3-5, 9``."""
    ranges = list(_ranges(sorted(set(rows))))
    words = [str(first) if first == last else f"{first}-{last}" for first, last in ranges[:_MOST_ROWS_SHOWN]]
    more = len(ranges) - len(words)
    single = len(ranges) == 1 and ranges[0][0] == ranges[0][1]
    return f"{'row' if single else 'rows'} {', '.join(words)}" + (f" and {more} more places" if more else "")


def _ranges(rows: list[int]) -> Iterator[tuple[int, int]]:
    """First and last of every stretch of consecutive numbers."""
    for _, stretch in groupby(enumerate(rows), key=lambda pair: pair[1] - pair[0]):
        numbers = [number for _, number in stretch]
        yield numbers[0], numbers[-1]
