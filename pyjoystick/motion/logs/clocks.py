"""When the samples of a log were taken, if not the column of times says so; and columns of other times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.columns import TIME, Heading, Match
from pyjoystick.motion.logs.headings import candidates
from pyjoystick.motion.logs.log_table import LogTable
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.support import FloatArray

#: Headings of columns that number the samples.
_COUNTERS: Final = frozenset(
    (
        *(
            "#",
            "count",
            "counter",
            "frame",
            "frames",
            "id",
            "index",
            "n",
            "no",
            "num",
            "number",
            "point",
            "record",
        ),
        *("row", "sample", "samples", "scan"),
        *("bild", "datensatz", "messung", "nr", "punkt", "zeile", "muestra"),
    )
)


def counted_times(table: LogTable, rate: float) -> tuple[FloatArray, tuple[str, ...]]:
    """Return the times of the samples (s) at a sampling rate (Hz), and notes on columns that are not used.

    An empty line is a sample that was lost, and so is a number that a counter of samples skips.

    Raises:
        RecordError: what a counter skips is no whole number of samples
    """
    rows, notes = table.file.rows, [*_replaced_times(table, rate)]
    empty = np.array(table.file.empty, dtype=np.int64)
    places = np.arange(len(rows)) + np.searchsorted(empty, rows)
    for heading in table.file.head.headings:
        if heading.text.casefold().strip(" _.") in _COUNTERS:
            counter = _counter(table, heading)
            if counter is None:
                continue
            counted, step = counter
            if step > 1:
                notes.append(f"{heading.text!r} counts in steps of {step}; the rows are {rate:g} per second")
            if not np.array_equal(counted, places):
                skipped = int(counted[-1]) + 1 - len(counted)
                notes.append(f"{heading.text!r} skips {skipped} samples, which the times follow")
                return counted / rate, tuple(notes)
    return places / rate, tuple(notes)


def _counter(table: LogTable, heading: Heading) -> tuple[NDArray[np.int64], int] | None:
    """Return the places of samples, from 0, and the step of a column that counts upwards; None for others.

    Raises `RecordError` if some steps are no multiples of the smallest.
    """
    try:
        numbers = table.file.numbers(heading)
    except RecordError:
        return None
    steps = np.diff(numbers)
    if not steps.size or not np.isfinite(numbers).all() or (steps <= 0.0).any() or (steps % 1.0).any():
        return None
    smallest = steps.min()
    odd = np.flatnonzero(steps % smallest)
    if odd.size:
        raise RecordError(
            str(table.file.head.path),
            f"counts in steps of {smallest:g}, but once by {steps[odd[0]]:g}",
            "name a column of times instead of the sampling rate, or correct the counter",
            column=heading.text,
            rows=[int(table.file.rows[odd[0] + 1])],
        )
    places: NDArray[np.int64] = np.rint((numbers - numbers[0]) / smallest).astype(np.int64)
    return places, int(smallest)


def _replaced_times(table: LogTable, rate: float) -> Iterator[str]:
    """Yield a note for each column of times that is not used."""
    for heading in candidates(TIME, table.file.head.headings):
        yield f"{heading.text!r} is left alone: the samples are {rate:g} per second, as given"


def other_clocks(table: LogTable, found: Mapping[str, Match]) -> Iterator[str]:
    """Yield a note for each quantity that stands behind another column of times than the one that is read."""
    if "time" not in found:
        return
    headings, own = table.file.head.headings, found["time"].index
    same_name = [one for one in headings if one.name == headings[own].name]
    clocks = {headings.index(one) for one in (*candidates(TIME, headings), *same_name)} | {own}
    for name, match in found.items():
        nearest = max((one for one in clocks if one < match.index), default=own)
        if name != "time" and nearest != own and own < match.index and _differ(table, nearest, own):
            quantity, clock = headings[match.index].text, headings[nearest].text
            yield (
                f"{quantity!r} stands behind {clock!r}, another clock, but is read at the times of "
                f"{headings[own].text!r}"
            )


def _differ(table: LogTable, one: int, other: int) -> bool:
    headings = table.file.head.headings
    try:
        return not np.array_equal(
            table.file.numbers(headings[one]), table.file.numbers(headings[other]), equal_nan=True
        )
    except RecordError:
        return True
