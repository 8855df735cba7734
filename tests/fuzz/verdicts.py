"""Many trials with a verdict each, in parallel processes; crashes and endless runs count as faults."""

from __future__ import annotations

import faulthandler
import itertools
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from typing import Final, Literal, TypeAlias

from tests.fuzz.outcome import Outcome

#: How long a trial may take (s); most take 2 s or less.
_LIMIT: Final = 120.0
#: Trials that a process carries out at a time.
_SOME: Final = 4


@dataclass(frozen=True)
class Verdict:
    """How a trial ended; `what` says why the input was refused, what the note was, or what was wrong."""

    case: int
    kind: Literal["right", "noted", "refused", "fault"]
    what: str = ""


Trial: TypeAlias = Callable[[int], Verdict]


def try_all(
    target: str, trial: Trial, seconds: float, count: int | None, seed: int, processes: int
) -> list[Outcome]:
    """Try for so long or so many.

    Args:
        target: what is tried
        trial: carries out the trial of a number
        seconds: how long, where there is no count
        count: how many trials
        seed: the number of the first
        processes: how many at a time
    """
    end = time.time() + seconds if count is None else None
    cases = itertools.count(seed) if count is None else iter(range(seed, seed + count))
    found = list(_verdicts(trial, cases, end, processes))
    kinds = Counter(one.kind for one in found if one.kind != "fault")
    print(f"{target}: {', '.join(f'{number} {kind}' for kind, number in sorted(kinds.items()))}", flush=True)
    faults = "\n\n".join(f"case {one.case}: {one.what}" for one in found if one.kind == "fault")
    return [Outcome(target, len(found), faults)]


def _verdicts(trial: Trial, cases: Iterator[int], end: float | None, processes: int) -> Iterator[Verdict]:
    """Begin no new case after the end."""
    while end is None or time.time() < end:
        some = list(itertools.islice(cases, _SOME * processes))
        if not some:
            return
        try:
            with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
                yield from pool.map(partial(_limited, trial), some)
        except BrokenProcessPool:
            what = f"one of cases {some[0]} to {some[-1]} ended its process or took more than {_LIMIT:g} s"
            yield Verdict(some[0], "fault", what)


def _limited(trial: Trial, case: int) -> Verdict:
    """Carry out a trial; where it takes too long, the process ends and prints where it was."""
    faulthandler.dump_traceback_later(_LIMIT, exit=True)
    try:
        return trial(case)
    finally:
        faulthandler.cancel_dump_traceback_later()
