"""The cost of isolating an FMU: the same FMU in this process, in a separate one, and in a sandbox.

    python -m benchmarks.own_process

The runs are those of `python -m benchmarks`: the joystick's release with constant damping, 901 samples. The
foreign FMU is a copy that names another generation tool and gets a new instance for each run. The one for the
sandbox is a copy with the WebAssembly module built from the same sources.
"""

from __future__ import annotations

import shutil
import statistics
import tempfile
import time
import zipfile
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from benchmarks.report import machine
from fmu_build.packaging import wasm_module
from fmu_build.packaging.module import module_name
from pyjoystick.fmu import Extremes, Fmu, Peaks, find_fmu
from pyjoystick.support import TextTable

_SINGLE = 100


def main(
    rounds: Annotated[int, typer.Option(min=1, help="How often every way is timed.")] = 5,
    runs: Annotated[int, typer.Option(min=10, help="Of a batch.")] = 2000,
    least: Annotated[
        bool, typer.Option("--least", help="The least times in place of the medians, on a busy machine.")
    ] = False,
) -> None:
    """Time opening, single runs and batches on one thread and two; print Markdown."""
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        typer.echo(f"{machine()}\n\n{table(Path(folder), rounds, runs, least=least)}")


def table(folder: Path, rounds: int, runs: int, *, least: bool = False) -> str:
    """Return medians, or least times, over rounds in which all methods take turns."""
    typical = min if least else statistics.median
    own = find_fmu("Joystick")
    ways: dict[str, Callable[[], Fmu]] = {
        "in this process": lambda: Fmu(own),
        "in its own": lambda: Fmu(own, own_process=True),
        "in its own, a new instance each": lambda: Fmu(_renamed(own, folder / "other.fmu")),
        "in a sandbox": partial(Fmu, _with_module(own, folder / "module.fmu"), sandbox=True),
    }
    times: dict[str, list[list[float]]] = {name: [] for name in ways}
    with ExitStack() as stack:
        plans = {}
        for name, way in ways.items():
            plans[name] = _plan(stack.enter_context(way()))
            for threads in (1, 2):  # start the processes and load the compiler
                _batch(plans[name], 50 * threads, threads)
        for _ in range(rounds):
            for name, way in ways.items():
                times[name].append([*_opening(way), *_running(plans[name], runs)])
    rows = []
    for name, measured in times.items():
        opening, single, one, two = (typical(column) for column in zip(*measured, strict=True))
        rows.append([name, f"{opening:.2f}", f"{1e3 * single:.2f}", f"{runs / one:.0f}", f"{runs / two:.0f}"])
    header = ["an FMU", "opening (s)", "a run by itself (ms)", "runs/s, one thread", "runs/s, two threads"]
    return TextTable(header, rows).markdown()


def _renamed(fmu: Path, target: Path) -> Path:
    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(target, "w") as copy:
        for name in source.namelist():
            copy.writestr(name, source.read(name).replace(b'generationTool="pyj', b'generationTool="j'))
    return target


def _with_module(fmu: Path, target: Path) -> Path:
    shutil.copy(fmu, target)
    with zipfile.ZipFile(target, "a") as copy:
        if module_name(fmu.stem) not in copy.namelist():
            copy.writestr(module_name(fmu.stem), wasm_module(fmu))
    return target


def _plan(fmu: Fmu) -> Any:
    outputs = ("theta", "omega", "alpha")
    return fmu.plan(np.linspace(0.0, 1.5, 901), varied=("theta_start", "damping.C"), outputs=outputs)


def _opening(way: Callable[[], Fmu]) -> list[float]:
    begin = time.perf_counter()
    way().close()
    return [time.perf_counter() - begin]


def _running(plan: Any, runs: int) -> list[float]:
    begin = time.perf_counter()
    for _ in range(_SINGLE):
        plan.run([-0.35, 0.05])
    single = (time.perf_counter() - begin) / _SINGLE
    return [single, *(_batch(plan, runs, threads) for threads in (1, 2))]


def _batch(plan: Any, runs: int, threads: int) -> float:
    rows = np.column_stack([np.full(runs, -0.35), np.linspace(0.03, 0.06, runs)])
    begin = time.perf_counter()
    batch = plan.run_batch(rows, threads=threads, reductions=[Peaks("theta", 8), Extremes("alpha")])
    assert not batch.failed.any()
    return time.perf_counter() - begin


if __name__ == "__main__":
    typer.run(main)
