"""Many trials in parallel processes; a crash counts as a fault like any other."""

from __future__ import annotations

import hashlib
import json
import math
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Final

from tests.fuzz.outcome import Outcome
from tests.fuzz.readers import corpus

FMUS: Final = corpus.ROOT / "build" / "fmi2"
#: Carries out cases until the last or the time is up; says before each its number, after it what was wrong.
_WORKER: Final = """
import json, resource, sys, time
from dataclasses import asdict
from pathlib import Path
from tests.fuzz.readers.trial import trial
first, step, last, end, corpus, keep = json.loads(sys.argv[1])
resource.setrlimit(resource.RLIMIT_AS, (1 << 33, 1 << 33))
case = first
while case < last and time.time() < end:
    print(json.dumps([case, None]), flush=True)
    fault = trial(case, Path(corpus), Path(keep))
    if fault is not None:
        print(json.dumps([case, asdict(fault)]), flush=True)
    case += step
"""


def fuzz_all(folder: Path, seconds: float, count: int | None, seed: int, processes: int) -> list[Outcome]:
    """Try for so long or so many, on so many processes.

    Args:
        folder: for the corpus, which is made if it is not there, and the files of trials with a fault
        seconds: how long, where there is no count
        count: how many cases
        seed: the number of the first case
        processes: how many at a time
    """
    files = folder / "readers"
    # What an earlier state of the project made may lack files.
    complete = files / f"complete-{hashlib.sha256(Path(corpus.__file__).read_bytes()).hexdigest()[:16]}"
    if not complete.exists():
        shutil.rmtree(files, ignore_errors=True)
        corpus.make(files, FMUS)
        complete.touch()
    # Infinity in JSON, as Python writes and reads it.
    last = math.inf if count is None else seed + count
    end = time.time() + seconds if count is None else math.inf

    def work(number: int) -> tuple[int, list[str]]:
        count, faults, first = 0, [], seed + number
        while first < last and time.time() < end:
            settings = json.dumps([first, processes, last, end, str(files), str(folder / "faults")])
            for line in _lines([sys.executable, "-c", _WORKER, settings]):
                if isinstance(line, str):
                    faults.append(f"case {first} ended its process: {line}")
                    break
                case, fault = line
                if fault is None:
                    first, count = case, count + 1
                else:
                    faults.append("case {case}: {subject}, {file} damaged\n{what}".format_map(fault))
            first += processes
        return count, faults

    with ThreadPoolExecutor(processes) as pool:
        found = list(pool.map(work, range(processes)))
    faults = [fault for _, some in found for fault in some]
    return [Outcome("readers of files", sum(count for count, _ in found), "\n\n".join(faults))]


def _lines(command: list[str]) -> Iterator[list[object] | str]:
    """What a worker says; last how it ended, if it was ended."""
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=corpus.ROOT
    ) as worker:
        assert worker.stdout is not None
        assert worker.stderr is not None
        try:
            yield from map(json.loads, worker.stdout)
            if worker.wait():
                yield f"exit code {worker.returncode}\n{worker.stderr.read()[-2000:]}"
        finally:
            worker.kill()
