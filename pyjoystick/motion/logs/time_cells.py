"""Cells with a time of day, a date or a duration, and their seconds."""

from __future__ import annotations

import datetime
import re
from collections import Counter
from collections.abc import Sequence
from typing import Final

from pyjoystick.motion.table_files import EMPTY

_CLOCK: Final = re.compile(
    r"(?:(?P<date>\d{4}-\d\d-\d\d)[T ])?(?P<h>\d{1,2}):(?P<m>\d\d):(?P<s>\d\d(?:[.,]\d+)?)"
    r"(?P<zone>Z|[+-]\d\d:?\d\d)?"
    r"|(?P<m2>\d{1,3}):(?P<s2>\d\d[.,]\d+)"
    r"|PT(?P<duration>-?\d+\.\d+)S"
)
_ERRORS: Final = ("#n/a", "#nv", "#div/0!", "#num!", "#value!", "nat", "<na>")
#: Cells without a number.
NOTHING: Final = (*EMPTY, *_ERRORS)


def clock_of(cell: str) -> re.Match[str] | None:
    """Match a time of day, a date with one, or a duration that exists."""
    match = _CLOCK.fullmatch(cell)
    if match is None:
        return None
    seconds, minutes = ((match[part] or "0").replace(",", ".") for part in ("s", "m"))
    if int(minutes) >= 60 or float(seconds) >= 61.0:
        return None
    if match["date"]:
        try:
            datetime.date.fromisoformat(match["date"])
        except ValueError:
            return None
    return match


def of_another_kind(cells: Sequence[str]) -> list[int]:
    """Indices of the cells of another kind than most, if a column has times of day, dates or durations."""
    kinds = {i: _kind_of_time(cell) for i, cell in enumerate(cells) if cell.casefold() not in NOTHING}
    if not any(kinds.values()):
        return []
    usual, _ = Counter(kinds.values()).most_common(1)[0]
    return [i for i, kind in kinds.items() if kind != usual]


def _kind_of_time(cell: str) -> str:
    """Kind of a time of day, date or duration; empty for other cells."""
    match = clock_of(cell)
    if match is None:
        return ""
    return "duration" if match["duration"] else "date" if match["date"] else "clock"


def plain_numbers(cells: Sequence[str]) -> tuple[list[str], bool]:
    """The numbers of a column, and whether they are times of day or durations, converted to s."""
    matches = [clock_of(cell) for cell in cells]
    if not any(matches):
        return ["" if cell.casefold() in _ERRORS else cell for cell in cells], False
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
