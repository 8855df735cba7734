"""Runs that are interrupted and resumed from saved states, for both FMI versions."""

from __future__ import annotations

import random

from tests.fmu_build.runtime.library import Instance
from tests.fmu_build.runtime.library3 import Instance3

SIZE = 0.003
_END = 300


def steps(instance: Instance | Instance3, first: int, last: int) -> list[list[float]]:
    """Values of the first two variables after each of the steps from `first` to `last`."""
    values = []
    for i in range(first, last):
        instance.advance(i * SIZE, SIZE)
        values.append(instance.get(0, 1))
    return values


def check_detours(instance: Instance | Instance3, reset: str, seed: int) -> None:
    """Goes ahead, and back to where it was, again and again: the detours must leave no trace."""
    instance.initialize()
    straight = steps(instance, 0, _END)
    instance.expect(reset)
    instance.initialize()
    random.seed(seed)
    done = 0
    while done < _END:
        state = instance.save()
        steps(instance, done, min(_END, done + random.randint(1, 40)))
        instance.restore(state)
        instance.discard(state)
        further = min(_END, done + random.randint(1, 40))
        assert steps(instance, done, further) == straight[done:further]
        done = further
    instance.free()
