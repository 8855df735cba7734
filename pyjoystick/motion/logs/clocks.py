"""When the samples of a log were taken, if not the column of times says so; and columns of other times."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.columns import TIME, Heading, Match
from pyjoystick.motion.logs.headings import candidates, last_part, meaning, spelled
from pyjoystick.motion.logs.log_table import LogTable
from pyjoystick.motion.records.errors import RecordError, rows_in_words
from pyjoystick.motion.units import UNITS
from pyjoystick.support import FloatArray

#: Words, and beginnings of words, in headings of columns that number the samples.
_WORDS: Final = frozenset(("#", "id", "lfd", "n", "no", "nr", "num", "row", "seq"))
_STEMS: Final = (
    *("count", "frame", "index", "number", "packet", "point", "record", "sample", "scan"),
    *("bild", "datensatz", "mess", "muestra", "punkt", "zeile", "zähler"),
)
_WORD: Final = re.compile(r"[^\W\d_]+|#")
_INNER_CAPITAL: Final = re.compile(r"(?<=[a-z])(?=[A-Z])")
#: The least part of the steps that must be equal in a column that counts, and the fewest steps.
_USUAL: Final = 0.8
_FEWEST: Final = 5
_SAME: Final = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class _Counter:
    """A column that counts: its usual step, and the places of its samples, from 0, if they are certain."""

    step: float
    places: NDArray[np.int64] | None
    first_fault: int
    """The first row that does not count on by the usual step; -1 if there is none."""


def counted_times(table: LogTable, rate: float, used: Collection[int]) -> tuple[FloatArray, tuple[str, ...]]:
    """Return the times of the samples (s) at a sampling rate (Hz), and notes on other columns.

    An empty line is a sample that was lost, and so is a number that a column of sample numbers skips.

    Args:
        table: the table
        rate: the sampling rate (Hz)
        used: the indices of columns that are something else
    """
    rows = table.file.rows
    empty = np.array(table.file.empty, dtype=np.int64)
    places = np.arange(len(rows)) + np.searchsorted(empty, rows)
    times = candidates(TIME, table.file.head.headings)
    notes = [f"{one.text!r} is left alone: the samples are {rate:g} per second, as given" for one in times]
    if table.file.remarks:
        notes.append(f"comment lines between samples take no time: {rows_in_words(table.file.remarks)}")
    followed = False
    for i, heading in enumerate(table.file.head.headings):
        if i in used or heading in times:
            continue
        counter = _counter(table, heading)
        if counter is None:
            if _numbers_samples(heading):
                notes.append(f"{heading.text!r} does not count evenly: the rows are {rate:g} per second")
            continue
        if counter.step > 1.0 + _SAME and _numbers_samples(heading):
            step = f"{heading.text!r} counts in steps of {counter.step:g}"
            notes.append(f"{step}; the rows are {rate:g} per second")
        if counter.first_fault < 0 and not len(empty):
            continue
        if counter.places is not None and _numbers_samples(heading) and not followed:
            notes += _followed(heading, counter.places, places)
            places, followed = counter.places, True
        elif counter.places is None or not np.array_equal(counter.places, places):
            where = f"{heading.text!r} does not count on at row {rows[max(counter.first_fault, 0)]}"
            notes.append(f"{where}: are samples missing? The times do not follow it")
    return places / rate, tuple(notes)


def _followed(heading: Heading, places: NDArray[np.int64], rows: NDArray[np.int64]) -> Iterator[str]:
    """Yield a note if a column that numbers the samples gives them other places than the rows."""
    skipped = int(places[-1]) + 1 - len(places)
    if not np.array_equal(places, rows):
        what = f"skips {skipped} samples" if skipped else "counts on across empty lines"
        yield f"{heading.text!r} {what}, which the times follow"


def _numbers_samples(heading: Heading) -> bool:
    """Return whether the words of a heading say that the column numbers the samples."""
    words = [one.casefold() for one in _WORD.findall(_INNER_CAPITAL.sub(" ", heading.text))]
    return any(one in _WORDS or one.startswith(_STEMS) for one in words)


def _counter(table: LogTable, heading: Heading) -> _Counter | None:
    """Return a column that counts, nearly always by the same number; None for another column."""
    try:
        numbers = table.file.numbers(heading)
    except RecordError:
        return None
    known = np.isfinite(numbers)
    steps = np.diff(numbers)
    steps = steps[np.isfinite(steps)]
    usual = float(np.median(steps)) if len(steps) >= _FEWEST else 0.0
    if not usual or np.mean(np.abs(steps / usual - 1.0) < _SAME) < _USUAL:
        return None
    index = np.arange(len(numbers))
    counts = np.interp(index, index[known], numbers[known]) / usual
    all_steps = np.diff(counts)
    faults = np.flatnonzero(np.abs(all_steps - 1.0) > _SAME)
    places = None
    is_whole = usual > 0.0 and not (numbers[known] % 1.0).any()
    if is_whole and known[0] and known[-1] and (all_steps > 0.0).all() and not (all_steps % 1.0).any():
        places = np.rint(counts - counts[0]).astype(np.int64)
    return _Counter(usual, places, int(faults[0]) + 1 if faults.size else -1)


def other_clocks(table: LogTable, found: Mapping[str, Match]) -> Iterator[str]:
    """Yield a note for each quantity that stands behind another column of times than the one that is read."""
    if "time" not in found:
        return
    headings, own = table.file.head.headings, found["time"].index
    clocks = {i for i, one in enumerate(headings) if _may_be_time(one) or one.name == headings[own].name} | {
        own
    }
    for name, match in found.items():
        nearest = max((one for one in clocks if one < match.index), default=own)
        if name != "time" and nearest != own and _differ(table, headings[nearest], headings[own]):
            quantity, clock = headings[match.index].text, headings[nearest].text
            where = f"{quantity!r} stands behind {clock!r}, another clock"
            yield f"{where}, but is read at the times of {headings[own].text!r}"


def _may_be_time(heading: Heading) -> bool:
    return meaning(last_part(heading.name)) == "time" or spelled("time", heading.unit) is not None


def _differ(table: LogTable, one: Heading, other: Heading) -> bool:
    """Return whether two clocks differ, other than by a constant longer than the record, as a date is."""
    try:
        first, second = (
            table.file.numbers(each) * UNITS["time"].get(spelled("time", each.unit) or "", 1.0)
            for each in (one, other)
        )
    except RecordError:
        return True
    known = np.isfinite(first) & np.isfinite(second)
    if known.sum() < 2:
        return True
    offsets, duration = (first - second)[known], float(np.ptp(second[known]))
    varies = np.ptp(offsets) > 1e-3 * duration
    return bool(varies or 0.0 < np.abs(offsets).max() < duration)
