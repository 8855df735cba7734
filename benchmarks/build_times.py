"""How long the joystick's FMU takes to build, and how large it is: ``python -m benchmarks.build_times``.

With a warm cache of the C compiler: each build is done once before it is timed.
"""

from __future__ import annotations

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

_MODEL = "PreloadedSprings.Joystick.Joystick"
_CASES: dict[str, Sequence[str]] = {"this machine's": (), "all": ("--platform", "all")}


class _Build(NamedTuple):
    """Seconds from the command line's start to its end, and the size in kB."""

    seconds: float
    size: float


def main(
    rounds: Annotated[int, typer.Option(min=1, help="How often every build is timed.")] = 5,
) -> None:
    """Time the command that builds the joystick's FMU, for one platform and for all."""
    lines = [
        "| FMI | platforms | time (s), median | quickest and slowest | size (kB) |",
        "|---|---|---|---|---|",
    ]
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        for version in ("2", "3"):
            for name, platforms in _CASES.items():
                builds = [_build(version, platforms, Path(folder)) for _ in range(rounds + 1)][1:]
                seconds = sorted(build.seconds for build in builds)
                lines.append(
                    f"| {version}.0 | {name} | {statistics.median(seconds):.1f} "
                    f"| {seconds[0]:.1f} to {seconds[-1]:.1f} | {builds[0].size:.0f} |"
                )
    typer.echo("\n".join([machine(), "", *lines]))


def _build(version: str, platforms: Sequence[str], folder: Path) -> _Build:
    command = [sys.executable, "-m", "fmu_build", _MODEL, "--fmi", version, "--output", str(folder)]
    start = time.perf_counter()
    done = subprocess.run([*command, *platforms], capture_output=True, text=True, check=True)
    return _Build(time.perf_counter() - start, Path(done.stdout.strip()).stat().st_size / 1000.0)


if __name__ == "__main__":
    typer.run(main)
