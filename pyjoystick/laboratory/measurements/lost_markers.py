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
#: A marker that repeats its place this many times stays there, if few frames repeat the one before otherwise.
_FROZEN: Final = 5
_BY_CHANCE: Final = 0.01


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
    """Note a marker that stays exactly where it is for some frames, but moves or trembles in all others.

    Where the other markers do not move either, it is at rest.
    """
    still = (np.diff(positions, axis=0) == 0.0).all(axis=2)
    for i, name in enumerate(markers.names):
        path, same = positions[:, i], still[:, i] & ~np.delete(still, i, axis=1).all(axis=1)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], same, [False])).astype(np.int8)))
        runs = [(a, b) for a, b in edges.reshape(-1, 2).tolist() if b - a >= _FROZEN]
        inner = [
            (a, b) for a, b in runs if a > 0 and b < len(same) and not unseen(path[[a - 1, b + 1]]).any()
        ]
        outside = np.count_nonzero(same) - sum(b - a for a, b in inner)
        if inner and outside <= _BY_CHANCE * len(same):
            frames = markers.rows[np.concatenate([np.arange(a, b + 1) for a, b in inner])]
            yield (
                f"marker {name} is at exactly the same place in {len(frames)} frames "
                f"({rows_in_words(frames.tolist())}): was it lost there?"
            )


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
