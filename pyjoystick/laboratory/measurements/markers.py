"""Trajectories of markers from a motion capture system, in SI units."""

from __future__ import annotations

import dataclasses
import difflib
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.motion import UNITS, RecordError, plain_unit, require_sampling
from pyjoystick.support import FloatArray

#: Minimum number of frames for an angle over time.
_FEWEST_FRAMES: Final = 3
#: No camera sees farther (m).
_FARTHEST: Final = 1000.0


@dataclass(frozen=True, slots=True, eq=False)
class Markers:
    """Positions of markers in each frame, without interpolation.

    Attributes:
        source: the file, or a note on their origin
        names: names of the k markers; may begin with a subject and a colon (``Joystick:TOP``)
        time: times of the frames (s), shape (n,), increasing
        positions: coordinates (m), shape (n, k, 3), NaN where a marker was not seen
        residuals: agreement of the cameras on each point (m), shape (n, k); None if the file has none
        rows: row of each frame, shape (n,): line numbers of a text file, frame numbers of a C3D file
        notes: doubts, one sentence each

    Raises:
        RecordError: fewer than three frames, the time does not increase or is likely in another unit, two
            markers have the same name, or a coordinate is infinite or beyond a kilometer
    """

    source: str
    names: tuple[str, ...]
    time: FloatArray
    positions: FloatArray
    residuals: FloatArray | None = None
    rows: NDArray[np.int64] = dataclasses.field(default_factory=lambda: np.empty(0, dtype=np.int64))
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        rows = self.rows if len(self.rows) else np.arange(len(self.time), dtype=np.int64)
        object.__setattr__(self, "rows", rows)
        if len(self.time) < _FEWEST_FRAMES:
            reason = f"has {len(self.time)} frames, at least {_FEWEST_FRAMES} are needed"
            raise RecordError(self.source, reason, "export the whole motion")
        for name in self.names:
            if self.names.count(name) > 1:
                raise RecordError(self.source, "two markers have one name", "rename one", column=name)
        backward = np.flatnonzero(~(np.diff(self.time) > 0.0)) + 1
        if backward.size:
            raise RecordError(
                self.source,
                "the time does not increase from the frame before",
                "export the frames of one recording in order, with enough digits of the time",
                column="time",
                rows=rows[backward],
                value=f"{self.time[backward[0]]:.9g} s",
            )
        require_sampling(self.source, self.time, rows)
        for name, places in zip(self.names, np.moveaxis(self.positions, 1, 0), strict=True):
            far = np.flatnonzero((np.abs(places) > _FARTHEST).any(axis=1))
            if far.size:
                raise RecordError(
                    self.source,
                    f"is not within {_FARTHEST:g} m",
                    "leave the coordinates of a marker that was not seen empty, or correct the unit",
                    column=name,
                    rows=rows[far],
                    value=f"{np.abs(places[far[0]]).max():g} m",
                )

    @property
    def rate(self) -> float:
        """Frame rate (Hz), from the median interval, which ignores gaps."""
        return 1.0 / float(np.median(np.diff(self.time)))

    def index(self, name: str) -> int:
        """Index of a marker in `names`; the subject may be omitted if that is unambiguous.

        Raises:
            RecordError: there is no such marker, or more than one
        """
        if name in self.names:
            return self.names.index(name)
        wanted = name.casefold()
        found = [i for i, one in enumerate(self.names) if wanted in _short_forms(one)]
        if len(found) == 1:
            return found[0]
        if found:
            advice = f"write one with its subject: {', '.join(self.names[i] for i in found)}"
            raise RecordError(self.source, f"has {len(found)} markers {name!r}", advice)
        near = difflib.get_close_matches(name, self.names, n=3, cutoff=0.5)
        advice = f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(self.names)}"
        raise RecordError(self.source, f"has no marker {name!r}", advice)

    def of(self, name: str) -> FloatArray:
        """Coordinates of a marker (m), shape (n, 3); raises as `index` does."""
        return self.positions[:, self.index(name)]

    def resolution(self, name: str) -> float:
        """Smallest change of a coordinate of a marker (m), as from rounding; 0 for one that does not move."""
        changes = np.abs(np.diff(self.of(name), axis=0))
        return float(min(changes[changes > 0.0], default=0.0))

    def missing(self, name: str) -> NDArray[np.bool_]:
        """Frames in which a marker was not seen, shape (n,)."""
        return unseen(self.of(name))


def unseen(positions: FloatArray) -> NDArray[np.bool_]:
    """Where a coordinate is NaN, for positions of shape (n, 3); shape (n,)."""
    return np.asarray(np.isnan(positions).any(axis=1), dtype=np.bool_)


def length_factor(source: str, unit: str, column: str) -> float:
    """Meters per unit, ignoring case.

    Raises:
        RecordError: the unit is not known
    """
    units = UNITS["length"]
    factor = units.get(plain_unit(unit).casefold())
    if factor is None:
        advice = f"known are {', '.join(units)}: correct the file, or give the unit as an option"
        reason = "has an unknown unit" if unit.strip() else "has no unit"
        raise RecordError(source, reason, advice, column=column, value=repr(unit) if unit.strip() else None)
    return factor


def _short_forms(name: str) -> tuple[str, ...]:
    """A name in lower case, with and without the subject."""
    folded = name.casefold()
    return folded, folded.rpartition(":")[2]
