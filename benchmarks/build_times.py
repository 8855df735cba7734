"""Build time and size of the joystick's FMU: ``python -m benchmarks.build_times``.

The compiler's cache is warm: each build runs once before it is timed.
"""

from __future__ import annotations

import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, NamedTuple

import typer

from benchmarks.report import machine
from pyjoystick.support import TextTable

_MODEL = "PreloadedSprings.Joystick.Joystick"
_CASES: dict[str, Sequence[str]] = {"this machine's": (), "all": ("--platform", "all")}


class _Build(NamedTuple):
    """Elapsed seconds, processor seconds, and size in kB."""

    seconds: float
    processor_seconds: float
    size: float


def main(
    rounds: Annotated[int, typer.Option(min=1, help="How often every build is timed.")] = 5,
) -> None:
    """Time the command that builds the joystick's FMU, for one platform and for all; medians."""
    rows = []
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        for version in ("2", "3"):
            for name, platforms in _CASES.items():
                builds = [_build(version, platforms, Path(folder)) for _ in range(rounds + 1)][1:]
                medians = [statistics.median(values) for values in zip(*builds, strict=True)]
                rows.append([f"{version}.0", name, *(f"{value:.3g}" for value in medians)])
    header = ["FMI", "platforms", "time (s)", "processor time (s)", "size (kB)"]
    typer.echo("\n".join([machine(), "", TextTable(header, rows).markdown()]))


def _build(version: str, platforms: Sequence[str], folder: Path) -> _Build:
    command = [sys.executable, "-m", "fmu_build", _MODEL, "--fmi", version, "--output", str(folder)]
    start, used = time.perf_counter(), _processor_seconds()
    done = subprocess.run([*command, *platforms], capture_output=True, text=True, check=True)
    size = Path(done.stdout.strip()).stat().st_size / 1000.0
    return _Build(time.perf_counter() - start, _processor_seconds() - used, size)


def _processor_seconds() -> float:
    """Return the processor time of all finished child processes."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


if __name__ == "__main__":
    typer.run(main)
