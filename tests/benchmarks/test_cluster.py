"""The cluster benchmark: both methods must give the same results, or no figures are printed."""

from __future__ import annotations

import re
from pathlib import Path

import pandas as pd
import pytest

from benchmarks import cluster
from benchmarks.dask_processes import DaskProcesses
from benchmarks.errors import BenchmarkError
from pyjoystick.fmu import Plan
from pyjoystick.runs import Sweep


def test_the_table_has_both_ways(joystick_fmus: Path) -> None:
    lines = cluster.as_markdown(joystick_fmus, runs=100, rounds=1).splitlines()
    assert lines[0] == "## Dask: 100 runs, medians of 1 rounds"
    rates = [float(re.split(r" *\| *", line)[2]) for line in lines[4:]]
    assert len(rates) == 2
    assert min(rates) > 0.0


def test_other_results_are_no_figures(joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    batch = cluster._batch
    tables: list[pd.DataFrame] = []

    class Processes(DaskProcesses):
        """None: the cluster is that of the test above, here it gives what the batch gave."""

        def start(self, workers: int) -> None:
            pass

    def other(sweep: Sweep, plan: Plan) -> pd.DataFrame:
        tables.append(batch(sweep, plan))
        return tables[-1] * (1.0 if len(tables) == 1 else 1.0 + 1e-15)

    monkeypatch.setattr(cluster, "DaskProcesses", Processes)
    monkeypatch.setattr(cluster, "_wait_for_workers", lambda sweep, dask: None)
    monkeypatch.setattr(cluster, "_cluster", lambda sweep, address: tables[-1])
    monkeypatch.setattr(cluster, "_batch", other)
    with pytest.raises(BenchmarkError, match="other results than the batch"):
        cluster.as_markdown(joystick_fmus, runs=100, rounds=1)
    assert len(tables) == 2, "the first round agrees"
