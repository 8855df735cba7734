"""The contenders that are called from Python: the compiled loop, FMPy, SciPy, and the reference."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any, Final, Literal

import numpy as np
from fmpy import simulate_fmu
from scipy.integrate import solve_ivp

from benchmarks.build import UnpackedFmu
from benchmarks.contender import Contender
from benchmarks.equation_of_motion import right_hand_side
from benchmarks.errors import BenchmarkError
from benchmarks.task import DURATION, INTERVALS, PARAMETERS, RELEASE, Law, sample_times
from pyjoystick.fmu import Fmu
from pyjoystick.model import DEFAULT_TOLERANCE, simulate
from pyjoystick.support import FloatArray

#: Number of timed runs, each short, so that interruptions by other programs affect few of them.
_RUNS: Final = 100
_NAMES: Final = {
    "CoSimulation": "FMU (CS), FMPy simulate_fmu",
    "ModelExchange": "FMU (ME), FMPy simulate_fmu with CVode",
}


def compiled_run(fmu: Fmu, law: Law, tolerance: float) -> Contender:
    """`Plan.run` of an opened FMU."""
    name = "FMU (CS), compiled loop from Python"
    outputs = ("theta", "omega", "alpha")
    plan = fmu.plan(sample_times(INTERVALS), varied="theta_start", outputs=outputs, tolerance=tolerance)
    checked = plan.run((RELEASE,))

    def seconds() -> float:
        times = []
        for _ in range(_RUNS):
            start = time.perf_counter()
            result = plan.run((RELEASE,))
            times.append(time.perf_counter() - start)
        if not np.array_equal(result, checked):
            raise BenchmarkError(f"{name}: the timed runs gave other results than the checked one")
        return statistics.median(times)

    return Contender(name, law, tolerance, lambda release: plan.run((release,))[:, 0], seconds, None)


def scipy_run(law: Law, tolerance: float) -> Contender:
    """SciPy's LSODA, integrating across the kinks.

    Stopping at every kink with events takes several times as long at the same accuracy, for LSODA, RK45 and
    DOP853 alike, because SciPy evaluates each event function in each step. Without events, RK45 and DOP853
    take 2 to 9 times as long as LSODA, and Radau far longer.
    """
    equation, times = right_hand_side(PARAMETERS[law]), sample_times(INTERVALS)

    def solution(release: float) -> Any:
        return solve_ivp(
            equation,
            (0.0, DURATION),
            (release, 0.0),
            method="LSODA",
            t_eval=times,
            rtol=tolerance,
            atol=tolerance,
        )

    def theta(release: float) -> FloatArray:
        return np.asarray(solution(release).y[0], dtype=np.float64)

    name = "equation in Python, SciPy solve_ivp with LSODA"
    return Contender(name, law, tolerance, theta, _timed(name, theta), int(solution(RELEASE).nfev))


def fmpy_run(
    fmu: UnpackedFmu, law: Law, kind: Literal["CoSimulation", "ModelExchange"], tolerance: float
) -> Contender:
    """FMPy's simulate_fmu on the unpacked FMU, with its description already read."""

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
    """`pyjoystick.model.simulate`."""
    times = sample_times(INTERVALS)

    def theta(release: float) -> FloatArray:
        return simulate(PARAMETERS[law], time=times, theta_start=release, tolerance=tolerance).theta

    calls = 0

    def no_torque(_: float) -> float:
        nonlocal calls
        calls += 1
        return 0.0

    # The equation evaluates the torque once per evaluation, and once per sample for the table.
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
