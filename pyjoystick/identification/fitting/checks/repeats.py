"""Repeated records: their common part and their scatter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.support import FloatArray

#: Records are repeats if their motions differ by less than this part of their root mean square,
_ALIKE: Final = 0.3
#: and their sampling intervals by less than this part.
_SAME_RATE: Final = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Repeats:
    """Corresponding samples of repeated records: the same series at the same time after the release.

    Attributes:
        places: for each record, the group number of each sample, -1 for none
        counts: number of records in each group, 2 or more, shape (groups,)
        releases: number of records that repeat each repeated release
    """

    places: tuple[NDArray[np.intp], ...]
    counts: FloatArray
    releases: tuple[int, ...]

    @property
    def any(self) -> bool:
        """Whether anything was repeated."""
        return bool(self.counts.size)

    def means(self, values: Sequence[FloatArray]) -> FloatArray:
        """Mean of each group, given one array per record, shape (groups, ...)."""
        total = np.zeros((len(self.counts), *values[0].shape[1:]))
        for places, own in zip(self.places, values, strict=True):
            np.add.at(total, places[places >= 0], own[places >= 0])
        return np.asarray(total / self.counts.reshape(-1, *(1,) * (total.ndim - 1)))

    def deviations(self, values: Sequence[FloatArray]) -> list[FloatArray]:
        """The values minus the mean of their group, if they belong to one."""
        means = self.means(values)
        found = []
        for places, own in zip(self.places, values, strict=True):
            moved = own.copy()
            moved[places >= 0] -= means[places[places >= 0]]
            found.append(moved)
        return found

    def sizes(self, record: int) -> FloatArray:
        """Number of records in the group of each sample, 1 for samples without a group, shape (n,)."""
        places = self.places[record]
        if not self.any:
            return np.ones(len(places))
        return np.where(places >= 0, self.counts[places], 1.0)


def find_repeats(
    labels: Sequence[Sequence[str]], late: Sequence[FloatArray], motions: Sequence[FloatArray]
) -> Repeats:
    """Find records that repeat each other, by their fitted motions.

    Args:
        labels: name of the series of each sample, by record
        late: time of each sample after the release (s), by record
        motions: fitted motion at each sample, by record
    """
    keys = [_keys(*one) for one in zip(labels, late, strict=True)]
    steps = [_step(*one) for one in zip(labels, late, strict=True)]
    leaders: list[int] = []
    group_of: list[int] = []
    for k in range(len(keys)):
        same = (
            number
            for number, first in enumerate(leaders)
            if abs(steps[k] - steps[first]) <= _SAME_RATE * steps[first]
            and _alike(keys[first], motions[first], keys[k], motions[k])
        )
        number = next(same, len(leaders))
        if number == len(leaders):
            leaders.append(k)
        group_of.append(number)
    members: dict[tuple[int, str, int], list[int]] = {}
    for k, number in enumerate(group_of):
        for key in dict.fromkeys(keys[k]):
            members.setdefault((number, *key), []).append(k)
    several = {key: i for i, key in enumerate(key for key, own in members.items() if len(own) > 1)}
    places = tuple(
        np.array(
            [several.get((number, *key), -1) if own.index(key) == i else -1 for i, key in enumerate(own)],
            dtype=np.intp,
        )
        for number, own in zip(group_of, keys, strict=True)
    )
    repeated = dict.fromkeys(number for number, *_ in several)
    releases = tuple(group_of.count(number) for number in repeated)
    return Repeats(places, np.array([float(len(members[key])) for key in several]), releases)


def _step(labels: Sequence[str], late: FloatArray) -> float:
    """The usual sampling interval (s)."""
    own = late[np.array(labels) == labels[0]]
    return float(np.median(np.diff(own))) if len(own) > 1 else 1.0


def _keys(labels: Sequence[str], late: FloatArray) -> list[tuple[str, int]]:
    """Series and number of each sample, counted from the release."""
    step = _step(labels, late)
    return [(label, round(time / step)) for label, time in zip(labels, late.tolist(), strict=True)]


def _alike(
    keys: Sequence[tuple[str, int]],
    motion: FloatArray,
    others: Sequence[tuple[str, int]],
    other: FloatArray,
) -> bool:
    """Whether two motions agree up to small differences, over at least half of the samples."""
    place = {key: i for i, key in enumerate(keys)}
    pairs = [(place[key], i) for i, key in enumerate(others) if key in place]
    if 2 * len(pairs) < max(len(keys), len(others)):
        return False
    one, two = np.array(pairs).T
    size = float(np.sqrt(np.mean(motion[one] ** 2)))
    return float(np.sqrt(np.mean((motion[one] - other[two]) ** 2))) < _ALIKE * size
