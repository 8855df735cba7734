"""Files that end within a number or hold bytes of zero, as after a broken transfer or a loss of power."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final

from pyjoystick.motion.records.errors import RecordError

_PARTS: Final = re.compile(r"[+-]?(?P<whole>\d*)([.,](?P<decimals>\d*))?([eE][+-]?(?P<exponent>\d*))?")
#: Number of numbers that show the usual decimals.
_ENOUGH: Final = 8
#: Part of the numbers that may be as short, as 61 among numbers with trailing zeros cut.
_RARELY: Final = 0.02
#: Number of numbers of which one may be as short.
_MANY: Final = 20


def is_cut_short(cells: Sequence[str]) -> bool:
    """Whether the last cell of a column has fewer decimals or digits of an exponent than nearly all others.

    Among whole numbers, the digits count. Where the file does not end with the end of a line, such a number
    is what was left of a longer one.
    """
    *others, last = (_PARTS.fullmatch(cell) for cell in cells)
    numbers = [one for one in others if one is not None]
    if last is None or len(numbers) < _ENOUGH:
        return False
    if last[0][-1:] in (".", ",") and not any(one[0].endswith((".", ",")) for one in numbers):
        return True
    allowed = max(_RARELY * len(numbers), float(len(numbers) >= _MANY))
    is_whole = not any(one["decimals"] or one["exponent"] for one in (*numbers, last))
    return any(
        sum(len(one[part] or "") <= len(last[part] or "") for one in numbers) <= allowed
        for part in ("decimals", "exponent", *(["whole"] if is_whole else []))
    )


def require_no_zeros(source: str, text: str) -> None:
    """Reject a text with bytes of zero, which hide what stood in their place."""
    if "\0" in text:
        row = text.partition("\0")[0].count("\n") + 1
        reason = "holds bytes of zero, as after a loss of power while the file was written"
        raise RecordError(source, reason, "export it again, or end it before this row", rows=[row])


def cut_short(source: str, column: str, rows: Sequence[int], cell: str) -> RecordError:
    """Make the error for a file that ends within a number."""
    reason = "the file seems to end within its last number: all others have more digits"
    advice = "copy the file again; or end the line if the number is right"
    return RecordError(source, reason, advice, column=column, rows=rows, value=repr(cell))
