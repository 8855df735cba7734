"""Many trials of random models, shared among processes: one that ends its process is a fault, too."""

from __future__ import annotations

import itertools
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context

from tests.fuzz.models.trial import Verdict, trial
from tests.fuzz.outcome import Outcome


def fuzz_all(seconds: float, count: int | None, seed: int, processes: int) -> list[Outcome]:
    """Try for so long or so many, from the case of the number `seed` on."""
    end = time.time() + seconds if count is None else None
    cases = itertools.count(seed) if count is None else iter(range(seed, seed + count))
    found = list(_verdicts(cases, end, processes))
    kinds = Counter(one.kind for one in found)
    print(f"random models: {kinds['right']} right, {kinds['refused']} refused", flush=True)
    faults = "\n\n".join(f"case {one.case}: {one.what}" for one in found if one.kind == "fault")
    return [Outcome("random models", len(found), faults)]


def _verdicts(cases: Iterator[int], end: float | None, processes: int) -> Iterator[Verdict]:
    """Begin no new case after the end."""
    while end is None or time.time() < end:
        some = list(itertools.islice(cases, 4 * processes))
        if not some:
            return
        try:
            with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
                yield from pool.map(trial, some)
        except BrokenProcessPool:
            yield Verdict(some[0], "fault", f"one of the cases {some[0]} to {some[-1]} ended its process")
