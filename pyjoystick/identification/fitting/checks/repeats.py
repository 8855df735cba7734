"""Records that repeat each other: what they have in common, and what differs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.support import FloatArray

#: Records repeat each other if their motions differ by less than this part of their root mean square.
_ALIKE: Final = 0.3
#: Their intervals between samples differ by less than this part.
_SAME_RATE: Final = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Repeats:
    """Samples of different records that belong together: the same series, the same time after the release.

    Attributes:
        places: for each record, the number of the group that each sample belongs to, -1 for none
        counts: how many records each group has, 2 or more, shape (groups,)
        releases: how many records repeat each of the releases that were repeated
    """

    places: tuple[NDArray[np.intp], ...]
    counts: FloatArray
    releases: tuple[int, ...]

    @property
    def any(self) -> bool:
        """Whether anything was repeated."""
        return bool(self.counts.size)

    def means(self, values: Sequence[FloatArray]) -> FloatArray:
        """Mean over each group, of one array a record, shape (groups, ...)."""
        total = np.zeros((len(self.counts), *values[0].shape[1:]))
        for places, own in zip(self.places, values, strict=True):
            np.add.at(total, places[places >= 0], own[places >= 0])
        return np.asarray(total / self.counts.reshape(-1, *(1,) * (total.ndim - 1)))

    def deviations(self, values: Sequence[FloatArray]) -> list[FloatArray]:
        """The values less the mean of their group, where they have one."""
        means = self.means(values)
        found = []
        for places, own in zip(self.places, values, strict=True):
            moved = own.copy()
            moved[places >= 0] -= means[places[places >= 0]]
            found.append(moved)
        return found

    def sizes(self, record: int) -> FloatArray:
        """How many records the group of each sample has, 1 where it has none, shape (n,)."""
        places = self.places[record]
        if not self.any:
            return np.ones(len(places))
        return np.where(places >= 0, self.counts[places], 1.0)


def find_repeats(
    labels: Sequence[Sequence[str]], late: Sequence[FloatArray], motions: Sequence[FloatArray]
) -> Repeats:
    """The records that repeat each other, by their fitted motions.

    Args:
        labels: name of the series of each sample, by record
        late: its time after the release (s), by record
        motions: the fitted motion at it, by record
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
    """The usual time between two samples (s)."""
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
    """Whether two motions are the same but for small differences, over at least half of the samples."""
    place = {key: i for i, key in enumerate(keys)}
    pairs = [(place[key], i) for i, key in enumerate(others) if key in place]
    if 2 * len(pairs) < max(len(keys), len(others)):
        return False
    one, two = np.array(pairs).T
    size = float(np.sqrt(np.mean(motion[one] ** 2)))
    return float(np.sqrt(np.mean((motion[one] - other[two]) ** 2))) < _ALIKE * size
