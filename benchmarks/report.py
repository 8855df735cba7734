"""The results as Markdown and as JSON."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

from benchmarks.batches import BatchRow
from benchmarks.measurement import Row
from benchmarks.task import DURATION, INTERVALS, Law

_HEADER = (
    "| run | tolerance | time a run (ms) | largest error (rad) | RHS evaluations "
    "| ratio to hand-written (quartiles) | ratio to the FMU in C | ratio to the compiled loop |",
    "|---|---|---|---|---|---|---|---|",
)
_BATCH_HEADER = (
    "| runs | threads | runs a second | speedup (quartiles) | memory beyond that before (MiB) |",
    "|---|---|---|---|---|",
)


def machine() -> str:
    """Processor and number of cores."""
    cpuinfo = Path("/proc/cpuinfo")
    model = platform.processor() or platform.machine()
    if cpuinfo.is_file():
        lines = [line for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        model = lines[0].partition(":")[2].strip() if lines else model
    return f"{model}, {os.cpu_count()} cores"


def as_markdown(results: Mapping[Law, Sequence[Row]], batches: Sequence[BatchRow]) -> str:
    """A heading and a table for each damping law, and for the batches."""
    lines = []
    for law, rows in results.items():
        lines += [f"## Damping law: {law}", "", *_HEADER, *map(_line, rows), ""]
    lines += ["## Batches", "", *_BATCH_HEADER, *map(_batch_line, batches), ""]
    return "\n".join(lines)


def as_json(results: Mapping[Law, Sequence[Row]], batches: Sequence[BatchRow]) -> str:
    """All data of the tables, with the task and the machine."""
    document = {
        "machine": machine(),
        "duration_s": DURATION,
        "samples": INTERVALS + 1,
        "laws": {law: [asdict(row) for row in rows] for law, rows in results.items()},
        "batches": [asdict(row) for row in batches],
    }
    return json.dumps(document, indent=2)


def _line(row: Row) -> str:
    evaluations = "" if row.evaluations is None else str(row.evaluations)
    low, high = row.ratio_spread
    ratio = f"{_three(row.ratio)} ({_three(low)} to {_three(high)})"
    return (
        f"| {row.name} | {row.tolerance:.1e} | {_three(row.milliseconds)} | {row.error:.1e} "
        f"| {evaluations} | {ratio} | {_three(row.ratio_to_second)} | {_three(row.ratio_to_third)} |"
    )


def _batch_line(row: BatchRow) -> str:
    speedup, memory = "", "" if row.memory is None else _three(row.memory)
    if row.speedup is not None and row.speedup_spread is not None:
        low, high = row.speedup_spread
        speedup = f"{_three(row.speedup)} ({_three(low)} to {_three(high)})"
    return f"| {row.runs} | {row.threads} | {_three(row.rate)} | {speedup} | {memory} |"


def _three(value: float) -> str:
    """Three significant digits without an exponent."""
    return f"{value:.3g}" if value < 1000.0 else f"{value:.0f}"
