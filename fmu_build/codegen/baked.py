"""Find baked parameters: the compiler has put their values into the equations, so setting them has no effect.

A parameter is free if its value does not change the equations and if every parameter that depends on it is
computed from it when the FMU is initialized. `trials` compiles the model with other values; `probes` chooses
values that reveal branches.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence

from fmu_build.codegen.trials import Candidate, Trials


def baked_parameters(trials: Trials) -> frozenset[str]:
    """Return the names of the parameters (arrays as a whole) that cannot be set after compilation."""
    layers = (layer for kind in trials.kinds for layer in _layers(trials, kind))
    return trials.untried.union(name for layer in layers for name in _search(trials, layer))


def _layers(trials: Trials, group: Sequence[Candidate]) -> Iterator[list[Candidate]]:
    """Split the candidates into groups in which none depends on another.

    If both were set in the same trial, nobody would see that the dependent one ignores the other at run time.
    """
    remaining = list(group)
    while remaining:
        moved = followers_of(trials, remaining)
        followers = [one for one in remaining if moved.intersection(one.names)]
        if len(followers) == len(remaining):
            break
        yield [one for one in remaining if one not in followers]
        remaining = followers
    yield from ([one] for one in remaining)


def followers_of(trials: Trials, group: Sequence[Candidate]) -> set[str]:
    """Return the parameters whose values the compiler has derived from those of parameters in the group."""
    return {name for chosen in halves(group) for name in trials.followers(chosen)}


def halves(group: Sequence[Candidate]) -> list[list[Candidate]]:
    """Return the candidates to set in each trial, such that no candidate is always set together with another.

    Each is set in a different selection of half of the trials, rounded up.
    """
    count = next(n for n in itertools.count(min(len(group), 1)) if math.comb(n, n // 2) >= len(group))
    own = list(zip(group, itertools.combinations(range(count), (count + 1) // 2), strict=False))
    return [[one for one, half in own if trial in half] for trial in range(count)]


def _search(trials: Trials, group: Sequence[Candidate]) -> Iterator[str]:
    """Yield the baked parameters of a group: bisect it until a part is free or holds a single candidate."""
    if _is_free(trials, group):
        return
    if len(group) == 1:
        fallback = group[0].fallback
        yield from _search(trials, [fallback]) if fallback else group[0].names
        return
    middle = len(group) // 2
    yield from _search(trials, group[:middle])
    yield from _search(trials, group[middle:])


def _is_free(trials: Trials, group: Sequence[Candidate]) -> bool:
    present = trials.compiled([one.present for one in group])
    other = trials.compiled([one.other for one in group])
    if present is None or other is None or not present.computes_as(other):
        return False
    if not present.changed(other) <= trials.computed | {name for one in group for name in one.names}:
        return False
    probes = (trials.compiled(settings) for settings in zip(*(one.probes for one in group), strict=True))
    return all(probe is None or probe.equations == present.equations for probe in probes)
