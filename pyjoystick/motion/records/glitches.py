"""Samples that are somewhere else than those around them, for a moment."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion.records.errors import RecordError, rows_in_words
from pyjoystick.motion.records.instrument import HELD
from pyjoystick.support import FloatArray

#: The paper's joystick moves at up to 12 rad/s; a faster step (rad/s) of this size (rad) that is this much
#: longer than most of those before and behind it is no motion.
_FASTEST: Final = 30.0
_LEAST: Final = math.radians(5.0)
_JUMP: Final = 4.0
_BESIDE: Final = 5
#: Part of a jump by which the angle returns in one step near it. It does not where a slow sensor is held.
_BACK: Final = 0.5
#: A sample is apart if it is off the line between its neighbors by this angle (rad), and by this multiple of
#: what most samples before and behind it are; more such samples than this are those of a slow sensor.
_APART: Final = math.radians(1.5)
_MULTIPLE: Final = 5.0
_AROUND: Final = 10
_FEWEST: Final = 6
_FEW: Final = 12
#: A step faster than the paper's joystick (rad/s) and this many times as fast as all others is no motion.
_FASTER: Final = 12.0
_ALONE: Final = 4.0
#: Between two samples at rest, a joystick accelerates at up to this (rad/s2), up and down. At rest, it moves
#: less than a tenth as fast in this many steps before and behind; a step of few counts may be a rounding.
_STRONGEST: Final = 2000.0
_QUIET: Final = 3
_MULTIPLE_OF_REST: Final = 10.0
_COUNTS: Final = 3.0
#: Number of successive samples at which no motion turns back.
_TURNS: Final = 4
#: Up to this many samples that are farther outside all others than these are apart, of this many or more.
_LONE: Final = 3
_MANY: Final = 20


def require_no_glitch(
    source: str, time: FloatArray, theta: FloatArray, rows: NDArray[np.int64], question: str, advice: str
) -> None:
    """Reject an angle that jumps.

    Args:
        source: the file
        time: times of the samples (s), shape (n,)
        theta: the angle (rad), shape (n,)
        rows: rows of the samples in the file, shape (n,)
        question: what may be wrong
        advice: what to do then

    Raises:
        RecordError: the angle moves faster than 30 rad/s between two samples, not beside them, and back again
    """
    changes = np.diff(theta)
    steps = np.abs(changes)
    for i in np.flatnonzero(steps > np.maximum(_FASTEST * np.diff(time), _LEAST)).tolist():
        beside = (steps[max(0, i - _BESIDE) : i], steps[i + 1 : i + 1 + _BESIDE])
        usual = max((float(np.median(one)) for one in beside if one.size), default=0.0)
        if steps[i] > _JUMP * usual and _comes_back(changes, i):
            jump = f"the angle jumps by {math.degrees(steps[i]):.3g} degrees between two samples"
            raise RecordError(
                source,
                f"{jump}, faster than joysticks move: {question}",
                advice,
                rows=rows[i : i + 2].tolist(),
            )


def glitch_notes(
    time: FloatArray, theta: FloatArray, rows: NDArray[np.int64], question: str
) -> Iterator[str]:
    """Note samples in which the angle leaves the motion of those around it.

    Args:
        time: times of the samples (s), shape (n,)
        theta: the angle (rad), shape (n,)
        rows: rows of the samples in the file, shape (n,)
        question: what may be wrong
    """
    if len(theta) < _AROUND:
        return
    off = np.zeros(len(theta))
    off[1:-1] = np.abs(theta[1:-1] - _between(time, theta))
    apart = [i for i in np.flatnonzero(off > _APART).tolist() if _is_apart(off, i)]
    if not apart:
        return
    most = f"{math.degrees(float(off[apart].max())):.2g} degrees"
    where = rows_in_words(rows[apart].tolist())
    if len(apart) > _FEW:
        yield f"the angle moves in steps of up to {most} ({where}): is its sensor slower than the record?"
    else:
        yield f"the angle leaves the motion by up to {most} ({where}): {question}"


def mixture_notes(theta: FloatArray) -> Iterator[str]:
    """Note that the angle (rad) turns back at sample after sample, as where two channels alternate."""
    if len(theta) < _AROUND:
        return
    changes = np.diff(theta)
    off = np.abs(np.diff(changes)) / 2.0
    turns = (changes[:-1] * changes[1:] < 0.0) & (off > _APART)
    ends = np.flatnonzero(np.diff(np.concatenate(([False], turns, [False])).astype(np.int8)))
    lengths = ends[1::2] - ends[::2]
    count = int(lengths[lengths >= _TURNS].sum())
    if count:
        yield f"the angle turns back at {count} samples in succession: do two angles alternate in one column?"


def step_notes(time: FloatArray, theta: FloatArray, rows: NDArray[np.int64]) -> Iterator[str]:
    """Note a single step that is no motion, as where the unit of the angle (rad) or its zero changes.

    It is far faster than all others; or it is sudden, between samples at rest. Not the first steps after a
    release, which a light joystick may make between two samples.

    Args are those of `glitch_notes`.
    """
    if len(theta) < _AROUND:
        return
    steps, size = np.abs(np.diff(theta)), np.abs(theta)
    interval = np.maximum(np.diff(time), np.median(np.diff(time)))  # a jitter of the times is no motion
    rates = steps / interval
    second, first = (int(i) for i in np.argsort(rates)[-2:])
    is_fastest = steps[first] > _APART and rates[first] > max(_FASTER, _ALONE * rates[second])
    found = [first] if is_fastest else _steps_at_rest(steps, interval)
    for i in found if len(found) == 1 else ():
        if size[max(0, i - 1) : i + 1].max() <= HELD * size.max():
            yield (
                f"the angle moves by {math.degrees(steps[i]):.2g} degrees between two samples "
                f"({rows_in_words(rows[i : i + 2].tolist())}), much faster than anywhere else: "
                "does its unit or its zero change there?"
            )


def doubts(
    source: str, time: FloatArray, theta: FloatArray, rows: NDArray[np.int64], advice: str
) -> list[str]:
    """Notes on an angle that alternates, leaves the motion or moves in one step; one that jumps is an error.

    Args and errors are those of `require_no_glitch`.
    """
    motion = time, theta, rows
    require_no_glitch(source, *motion, question="is a sample wrong there?", advice=advice)
    found = [*mixture_notes(theta)] or [*step_notes(*motion)]
    return found or [*glitch_notes(*motion, question="are these samples wrong?")]


def lone_notes(what: str, values: FloatArray, rows: NDArray[np.int64]) -> Iterator[str]:
    """Note a few samples that are farther outside the range of all others than this is wide.

    Args:
        what: the quantity or its heading
        values: the samples, shape (n,)
        rows: rows of the samples in the file, shape (n,)
    """
    if len(values) < _MANY:
        return
    order = np.argsort(np.abs(values - np.median(values)), kind="stable")
    least, most = values[order[:-_LONE]].min(), values[order[:-_LONE]].max()
    suspects = np.sort(order[-_LONE:])
    beyond = np.maximum(values[suspects] - most, least - values[suspects])
    lone = suspects[beyond > most - least]
    if lone.size:
        found = ", ".join(f"{value:.4g}" for value in values[lone])
        where = rows_in_words(rows[lone].tolist())
        yield f"{what} is {found}, far outside all other samples ({where}): is it wrong?"


def _is_apart(off: FloatArray, i: int) -> bool:
    beside = (off[max(0, i - _AROUND) : max(0, i - 2)], off[i + 3 : i + 1 + _AROUND])
    usual = [float(np.median(one)) for one in beside if one.size >= _FEWEST]
    is_largest = bool(off[i] >= max(off[i - 1], off[i + 1]))
    return bool(usual) and is_largest and bool(off[i] > _MULTIPLE * max(usual))


def _steps_at_rest(steps: FloatArray, interval: FloatArray) -> list[int]:
    """Indices of steps (rad), in their intervals (s), that are too sudden for a joystick at rest."""
    counts = _COUNTS * min(steps[steps > 0.0], default=0.0)
    sudden = (steps > max(_APART, counts)) & (4.0 * steps > _STRONGEST * interval**2)
    rates, found = steps / interval, []
    for i in np.flatnonzero(sudden).tolist():
        beside = np.concatenate((rates[max(0, i - _QUIET) : i], rates[i + 1 : i + 1 + _QUIET]))
        if rates[i] > _MULTIPLE_OF_REST * beside.max():
            found.append(i)
    return found


def _comes_back(changes: FloatArray, i: int) -> bool:
    """Whether a step is undone by another one near it."""
    near = changes[max(0, i - _AROUND) : i + 1 + _AROUND]
    return bool((near * np.sign(changes[i]) <= -_BACK * abs(changes[i])).any())


def _between(time: FloatArray, theta: FloatArray) -> FloatArray:
    """The angle that the neighbors of each inner sample have at its time."""
    share = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    return np.asarray(theta[:-2] + share * (theta[2:] - theta[:-2]))
