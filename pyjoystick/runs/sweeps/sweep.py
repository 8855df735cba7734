"""A sweep: settings, the resulting runs, and a fingerprint."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pyjoystick.fmu import BatchResult, Fmu, Inputs, Plan, Reduction, Value
from pyjoystick.runs.sweeps.results import columns_of, units_of, variables_of
from pyjoystick.runs.sweeps.sampling import design, digest
from pyjoystick.runs.sweeps.settings import Settings
from pyjoystick.support import FloatArray, versions

Document = dict[str, Any]
#: Key of ``DataFrame.attrs`` for the description of a result file.
ATTRIBUTE: Final = "sweep"


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """Some finished runs of a sweep.

    Attributes:
        runs: their numbers, shape (n,)
        values: the results, shape (n, columns), NaN in failed runs
        failed: shape (n,)
        messages: one per run, empty for a successful run
    """

    runs: NDArray[np.int64]
    values: FloatArray
    failed: NDArray[np.bool_]
    messages: list[str]


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """Settings common to all runs of a sweep; see `Fmu.plan` and, for the time limit of a run (s), `Fmu`."""

    time: FloatArray
    varied: tuple[str, ...]
    parameters: Mapping[str, Value]
    inputs: Inputs
    outputs: Sequence[str]
    tolerance: float
    results: tuple[Reduction, ...]
    time_limit: float | None = None

    def open(self, path: Path) -> Fmu:
        """Open the FMU of the sweep."""
        return Fmu(path) if self.time_limit is None else Fmu(path, time_limit=self.time_limit)

    def plan(self, fmu: Fmu) -> Plan:
        """Prepare the runs on an open FMU, which must be that of the sweep."""
        return fmu.plan(
            self.time,
            varied=self.varied,
            parameters=self.parameters,
            inputs=self.inputs,
            outputs=self.outputs,
            tolerance=self.tolerance,
        )


class Sweep:
    """A sweep: settings with the resulting runs.

    Attributes:
        settings: settings of the sweep
        design: parameters of every run, see `sampling.design`
        columns: names of the results of a run
        fmu_sha256: hash of the FMU's file
    """

    def __init__(self, settings: Settings) -> None:
        self.settings = settings
        self.design: pd.DataFrame = design(settings.varied, settings.sampling)
        self.columns = columns_of(settings.results)
        self.fmu_sha256 = _sha256(settings.fmu.path)

    @property
    def task(self) -> Task:
        """Task to prepare once, on this machine or on each worker of a cluster."""
        one = self.settings
        return Task(
            time=one.time,
            varied=tuple(self.design.columns),
            parameters=one.parameters,
            inputs=one.inputs,
            outputs=variables_of(one.results),
            tolerance=one.tolerance,
            results=one.results,
            time_limit=one.time_limit,
        )

    @cached_property
    def identity(self) -> Document:
        """What must not change between the start and the end of a sweep, as JSON data."""
        fmu = self.settings.fmu
        inputs = self.settings.inputs
        document = {
            "settings": self.settings.document,
            "fmu": {
                "file": fmu.path.name,
                "model": fmu.model_name,
                "guid": fmu.guid,
                "sha256": self.fmu_sha256,
            },
            "parameters": self.settings.parameters,
            "runs": len(self.design),
            "runs_sha256": digest(self.design),
            "inputs_sha256": digest(inputs.reset_index()) if isinstance(inputs, pd.DataFrame) else "",
            "pyjoystick": versions()["pyjoystick"],
        }
        cleaned: Document = json.loads(json.dumps(document, default=str))
        return cleaned

    def table(self, whole: Part) -> pd.DataFrame:
        """Results of all runs: parameters, results, ``failed``, ``message``; indexed by ``run``.

        ``attrs["sweep"]`` has the contents of `identity`, versions of packages, units of columns and
        NumPy's types of the parameters.
        """
        results = pd.DataFrame(whole.values, index=self.design.index, columns=self.columns)
        table = pd.concat([self.design, results], axis=1)
        table = table.assign(failed=whole.failed, message=whole.messages)
        fmu = self.settings.fmu
        units = {str(name): fmu.variables[str(name)].unit for name in self.design}
        units |= units_of(self.settings.results, fmu)
        types = {str(name): column.to_numpy().dtype.str for name, column in self.design.items()}
        table.attrs[ATTRIBUTE] = self.identity | {"versions": versions(), "units": units, "types": types}
        return table


def part_of(result: BatchResult, runs: NDArray[np.int64]) -> Part:
    """Finished runs of a reduced batch whose rows are the runs with these numbers."""
    if result.reduced is None:
        raise ValueError("the batch was not reduced")
    done = np.flatnonzero(result.done)
    return Part(
        runs=runs[done],
        values=result.reduced.to_numpy(dtype=np.float64)[done],
        failed=result.failed[done],
        messages=[" ".join(result.messages[i].split()) for i in done],
    )


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
