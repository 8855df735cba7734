"""One fit by estim8, run by `benchmarks.fit_beside_estim8` in an environment that has estim8.

Reads a problem as JSON from standard input and writes the answer as JSON to standard output. Imports nothing
of this project, which that environment need not have.
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

import pandas as pd
from estim8.estimator import Estimator
from estim8.models import FmuModel
from estim8.utils import ModelHelpers


def main() -> None:
    """Carry out the fit."""
    problem = json.load(sys.stdin)
    model = FmuModel(
        problem["fmu"],
        fmi_type="CoSimulation",
        default_parameters=problem["fixed"],
        r_tol=problem["tolerance"],
    )
    runs = 0
    simulate = model.simulate

    def counted(*arguments: Any, **keywords: Any) -> Any:
        nonlocal runs
        runs += 1
        return simulate(*arguments, **keywords)

    model.simulate = counted
    data = {
        name: pd.DataFrame({"theta": values}, index=pd.Index(problem["time"], name="time"))
        for name, values in problem["records"].items()
    }
    releases = [
        ModelHelpers.ParameterMapper("theta_start", name, value=values[0], local_name=f"theta_start_{name}")
        for name, values in problem["records"].items()
    ]
    estimator = Estimator(
        model,
        bounds=problem["bounds"],
        data=data,
        t=[problem["time"][0], problem["time"][-1], problem["time"][1]],
        metric="SS",
        parameter_mapping=releases,
    )
    begun = time.perf_counter()
    found, _ = estimator.estimate(
        method=problem["method"], max_iter=problem["iterations"], optimizer_kwargs=problem["options"]
    )
    seconds = time.perf_counter() - begun
    loss = estimator.objective([found[name] for name in problem["bounds"]])
    answer = {
        "x": {name: float(value) for name, value in found.items()},
        "loss": float(loss),
        "seconds": seconds,
        "runs": runs,
    }
    sys.stdout.write("\n" + json.dumps(answer) + "\n")


if __name__ == "__main__":
    main()
