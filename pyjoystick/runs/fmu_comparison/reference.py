"""Comparison of a joystick's FMU with the pure-Python reference."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from os import PathLike

from pyjoystick.fmu import Interface, find_fmu, read_description
from pyjoystick.model import ConstantDamping, JoystickParameters, values_for
from pyjoystick.motion import compare
from pyjoystick.runs.experiments import reference_free_oscillation, require_joystick
from pyjoystick.runs.fmu_comparison.compare import RunComparison
from pyjoystick.runs.fmu_comparison.experiments import Experiment, Tolerances, run
from pyjoystick.runs.fmu_comparison.limits import (
    CO_SIMULATION_CONSTANT,
    CO_SIMULATION_POWER_LAW,
    MODEL_EXCHANGE,
    angle_limit,
)
from pyjoystick.support import DEFAULT_DURATION, DEFAULT_OUTPUT_INTERVAL


def compare_with_reference(
    fmu: str | PathLike[str],
    joystick: JoystickParameters,
    release_angles: Iterable[float],
    *,
    duration: float = DEFAULT_DURATION,
    output_interval: float = DEFAULT_OUTPUT_INTERVAL,
    interface: Interface = "CoSimulation",
    limits: Mapping[str, float] | None = None,
    tolerances: Tolerances | None = None,
    on_run: Callable[[str], None] = lambda _: None,
) -> list[RunComparison]:
    """Compare free oscillations on an FMU with the reference.

    Args:
        fmu: name or path of an FMU with the interface of ``Joystick`` and the damping law of `joystick`
        joystick: parameters for both
        release_angles: release angles (rad)
        duration: length of each run (s)
        output_interval: sampling interval (s)
        interface: interface for running the FMU
        limits: largest allowed difference by name of the variable, in its unit; by default ``theta`` has
            the limit that integration errors explain, see `angle_limit`
        tolerances: tolerances of the integrators
        on_run: called with a description of each run before it starts

    Raises:
        FmuNotFoundError, FmuFileError, UnsupportedFmuError: the FMU cannot be opened, or is not a joystick
        ParameterError, UnknownNameError: a setting is not allowed, or a limit is for an unknown variable
        SimulationError: the FMU rejects the parameters or fails, or the reference reaches 90 degrees
    """
    description = read_description(find_fmu(fmu))
    require_joystick(description)
    tolerances = tolerances or Tolerances()
    runs = []
    for angle in release_angles:
        label = f"{math.degrees(angle):.6g} deg"
        on_run(f"{description.path.name}: {label}")
        expected = reference_free_oscillation(
            angle, parameters=joystick, duration=duration, output_interval=output_interval
        )
        values = {**values_for(joystick, description.variables), "theta_start": angle}
        experiment = Experiment(label, expected.index.to_numpy(), values)
        table = run(description.path, interface, experiment, [*map(str, expected.columns)], tolerances)
        tolerance, factor = _accuracy(interface, joystick, tolerances)
        allowed = {"theta": angle_limit(expected["theta"], tolerance, factor)} | dict(limits or {})
        differences = compare(table, expected, limits=allowed)
        runs.append(RunComparison(interface, label, tuple(differences), frozenset(allowed)))
    return runs


def _accuracy(
    interface: Interface, joystick: JoystickParameters, tolerances: Tolerances
) -> tuple[float, float]:
    """Tolerance of the integrator, and its largest error in units of tolerance times angle."""
    if interface == "ModelExchange":
        return tolerances.model_exchange, MODEL_EXCHANGE
    constant = isinstance(joystick.damping, ConstantDamping)
    return tolerances.co_simulation, CO_SIMULATION_CONSTANT if constant else CO_SIMULATION_POWER_LAW
