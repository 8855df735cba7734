"""Many trials of random models in parallel processes; crashes and endless runs count as faults."""

from __future__ import annotations

import faulthandler
import itertools
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Final

from tests.fuzz.models.trial import Verdict, trial
from tests.fuzz.outcome import Outcome

#: How long a trial may take (s); most take 2 s.
_LIMIT: Final = 120.0


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
                yield from pool.map(_limited, some)
        except BrokenProcessPool:
            what = f"one of cases {some[0]} to {some[-1]} ended its process or took more than {_LIMIT:g} s"
            yield Verdict(some[0], "fault", what)


def _limited(case: int) -> Verdict:
    """A trial that ends its process, and prints where it was, when it takes too long."""
    faulthandler.dump_traceback_later(_LIMIT, exit=True)
    try:
        return trial(case)
    finally:
        faulthandler.cancel_dump_traceback_later()
