"""Detection of lost markers that a file places at the origin, or where they were seen last."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.laboratory.measurements.markers import Markers, unseen
from pyjoystick.motion import rows_in_words
from pyjoystick.support import FloatArray

#: A marker farther from the origin than this many times its longest step between frames did not go there.
_STEPS_AWAY: Final = 3.0
#: A marker, or all together, that repeat their place this many times are frozen,
_FROZEN: Final = 5
_ALL_FROZEN: Final = 2
#: if few other frames repeat the one before, and not nearly all frames do.
_BY_CHANCE: Final = 0.01
_MOST: Final = 0.9
#: All together must be expected to repeat their place this often only, by their shares of other repeats;
_UNLIKELY: Final = 0.05
#: with a larger share in one of them they may be at rest: simulated, or rounded to more than their noise.
_TREMBLING: Final = 0.1


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
    """Note markers that stay exactly where they are for some frames, but move or tremble in the others."""
    still = (np.diff(positions, axis=0) == 0.0).all(axis=2)
    lost = np.asarray(np.isnan(positions).any(axis=2))
    seen = ~(lost[1:] | lost[:-1])
    for i, name in enumerate(markers.names):
        alone = _in_runs(still[:, i] & ~np.delete(still, i, axis=1).all(axis=1), _FROZEN)
        if _share(still[:, i], seen[:, i] & ~alone) <= _BY_CHANCE and alone.mean() < _MOST:
            yield from _note(f"marker {name} is", "was it lost there?", markers.rows, alone)
    together = (still | lost[1:] & lost[:-1]).all(axis=1) & still.any(axis=1)
    frozen = _in_runs(together, _ALL_FROZEN)
    shares = [_share(still[:, i], seen[:, i] & ~frozen) for i in range(len(markers.names))]
    trembling = max(shares) <= _TREMBLING and len(still) * math.prod(shares) <= _UNLIKELY
    if trembling and frozen.mean() < _MOST:
        yield from _note("all markers are", "did the recording freeze?", markers.rows, frozen)


def _share(still: NDArray[np.bool_], among: NDArray[np.bool_]) -> float:
    """Part of the frames that repeat the one before."""
    return float(still[among].mean()) if among.any() else 1.0


def _in_runs(same: NDArray[np.bool_], fewest: int) -> NDArray[np.bool_]:
    """The true values that are in runs of `fewest` or more."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], same, [False])).astype(np.int8)))
    found = np.zeros_like(same)
    for a, b in edges.reshape(-1, 2).tolist():
        found[a:b] = b - a >= fewest
    return found


def _note(who: str, question: str, rows: NDArray[np.int64], same: NDArray[np.bool_]) -> Iterator[str]:
    frames = np.append(False, same) | np.append(same, False)
    if frames.any():
        where = rows_in_words(rows[frames].tolist())
        yield f"{who} at exactly the same place in {np.count_nonzero(frames)} frames ({where}): {question}"


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
