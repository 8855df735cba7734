"""Run the default experiment with the new library, as a reference for importers."""

from __future__ import annotations

import json
import math
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from fmu_build.packaging.platforms import Platform
from fmu_build.packaging.scripts import run_script
from fmu_build.support.description import DefaultExperiment, ModelDescription, Variable
from fmu_build.support.request import FmiVersion
from fmu_build.support.temporary import temporary_folder

# Tighter than the tolerance of any comparison with it.
TOLERANCE = 1e-10
# Upper limits recommended by the rules of the FMI cross-check.
_MOST_VARIABLES = 10
_MOST_INTERVALS = 300
_MOST_SECONDS = 60
#: Parts of the run after which all values are kept.
_SNAPSHOTS = (0.0, 0.137, 0.382, 0.618, 0.863, 1.0)


Snapshot: TypeAlias = tuple[float, dict[str, float]]
"""A time, with the values of all variables."""


@dataclass(frozen=True, slots=True)
class DefaultRun:
    """Values at every communication point.

    Input values hold until the next point; output values are those at the end of the step to this point.
    """

    time: tuple[float, ...]
    inputs: dict[str, tuple[float, ...]]
    outputs: dict[str, tuple[float, ...]]
    snapshots: tuple[Snapshot, ...] = ()
    """The start and some later times."""


def run_default_experiment(
    library: bytes, platform: Platform, description: ModelDescription, guid: str, fmi_version: FmiVersion
) -> DefaultRun | str:
    """Return the run, or the reason why it is missing; `platform` is this machine's.

    The library runs in a separate process, because a faulty one can crash it.
    """
    outputs = _chosen(description)
    points = communication_points(description.default_experiment)
    if not points:
        return "its stop time is not after its start time"
    inputs = _held_inputs(description, points)
    snapshots = sorted({round(part * (len(points) - 1)) for part in _SNAPSHOTS})
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
        "snapshots": snapshots,
        "all": [(variable.type, references[variable.name]) for variable in description.variables],
    }
    with temporary_folder() as folder:
        # FMPy looks for a library of FMI 3 here, whatever path it is given.
        binaries = folder / "binaries" / platform.folder(fmi_version)
        binaries.mkdir(parents=True)
        file = binaries / (description.identifier + platform.extension)
        file.write_bytes(library)
        found = _values(asked | {"folder": str(folder), "library": str(file)}, folder / "run.json")
    if isinstance(found, str):
        return found
    columns = zip(*found["rows"], strict=True) if outputs else ()
    names = [variable.name for variable in description.variables]
    return DefaultRun(
        points,
        inputs,
        dict(zip((variable.name for variable in outputs), columns, strict=True)),
        tuple(
            (points[place], dict(zip(names, row, strict=True)))
            for place, row in zip(snapshots, found["snapshots"], strict=True)
        ),
    )


def communication_points(experiment: DefaultExperiment) -> tuple[float, ...]:
    """Return the points: an even grid of at most 300 intervals from start to stop, and all input changes."""
    start, stop = experiment.start_time, experiment.stop_time
    if not start < stop < math.inf:
        return ()
    steps = max(1, round((stop - start) / experiment.step_size)) if experiment.step_size > 0 else 1
    intervals = math.ceil(steps / math.ceil(steps / _MOST_INTERVALS))
    grid = {round(start + (stop - start) * i / intervals, 12) for i in range(intervals)} | {stop}
    changes = {step.time for step in experiment.input_steps if start < step.time < stop}
    return tuple(sorted(grid | changes))


def _chosen(description: ModelDescription) -> list[Variable]:
    """Return the outputs, or the states of a model without outputs."""
    outputs = [v for v in description.variables if v.causality == "output"]
    states = [
        description.variables[v.derivative_of] for v in description.variables if v.derivative_of is not None
    ]
    return (outputs or states)[:_MOST_VARIABLES]


def _held_inputs(description: ModelDescription, points: Sequence[float]) -> dict[str, tuple[float, ...]]:
    """Return the Real inputs by name, each with the value that it keeps from every point to the next."""
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


def _values(asked: dict[str, object], file: Path) -> dict[str, list[list[float]]] | str:
    """Return the outputs at each point and the snapshots, or the reason why there are none."""
    file.write_text(json.dumps(asked), "utf-8")
    try:
        done = run_script("run_library.py", str(file), seconds=_MOST_SECONDS)
    except subprocess.TimeoutExpired:
        return f"it did not end within {_MOST_SECONDS} s"
    if done.returncode != 0:
        return (done.stdout + done.stderr).strip() or f"its process ended with {done.returncode}"
    found: dict[str, list[list[float]]] = json.loads(file.read_text("utf-8"))
    if not all(math.isfinite(value) for row in found["rows"] for value in row):
        return "an output is not finite"
    return found
