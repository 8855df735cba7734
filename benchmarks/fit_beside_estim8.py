"""The same fits by `pyjoystick.identification.fitting` and by estim8: the same FMU, data, bounds and minimum.

    python -m venv /path/to/environment && /path/to/environment/bin/pip install estim8==0.1.6
    python -m benchmarks.fit_beside_estim8 --python /path/to/environment/bin/python

estim8 has no release time, so that the synthetic records of this comparison begin at the release. Both fit
the damping and the release angle of each of four records to the trajectory, with FMU runs at the same
tolerance. estim8 is run by the differential evolution of its documentation (SciPy's, which ends with a local
search), or by its local search alone from the start values that pyjoystick has. Standard errors, profiles and
checks are not in pyjoystick's time: estim8 computes none here.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Final

import numpy as np

from benchmarks.errors import BenchmarkError
from pyjoystick.fmu import Fmu, find_fmu
from pyjoystick.identification import CONSTANT_DAMPING, POWER_LAW_DAMPING, FitSettings, Measurement
from pyjoystick.identification.fitting.problem.difference_steps import choose_steps
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.identification.fitting.solution.search import multi_start
from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.support import TextTable

RECORDS: Final = 4
#: Number of fits by pyjoystick of which the median time is taken; estim8 fits once.
REPEATS: Final = 5
CASES: Final = {"constant": (CONSTANT_DAMPING, NOMINAL), "power-law": (POWER_LAW_DAMPING, NOMINAL_POWER_LAW)}
#: Options that estim8 passes to SciPy; the tolerance is for the sum of squares.
LOCAL: Final = {"method": "L-BFGS-B", "options": {"ftol": 1e-12, "gtol": 1e-9, "eps": 1e-6, "maxfun": 20000}}
CHILD: Final = Path(__file__).with_name("estim8_fit.py")


def main() -> int:
    """Run both on the requested case; return 1 if the minima differ."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--python", required=True, help="interpreter of an environment with estim8")
    parser.add_argument("--law", choices=tuple(CASES), default="constant")
    parser.add_argument("--method", choices=("de", "local"), default="de")
    parser.add_argument("--iterations", type=int, default=200)
    options = parser.parse_args()
    settings, records = _case(options.law)
    ours = _ours(settings, records)
    theirs = _theirs(settings, records, options)
    rows = [
        [name, f"{one['seconds']:.2f}", str(one["runs"]), f"{one['loss']:.8g}", _values(one)]
        for name, one in (("pyjoystick", ours), (f"estim8 ({options.method})", theirs))
    ]
    print(TextTable(["fit", "seconds", "runs", "sum of squares (rad^2)", "damping"], rows).markdown())
    excess = theirs["loss"] / ours["loss"] - 1.0
    print(f"\nestim8 takes {theirs['seconds'] / ours['seconds']:.0f} times as long; ", end="")
    print(f"its sum of squares is {100.0 * excess:+.3g} % of that of pyjoystick away")
    return int(ours["loss"] > theirs["loss"] * 1.001)


def _case(law: str) -> tuple[FitSettings, list[Measurement]]:
    settings, truth = CASES[law]
    random = np.random.default_rng(3)
    records = []
    for number in range(1, RECORDS + 1):
        made = synthetic_record(
            truth,
            release_angle=math.radians(-20.0 + 0.3 * random.standard_normal()),
            random=random,
            name=f"run{number}",
            release_time=0.0,
            duration=1.5,
        )
        records.append(Measurement.from_record(made))
    free = tuple(
        dataclasses.replace(one, start=-0.35, minimum=-0.4, maximum=-0.3)
        if one.name == "theta_start"
        else one
        for one in settings.free
        if one.name != "release_time"
    )
    fixed = {**settings.fixed, "release_time": 0.0}
    return dataclasses.replace(settings, free=free, fixed=fixed), records


def _ours(settings: FitSettings, records: list[Measurement]) -> dict[str, Any]:
    """Return pyjoystick's answer and the median time of several fits; the first one loads the compiler."""
    with Fmu(settings.fmu) as fmu:
        fits = [_our_fit(settings, records, fmu) for _ in range(REPEATS + 1)][1:]
    return {**fits[0], "seconds": statistics.median(one["seconds"] for one in fits)}


def _our_fit(settings: FitSettings, records: list[Measurement], fmu: Fmu) -> dict[str, Any]:
    begun = time.perf_counter()
    problem = make_problem(records, settings, fmu)
    start = problem.variables.start
    steps = choose_steps(problem.model, start, central=False).steps
    best = multi_start(dataclasses.replace(problem, steps=steps), start, settings.search)[0]
    seconds = time.perf_counter() - begun
    loss = sum(
        float(np.sum((predicted - data) ** 2))
        for predicted, data in zip(problem.predictions(best.x), problem.data, strict=True)
    )
    x = {label: float(value) for label, value in zip(problem.variables.labels, best.x, strict=True)}
    return {"x": x, "loss": loss, "seconds": seconds, "runs": problem.model.runs}


def _theirs(settings: FitSettings, records: list[Measurement], options: argparse.Namespace) -> dict[str, Any]:
    shared = {one.name: [one.minimum, one.maximum] for one in settings.free if not one.per_record}
    bounds = {**shared, **{f"theta_start_{one.name}": [-0.4, -0.3] for one in records}}
    start = [one.start for one in settings.free if not one.per_record] + [-0.35] * len(records)
    problem = {
        "fmu": str(find_fmu(settings.fmu)),
        "fixed": {name: value for name, value in settings.fixed.items() if name != "release_time"},
        "tolerance": settings.tolerance,
        "time": records[0].time.tolist(),
        "records": {one.name: one.columns["theta"].tolist() for one in records},
        "bounds": bounds,
        "method": options.method,
        "iterations": options.iterations,
        "options": {"x0": start, **LOCAL} if options.method == "local" else {"seed": 0},
    }
    child = subprocess.run(
        [options.python, str(CHILD)], input=json.dumps(problem), capture_output=True, text=True, check=False
    )
    if child.returncode:
        raise BenchmarkError(f"estim8 failed: {child.stderr.strip()[-2000:]}")
    answer: dict[str, Any] = json.loads(child.stdout.strip().splitlines()[-1])
    return answer


def _values(one: dict[str, Any]) -> str:
    return ", ".join(f"{value:.6g}" for name, value in one["x"].items() if name.startswith("damping"))


if __name__ == "__main__":
    sys.exit(main())
