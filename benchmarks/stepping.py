"""The cost of a 1 ms step from Python, and how well a loop of such steps keeps up with real time.

    python -m benchmarks.stepping

The joystick is released and driven by a torque that changes at every step. The share of the FMU is the time
of such a step in the compiled loop, which does nothing else.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import pandas as pd
import typer

from benchmarks.report import machine
from pyjoystick.fmu import Fmu, paced
from pyjoystick.support import FloatArray, TextTable

STEP = 1e-3
START = {"theta_start": -0.35}
_US = 1e6
#: A step that takes longer than this misses the bar (us).
BAR = 20.0


def main(
    fmus: Annotated[Path, typer.Option(metavar="DIR", help="Folder with fmi2/ and fmi3/.")] = Path("build"),
    steps: Annotated[int, typer.Option(min=10, help="Steps of each way.")] = 20000,
    seconds: Annotated[float, typer.Option(min=0.01, help="Duration of the loops in real time.")] = 5.0,
) -> None:
    """Time single steps, and the lateness of loops at 1 kHz; print Markdown."""
    typer.echo(f"{machine()}\n\n{table(fmus, steps, seconds)}\n\nThe bar is {BAR:g} us in this process.")


def table(fmus: Path, steps: int, seconds: float) -> str:
    """Return steps and lateness, one row per method."""
    ways = {
        "FMI 2, in this process": ("fmi2", False),
        "FMI 3, in this process": ("fmi3", False),
        "FMI 2, in its own process": ("fmi2", True),
    }
    rows = []
    for name, (folder, own_process) in ways.items():
        with Fmu(fmus / folder / "Joystick.fmu", own_process=own_process) as fmu:
            taken = step_times(fmu, steps)
            late = lateness(fmu, seconds)
            inner = compiled_step(fmu, steps)
        share = "" if own_process else f"{100.0 * inner / float(np.median(taken)):.0f}"
        rows.append([name, *_spread(taken), share, *_spread(late)])
    of_step = ("step, median (us)", "99 %", "largest")
    of_loop = ("late at 1 kHz, median (us)", "99 %", "largest")
    return TextTable(["", *of_step, "the FMU's share (%)", *of_loop], rows).markdown()


def torques(count: int) -> FloatArray:
    """Return a torque for each step (N m), no two consecutive ones equal."""
    return np.random.default_rng(1).uniform(-1.0, 1.0, count)


def step_times(fmu: Fmu, count: int) -> FloatArray:
    """Return the time of every step (s), shape (count,), without garbage collection in between."""
    taken = np.empty(count)
    values = torques(count).tolist()
    with fmu.start(parameters=START) as stepper:
        gc.collect()
        gc.disable()
        try:
            for i, torque in enumerate(values):
                begin = time.perf_counter()
                stepper.step(STEP, T=torque)
                taken[i] = time.perf_counter() - begin
        finally:
            gc.enable()
    return taken


def lateness(fmu: Fmu, seconds: float) -> FloatArray:
    """Return how late the steps of a real-time loop begin (s)."""
    values = torques(1000).tolist()
    with fmu.start(parameters=START) as stepper:
        late = []
        for i, one in enumerate(paced(STEP, seconds)):
            stepper.step(STEP, T=values[i % len(values)])
            late.append(one)
    return np.array(late)


def compiled_step(fmu: Fmu, count: int) -> float:
    """Return the time of such a step in the compiled loop (s)."""
    points = STEP * np.arange(count + 1)
    jumps = pd.DataFrame({"T": np.repeat(torques(count), 2)}, index=np.repeat(points, 2)[1:-1])
    plan = fmu.plan(points, parameters=START, inputs=jumps)
    plan.run()  # loads the compiler
    times = []
    for _ in range(5):
        begin = time.perf_counter()
        plan.run()
        times.append((time.perf_counter() - begin) / count)
    return min(times)


def _spread(times: FloatArray | Sequence[float]) -> list[str]:
    return [f"{_US * size:.3g}" for size in (*np.quantile(times, (0.5, 0.99)), np.max(times))]


if __name__ == "__main__":
    typer.run(main)
