"""The default experiment, run on the new library: what an importer can compare its own run with."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.packaging.platforms import Platform
from fmu_build.support.description import DefaultExperiment, ModelDescription, Variable
from fmu_build.support.request import FmiVersion

# Tighter than what anyone compares with it.
TOLERANCE = 1e-10
# What the rules of the FMI cross-check recommend at most.
_MOST_VARIABLES = 10
_MOST_INTERVALS = 300
_MOST_SECONDS = 60


@dataclass(frozen=True, slots=True)
class DefaultRun:
    """Values at every communication point.

    The inputs' are those that hold until the next point, the outputs' those of the step that ends there.
    """

    time: tuple[float, ...]
    inputs: dict[str, tuple[float, ...]]
    outputs: dict[str, tuple[float, ...]]


def run_default_experiment(
    library: bytes, platform: Platform, description: ModelDescription, guid: str, fmi_version: FmiVersion
) -> DefaultRun | str:
    """The run, or why there is none; `platform` is this machine's.

    The library runs in a process of its own, because a faulty one can kill the process.
    """
    outputs = _chosen(description)
    points = communication_points(description.default_experiment)
    if not outputs or not points:
        return "it has no outputs" if not outputs else "its stop time is not after its start time"
    inputs = _held_inputs(description, points)
    references = {variable.name: index for index, variable in enumerate(description.variables)}
    asked = {
        "version": fmi_version,
        "guid": guid,
        "identifier": description.identifier,
        "tolerance": TOLERANCE,
        "points": points,
        "input_references": [references[name] for name in inputs],
        "inputs": [[values[i] for values in inputs.values()] for i in range(len(points))],
        "outputs": [(variable.type, references[variable.name]) for variable in outputs],
    }
    with tempfile.TemporaryDirectory(prefix="fmu_build-", ignore_cleanup_errors=True) as folder:
        # Where FMPy looks for that of FMI 3, whatever it is told.
        binaries = Path(folder, "binaries", platform.folder(fmi_version))
        binaries.mkdir(parents=True)
        file = binaries / (description.identifier + platform.extension)
        file.write_bytes(library)
        rows = _rows(asked | {"folder": folder, "library": str(file)}, Path(folder, "run.json"))
    if isinstance(rows, str):
        return rows
    columns = dict(zip((variable.name for variable in outputs), zip(*rows, strict=True), strict=True))
    return DefaultRun(points, inputs, columns)


def communication_points(experiment: DefaultExperiment) -> tuple[float, ...]:
    """From start to stop in whole step sizes, few enough to be looked at, and where inputs change."""
    start, stop = experiment.start_time, experiment.stop_time
    if not start < stop < math.inf:
        return ()
    steps = max(1, round((stop - start) / experiment.step_size)) if experiment.step_size > 0 else 1
    intervals = math.ceil(steps / math.ceil(steps / _MOST_INTERVALS))
    grid = {round(start + (stop - start) * i / intervals, 12) for i in range(intervals)} | {stop}
    changes = {step.time for step in experiment.input_steps if start < step.time < stop}
    return tuple(sorted(grid | changes))


def _chosen(description: ModelDescription) -> list[Variable]:
    """The outputs, or the states of a model without any."""
    outputs = [v for v in description.variables if v.causality == "output"]
    states = [
        description.variables[v.derivative_of] for v in description.variables if v.derivative_of is not None
    ]
    return (outputs or states)[:_MOST_VARIABLES]


def _held_inputs(description: ModelDescription, points: Sequence[float]) -> dict[str, tuple[float, ...]]:
    """The real inputs by name, each with its value from every point to the next."""
    columns = {}
    for variable in description.variables:
        if variable.causality != "input" or variable.type != "Real":
            continue
        steps = [s for s in description.default_experiment.input_steps if variable.name in s.values]
        values = []
        for point in points:
            past = [step.values[variable.name] for step in steps if step.time <= point]
            values.append(past[-1] if past else float(variable.start or 0.0))
        columns[variable.name] = tuple(values)
    return columns


def _rows(asked: dict[str, object], file: Path) -> list[list[float]] | str:
    """What the outputs are at each point, or why they are not known."""
    file.write_text(json.dumps(asked), "utf-8")
    script = Path(__file__).with_name("run_library.py")
    try:
        done = subprocess.run(
            [sys.executable, "-P", str(script), str(file)],
            capture_output=True,
            text=True,
            errors="replace",
            timeout=_MOST_SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"it did not end within {_MOST_SECONDS} s"
    if done.returncode != 0:
        return (done.stdout + done.stderr).strip() or f"its process ended with {done.returncode}"
    rows: list[list[float]] = json.loads(file.read_text("utf-8"))
    if not all(math.isfinite(value) for row in rows for value in row):
        return "an output is not finite"
    return rows
