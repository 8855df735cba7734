"""The benefit of exact derivatives for a fit: time, number of runs, and reproducibility of the answer.

    python -m benchmarks.fit_derivatives

Fits the synthetic records of the scenarios with default settings, alternately with sensitivities from the
FMUs and with finite differences. Searches that begin with different parts of the records reach the same
minimum; the difference of their answers is the uncertainty left by the search.
"""

from __future__ import annotations

import dataclasses
import statistics
import time
from pathlib import Path
from typing import Final
from unittest.mock import patch

import numpy as np
import typer

from benchmarks.report import machine
from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    DISPLACEMENT_DAMPING,
    POWER_LAW_DAMPING,
    Fit,
    FitSettings,
    fit,
)
from pyjoystick.motion import read_record
from pyjoystick.support import TextTable

_DATA: Final = Path(__file__).parents[1] / "scenarios" / "data"
_STAGES: Final = ((0.3, 0.6), (0.5,), (0.2, 0.4, 0.7))
_CASES: Final = {
    "C": (CONSTANT_DAMPING, "constant"),
    "displacement terms of eq. (11)": (DISPLACEMENT_DAMPING, "power_law"),
    "six of eq. (11)": (POWER_LAW_DAMPING, "power_law"),
}


def main() -> None:
    """Time the fits; print Markdown."""
    rows = []
    for name, (settings, kind) in _CASES.items():
        rows += [
            [name, "exact" if is_exact else "differences", *_cells(settings, kind, is_exact=is_exact)]
            for is_exact in (False, True)
        ]
    header = [
        "fitted",
        "derivatives",
        "runs",
        "CPU seconds",
        "answers differ by (standard errors)",
        "by (part of the value)",
    ]
    typer.echo(f"{machine()}\n\n{TextTable(header, rows).markdown()}")


def _cells(settings: FitSettings, kind: str, *, is_exact: bool) -> list[str]:
    """Return mean runs and seconds over the searches, and the largest difference of their answers."""
    records = [read_record(_DATA / f"synthetic_{kind}_{number}.csv") for number in range(1, 5)]
    found: list[Fit] = []
    seconds = []
    with Fmu(settings.fmu) as fmu, patch.object(Fmu, "sensitive", Fmu.sensitive if is_exact else None):
        for stages in _STAGES:
            search = dataclasses.replace(settings.search, stages=stages)
            begun = time.process_time()
            found.append(fit(records, dataclasses.replace(settings, search=search), fmu=fmu))
            seconds.append(time.process_time() - begun)
    shared = [j for j, one in enumerate(found[0].variables) if one.record is None]
    apart = np.ptp([one.x[shared] for one in found], axis=0)
    errors = apart / found[0].standard_errors.errors[shared]
    return [
        f"{statistics.mean(one.runs for one in found):.0f}",
        f"{statistics.mean(seconds):.2f}",
        f"{np.max(errors):.0e}",
        f"{np.max(apart / np.abs(found[0].x[shared])):.0e}",
    ]


if __name__ == "__main__":
    typer.run(main)
