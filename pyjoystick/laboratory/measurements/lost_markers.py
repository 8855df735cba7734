"""Detection of lost markers that a file places at the origin, or where they were seen last."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.laboratory.measurements.markers import Markers, unseen
from pyjoystick.motion import rows_in_words
from pyjoystick.support import FloatArray

#: A marker farther from the origin than this many times its longest step between frames did not go there.
_STEPS_AWAY: Final = 3.0
#: A marker, or all together, that repeat their place this many times stay there, if few frames repeat the one
#: before otherwise.
_FROZEN: Final = 5
_ALL_FROZEN: Final = 2
_BY_CHANCE: Final = 0.01
#: A motion that comes to rest moves less than a third as far between the last two frames as before them.
_SMOOTH: Final = 0.5


def without_lost(markers: Markers) -> Markers:
    """Replace 0, 0, 0 by NaN where it stands for a lost marker; notes list the frames.

    Cameras do not return three coordinates of exactly zero, but much software writes lost markers this way. A
    marker whose path leads through the origin keeps its zeros, because it is near in adjacent frames.
    """
    positions, notes = markers.positions.copy(), [*markers.notes]
    lost = np.zeros(positions.shape[:2], dtype=np.bool_)
    for i, name in enumerate(markers.names):
        zero = (positions[:, i] == 0.0).all(axis=1)
        if zero.any() and not (zero | unseen(positions[:, i])).all():
            lost[:, i] = _far_from_origin(positions[:, i], zero)
        elif zero.any():
            notes.append(f"marker {name} is at 0, 0, 0 wherever it is seen: was it lost in every frame?")
    positions[lost] = np.nan
    residuals = markers.residuals
    if residuals is not None:
        residuals = np.where(lost, np.nan, residuals)
    notes += [*_notes(markers, lost), *_frozen(markers, positions)]
    return dataclasses.replace(markers, positions=positions, residuals=residuals, notes=tuple(notes))


def _frozen(markers: Markers, positions: FloatArray) -> Iterator[str]:
    """Note markers that stay exactly where they are for some frames, but move or tremble in all others.

    Where all markers stay, a motion that slows down before and speeds up after is at rest there.
    """
    changes = np.diff(positions, axis=0)
    still = (changes == 0.0).all(axis=2)
    for i, name in enumerate(markers.names):
        alone = still[:, i] & ~np.delete(still, i, axis=1).all(axis=1)
        runs = _runs(alone, unseen(positions[:, i]), _FROZEN)
        yield from _frozen_note(f"marker {name} is", "was it lost there?", markers.rows, still[:, i], runs)
    lost = np.asarray(np.isnan(positions).any(axis=2))
    together = (still | lost[1:] & lost[:-1]).all(axis=1) & still.any(axis=1)
    steps = np.sqrt(np.nansum(changes**2, axis=(1, 2)))
    runs = _runs(together, np.asarray(lost.all(axis=1)), _ALL_FROZEN)
    runs = [run for run in runs if _is_sudden(steps, *run)]
    yield from _frozen_note("all markers are", "did the recording freeze?", markers.rows, together, runs)


def _runs(same: NDArray[np.bool_], lost: NDArray[np.bool_], fewest: int) -> list[tuple[int, int]]:
    """First and last frames of `fewest` or more repeats of the frame before, between seen frames."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], same, [False])).astype(np.int8)))
    runs = [(a, b) for a, b in edges.reshape(-1, 2).tolist() if b - a >= fewest]
    return [(a, b) for a, b in runs if a > 0 and b < len(same) and not lost[[a - 1, b + 1]].any()]


def _is_sudden(steps: FloatArray, first: int, last: int) -> bool:
    """Whether the motion stops or starts at once at the frames of a run, given its steps between frames."""
    stops = first > 1 and steps[first - 1] > _SMOOTH * steps[first - 2]
    starts = last + 1 < len(steps) and steps[last] > _SMOOTH * steps[last + 1]
    return bool(stops or starts)


def _frozen_note(
    who: str, question: str, rows: NDArray[np.int64], same: NDArray[np.bool_], runs: list[tuple[int, int]]
) -> Iterator[str]:
    outside = np.count_nonzero(same) - sum(b - a for a, b in runs)
    if runs and outside <= _BY_CHANCE * len(same):
        frames = rows[np.concatenate([np.arange(a, b + 1) for a, b in runs])]
        where = rows_in_words(frames.tolist())
        yield f"{who} at exactly the same place in {len(frames)} frames ({where}): {question}"


def _far_from_origin(path: FloatArray, zero: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mask of zeros, shape (n,), that are too far from the nearest frames with a position, shape (n, 3)."""
    known = np.flatnonzero(~zero & ~unseen(path))
    steps = np.linalg.norm(np.diff(path[known], axis=0), axis=1)[np.diff(known) == 1]
    longest = float(np.max(steps)) if steps.size else 0.0
    distance = np.linalg.norm(path[known], axis=1)
    frames = np.flatnonzero(zero)
    after = np.searchsorted(known, frames)
    beside = np.minimum(
        distance[np.clip(after, 0, len(known) - 1)], distance[np.clip(after - 1, 0, len(known) - 1)]
    )
    found = np.zeros(len(path), dtype=np.bool_)
    found[frames[beside > _STEPS_AWAY * longest]] = True
    return found


def _notes(markers: Markers, lost: NDArray[np.bool_]) -> Iterator[str]:
    for name, frames in zip(markers.names, lost.T, strict=True):
        if frames.any():
            yield (
                f"marker {name} counts as lost in {np.count_nonzero(frames)} frames in which the file has it "
                f"at exactly 0, 0, 0 ({rows_in_words(markers.rows[frames].tolist())})"
            )
