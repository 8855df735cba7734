"""Runs per second on a Dask cluster of two worker processes, against two threads of one process.

``python -m benchmarks.cluster`` prints the figures as Markdown.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import pandas as pd
import typer

from benchmarks.dask_processes import DaskProcesses
from benchmarks.errors import BenchmarkError
from benchmarks.report import machine
from pyjoystick.fmu import Fmu, Plan
from pyjoystick.runs import ClusterError, Sweep, read_settings
from pyjoystick.runs.sweeps.cluster import run_on_cluster

_WORKERS: Final = 2
_PATIENCE: Final = 60.0  # s, to wait for the workers
#: The free oscillations of the other rows: 1.5 s with 901 samples, reduced to peaks.
_SETTINGS: Final = """
[fmu]
path = "{fmu}"
[experiment]
duration = 1.5
output_interval = 0.0016666666666666668
tolerance = 1e-8
[sampling]
method = "random"
count = {runs}
[vary."damping.C"]
distribution = "uniform"
low = 0.03
high = 0.06
[vary.theta_start]
distribution = "uniform"
low = "-20deg"
high = "20deg"
[[results]]
kind = "peaks"
variable = "theta"
derivative = "omega"
count = 5
[[results]]
kind = "loss"
variable = "E"
"""


def main(
    fmus: Annotated[Path, typer.Option(metavar="DIR", help="Folder with the FMUs.")] = Path("build/fmi2"),
    runs: Annotated[int, typer.Option(min=100, help="Runs of a sweep.")] = 20_000,
    rounds: Annotated[int, typer.Option(min=1, help="How often each way is timed.")] = 5,
) -> None:
    """Time the same runs in a batch on two threads and on a cluster of two worker processes, alternately.

    The time of the cluster includes the whole sweep: connecting, sending and opening the FMU, the runs, and
    collecting the results.
    """
    typer.echo(f"{machine()}\n\n{as_markdown(fmus, runs, rounds)}", nl=False)


def as_markdown(fmus: Path, runs: int = 20_000, rounds: int = 5) -> str:
    """A heading and the table; the arguments are those of `main`.

    Raises:
        BenchmarkError: Dask does not start, or gives other results than the batch
    """
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        batch, cluster = _measure(fmus / "Joystick.fmu", runs, rounds, Path(folder))
    ratios = [b / c for b, c in zip(batch, cluster, strict=True)]
    rates = [runs / statistics.median(times) for times in (batch, cluster)]
    lines = (
        f"## Dask: {runs} runs, medians of {rounds} rounds",
        "",
        "| way | runs/s | ratio to the batch |",
        "|---|---|---|",
        f"| batch, {_WORKERS} threads | {rates[0]:.0f} | 1 |",
        f"| Dask, {_WORKERS} worker processes | {rates[1]:.0f} | {statistics.median(ratios):.2f} |",
    )
    return "\n".join(lines) + "\n"


def _measure(fmu: Path, runs: int, rounds: int, folder: Path) -> tuple[list[float], list[float]]:
    """Return the times (s) of both methods per round; raises BenchmarkError if their results differ."""
    settings = folder / "sweep.toml"
    settings.write_text(_SETTINGS.format(fmu=fmu.resolve(), runs=runs), encoding="utf-8")
    sweep = Sweep(read_settings(settings))
    dask = DaskProcesses(folder)
    try:
        dask.start(_WORKERS)
        with Fmu(fmu) as opened:
            plan = sweep.task.plan(opened)
            _wait_for_workers(sweep, dask)
            times: list[tuple[float, float]] = []
            # The first round compiles the loops, in this process and on the workers.
            for _ in range(rounds + 1):
                local, expected = _timed(lambda: _batch(sweep, plan))
                remote, found = _timed(lambda: _cluster(sweep, dask.address))
                if not expected.equals(found):
                    raise BenchmarkError("the cluster has other results than the batch")
                times.append((local, remote))
    finally:
        dask.stop()
    return [one[0] for one in times[1:]], [one[1] for one in times[1:]]


def _timed(work: Callable[[], pd.DataFrame]) -> tuple[float, pd.DataFrame]:
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def _batch(sweep: Sweep, plan: Plan) -> pd.DataFrame:
    result = plan.run_batch(sweep.design, threads=_WORKERS, reductions=sweep.settings.results)
    assert result.reduced is not None
    return pd.DataFrame(result.reduced.to_numpy(), columns=sweep.columns)


def _cluster(sweep: Sweep, address: str) -> pd.DataFrame:
    values = np.full((len(sweep.design), len(sweep.columns)), np.nan)
    pending = np.arange(len(sweep.design))
    for part in run_on_cluster(sweep, pending, address, lambda _: None, lambda _: None):
        values[part.runs] = part.values
    return pd.DataFrame(values, columns=sweep.columns)


def _wait_for_workers(sweep: Sweep, dask: DaskProcesses) -> None:
    end = time.monotonic() + _PATIENCE
    for count in range(1, 10_000):
        try:
            list(run_on_cluster(sweep, np.arange(4), dask.address, lambda _: None, lambda _: None))
        except ClusterError as error:
            if time.monotonic() > end:
                raise BenchmarkError(f"the workers do not start: {error} ({count} attempts)") from error
            time.sleep(0.2)
        else:
            return


if __name__ == "__main__":
    typer.run(main)
