"""Batches: the gain from a second core, and the memory for ten thousand runs."""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd

from benchmarks.errors import BenchmarkError
from benchmarks.memory import memory_of_process, reset_peak
from benchmarks.task import INTERVALS, TOLERANCE, sample_times
from pyjoystick.fmu import Extremes, Fmu, Peaks, Plan, Reduction
from pyjoystick.support import FloatArray

THREADS: Final = 2
#: Runs per batch in a round: enough to make the start and end of the threads negligible.
RUNS: Final = 5_000
#: Runs of the batches whose memory is compared.
FEW_RUNS, MANY_RUNS = 1_000, 10_000
#: The results kept of each run.
REDUCTIONS: Final[tuple[Reduction, ...]] = (Peaks("theta", 8, "omega"), Extremes("alpha"))


@dataclass(frozen=True, slots=True)
class BatchRow:
    """Measurements of a batch of free oscillations, reduced to peaks and extremes.

    Attributes:
        runs: number of runs
        threads: number of threads
        rate: runs per second, median over the rounds
        speedup: relative to one thread in the same round, median over the rounds; None if not measured
        speedup_spread: its first and third quartile
        memory: peak memory of the process during the batch minus that before (MiB); None if unknown
    """

    runs: int
    threads: int
    rate: float
    speedup: float | None = None
    speedup_spread: tuple[float, float] | None = None
    memory: float | None = None


def prepared(fmu: Fmu) -> Plan:
    """The run of the other benchmarks, with variable release and damping."""
    return fmu.plan(
        sample_times(INTERVALS),
        varied=("theta_start", "damping.C"),
        outputs=("theta", "omega", "alpha"),
        tolerance=TOLERANCE,
    )


def random_joysticks(runs: int) -> FloatArray:
    """Releases from -20 to 20 degrees and damping coefficients around the paper's, shape (runs, 2)."""
    random = np.random.default_rng(20)
    return np.column_stack([random.uniform(-0.35, 0.35, runs), random.uniform(0.03, 0.06, runs)])


def measure_batches(path: Path, rounds: int, on_round: Callable[[], None]) -> list[BatchRow]:
    """Time a batch on one and two threads alternately, and the large one in a separate process.

    Args:
        path: the FMU with constant damping
        rounds: 2 or more
        on_round: called after every round

    Raises:
        BenchmarkError: a run fails, or two threads give other results than one
    """
    with Fmu(path) as fmu:
        plan, table = prepared(fmu), random_joysticks(RUNS)
        expected, _ = _timed(plan, table, THREADS)
        times = []
        for _ in range(rounds):
            times.append([_same_again(plan, table, threads, expected) for threads in (1, THREADS)])
            on_round()
    speedups = [one / several for one, several in times]
    quartiles = statistics.quantiles(speedups, n=4, method="inclusive")
    rates = [RUNS / statistics.median(of_threads) for of_threads in zip(*times, strict=True)]
    return [
        BatchRow(RUNS, 1, rates[0], 1.0, (1.0, 1.0)),
        BatchRow(RUNS, THREADS, rates[1], statistics.median(speedups), (quartiles[0], quartiles[2])),
        *(_in_its_own_process(path, runs) for runs in (FEW_RUNS, MANY_RUNS)),
    ]


def _same_again(plan: Plan, table: FloatArray, threads: int, expected: pd.DataFrame) -> float:
    reduced, seconds = _timed(plan, table, threads)
    if not reduced.equals(expected):
        raise BenchmarkError(f"the batch on {threads} threads gave other results than the one before")
    return seconds


def _timed(plan: Plan, table: FloatArray, threads: int) -> tuple[pd.DataFrame, float]:
    start = time.perf_counter()
    batch = plan.run_batch(table, threads=threads, reductions=REDUCTIONS)
    elapsed = time.perf_counter() - start
    if batch.failed.any() or batch.reduced is None:
        raise BenchmarkError(f"a run of the batch failed: {next(filter(None, batch.messages))}")
    return batch.reduced, elapsed


def _in_its_own_process(path: Path, runs: int) -> BatchRow:
    command = [sys.executable, "-m", "benchmarks.batches", str(path), str(runs)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise BenchmarkError(f"the batch of {runs} runs failed:\n{done.stderr}".rstrip())
    result = json.loads(done.stdout)
    return BatchRow(runs, THREADS, runs / result["seconds"], memory=result["memory"])


def _main(path: str, runs: str) -> None:
    """Run one batch after a small one that creates the instances; print time (s) and memory (MiB) as JSON."""
    with Fmu(path) as fmu:
        plan, table = prepared(fmu), random_joysticks(int(runs))
        _timed(plan, table[:10], THREADS)
        before = memory_of_process("VmRSS")
        reset_peak()
        _, seconds = _timed(plan, table, THREADS)
        peak = memory_of_process("VmHWM")
    memory = None if before is None or peak is None else peak - before
    print(json.dumps({"seconds": seconds, "memory": memory}))


if __name__ == "__main__":
    _main(*sys.argv[1:])
