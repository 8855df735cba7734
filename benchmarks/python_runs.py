"""The contenders that are Python: FMPy on the same FMU, and the reference."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Literal

import numpy as np
from fmpy import simulate_fmu

from benchmarks.build import UnpackedFmu
from benchmarks.contender import Contender
from benchmarks.errors import BenchmarkError
from benchmarks.task import DURATION, INTERVALS, PARAMETERS, RELEASE, Law, sample_times
from pyjoystick._types import FloatArray
from pyjoystick.reference import DEFAULT_TOLERANCE, simulate

_NAMES = {
    "CoSimulation": "FMU (CS), FMPy simulate_fmu",
    "ModelExchange": "FMU (ME), FMPy simulate_fmu with CVode",
}


def fmpy_run(
    fmu: UnpackedFmu, law: Law, kind: Literal["CoSimulation", "ModelExchange"], tolerance: float
) -> Contender:
    """FMPy's simulate_fmu on the unpacked FMU, its description read before."""

    def theta(release: float, on_call: Callable[[str], None] | None = None) -> FloatArray:
        result = simulate_fmu(
            str(fmu.folder),
            validate=False,
            model_description=fmu.description,
            fmi_type=kind,
            start_values={"theta_start": release},
            output=["theta", "omega", "alpha"],
            stop_time=DURATION,
            output_interval=DURATION / INTERVALS,
            relative_tolerance=tolerance,
            record_events=False,
            fmi_call_logger=on_call,
        )
        if result.size != INTERVALS + 1:
            raise BenchmarkError(f"FMPy recorded {result.size} samples, not {INTERVALS + 1}")
        return np.asarray(result["theta"], dtype=np.float64)

    name = _NAMES[kind]
    evaluations = None
    if kind == "ModelExchange":
        calls: list[str] = []
        theta(RELEASE, calls.append)
        evaluations = sum(call.startswith("fmi2GetDerivatives") for call in calls)
    return Contender(name, law, tolerance, theta, _timed(name, theta), evaluations)


def reference_run(law: Law, tolerance: float = DEFAULT_TOLERANCE) -> Contender:
    """`pyjoystick.reference.simulate`."""
    times = sample_times(INTERVALS)

    def theta(release: float) -> FloatArray:
        return simulate(PARAMETERS[law], time=times, theta_start=release, tolerance=tolerance).theta

    calls = 0

    def no_torque(_: float) -> float:
        nonlocal calls
        calls += 1
        return 0.0

    # The equation asks for the torque each time it is evaluated, and once a sample for the table.
    simulate(PARAMETERS[law], time=times, theta_start=RELEASE, tolerance=tolerance, torque=no_torque)
    name = "pure-Python reference"
    return Contender(name, law, tolerance, theta, _timed(name, theta), calls - times.size)


def _timed(name: str, theta: Callable[[float], FloatArray]) -> Callable[[], float]:
    checked = theta(RELEASE)

    def seconds() -> float:
        start = time.perf_counter()
        result = theta(RELEASE)
        elapsed = time.perf_counter() - start
        if not np.array_equal(result, checked):
            raise BenchmarkError(f"{name}: the timed run gave another result than the checked one")
        return elapsed

    return seconds
