"""The row of the cluster: both ways give the same results, or there are no figures."""

from __future__ import annotations

import re
from pathlib import Path

import pandas as pd
import pytest

from benchmarks import cluster
from benchmarks.errors import BenchmarkError


def test_the_table_has_both_ways(joystick_fmus: Path) -> None:
    lines = cluster.as_markdown(joystick_fmus, runs=100, rounds=1).splitlines()
    assert lines[0] == "## Dask: 100 runs, medians of 1 rounds"
    rates = [float(re.split(r" *\| *", line)[2]) for line in lines[4:]]
    assert len(rates) == 2
    assert min(rates) > 0.0


def test_other_results_are_no_figures(joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "_batch", lambda sweep, plan: pd.DataFrame({"theta.peak1": [0.0]}))
    with pytest.raises(BenchmarkError, match="other results than the batch"):
        cluster.as_markdown(joystick_fmus, runs=100, rounds=1)
