"""The cost of sensitivities: run time of the joysticks' FMUs with them, relative to the same run without.

    python -m benchmarks.sensitivities

Free oscillation from -20 degrees, 1.5 s, 901 samples of the angle, tolerance 1e-8, one thread, alternating.
Steps also control the errors of the sensitivities, so a run takes more of them.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer

from benchmarks.report import machine
from benchmarks.task import INTERVALS, LAWS, MODELS, RELEASE, TOLERANCE, Law, sample_times
from fmu_build import build_fmu
from pyjoystick.fmu import Fmu, Plan
from pyjoystick.support import TextTable

#: The parameters of each law; a case with n parameters uses the first n.
PARAMETERS: Final[dict[Law, tuple[str, ...]]] = {
    "constant": ("damping.C", "J", "theta_start", "omega_start", "m", "forward.returnSpring.k_s"),
    "power-law": ("damping.B", "damping.A_neg", "damping.n_neg", "theta_start", "J", "damping.m"),
}
NUMBERS: Final = (1, 3, 6)
#: Runs in a timed batch.
RUNS: Final = 100


def main(rounds: Annotated[int, typer.Option(min=2, help="How often each batch is timed.")] = 15) -> None:
    """Time the runs; print Markdown."""
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        typer.echo(f"{machine()}\n\n{table(Path(folder), rounds)}")


def table(folder: Path, rounds: int) -> str:
    """One row per law and number of parameters: the ratio with its quartiles, and the ratio per parameter."""
    rows = []
    for law in LAWS:
        for number in NUMBERS:
            low, ratio, high = _ratios(folder, law, number, rounds)
            each = (ratio - 1.0) / number
            rows.append([law, str(number), f"{ratio:.2f} ({low:.2f} to {high:.2f})", f"{each:.2f}"])
    header = ["damping law", "parameters", "times the run without (quartiles)", "more by each parameter"]
    return TextTable(header, rows).markdown()


def _ratios(folder: Path, law: Law, number: int, rounds: int) -> tuple[float, float, float]:
    """Return first quartile, median and third quartile of the ratios in each round."""
    model = f"PreloadedSprings.Joystick.{MODELS[law]}"
    request = f"theta:{','.join(PARAMETERS[law][:number])}"
    without = build_fmu(model, folder / "without").path
    with_them = build_fmu(model, folder / f"{number}", sensitivity=request).path
    with Fmu(without) as plain, Fmu(with_them) as extended:
        plans = [_plan(plain), _plan(extended)]
        for plan in plans:
            _seconds(plan)
        times = [[_seconds(plan) for plan in plans] for _ in range(rounds)]
    low, middle, high = statistics.quantiles([b / a for a, b in times], n=4, method="inclusive")
    return low, middle, high


def _plan(fmu: Fmu) -> Plan:
    times = sample_times(INTERVALS)
    return fmu.plan(times, varied=["theta_start"], outputs=["theta"], tolerance=TOLERANCE)


def _seconds(plan: Plan) -> float:
    """Return the processor seconds of a batch, which other programs disturb less than elapsed time."""
    begun = time.process_time()
    plan.run_batch(np.full((RUNS, 1), RELEASE), threads=1)
    return time.process_time() - begun


if __name__ == "__main__":
    typer.run(main)
