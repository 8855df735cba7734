"""Simulate the library's models with OpenModelica."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.io import loadmat

from tests.modelica.library import ROOT, SimulationFailedError
from tests.omc import Omc, error_texts

Results = dict[str, NDArray[np.float64]]


class OpenModelicaSimulate:
    """`tests.modelica.library.Simulate` by OpenModelica's DASSL."""

    event_error = 4e-12  # 1.9e-12 s is what version 1.14 leaves when it halves the step down to an event

    def __init__(self, omc: Omc) -> None:
        self.omc = omc

    def __call__(self, component: str, stop_time: float, step: float = 1e-3, equations: str = "") -> Results:
        """See `Simulate`."""
        bench = self.omc.folder / "Bench.mo"
        bench.write_text(f"model Bench {component} equation {equations} end Bench;")
        result = self.omc.folder / "Bench_res.mat"
        result.unlink(missing_ok=True)
        answers = self.omc.ask(
            *self.omc.load(ROOT / "package.mo", bench),
            f"simulate(Bench, stopTime={stop_time}, numberOfIntervals={round(stop_time / step)}, "
            'tolerance=1e-10, outputFormat="mat")',
        )
        record = answers[-1].value
        if error_texts(answers) or "The simulation finished successfully." not in record:
            raise SimulationFailedError("\n".join([record, *error_texts(answers)]))
        return read_results(result)


def read_results(file: Path) -> Results:
    """The trajectories, and as such the parameters too, of a result file of Dymola's and OpenModelica's form.

    Column i of `dataInfo` says for the name in column i of `name` which matrix has it (2: over time, 1 and
    0: constants and time), and in which row, from 1; a negative row is an alias with its sign changed.
    """
    content = loadmat(file, chars_as_strings=False)
    names = ["".join(column).rstrip("\0 ") for column in content["name"].T]
    values = {1: content["data_1"], 2: content["data_2"]}
    time = values[2][0]
    results = {"time": time}
    for name, (matrix, row) in zip(names[1:], content["dataInfo"].T[1:, :2], strict=True):
        signed = np.sign(row) * values[matrix][abs(row) - 1]
        results[name] = signed if matrix == 2 else np.full(len(time), signed[0])
    return results
