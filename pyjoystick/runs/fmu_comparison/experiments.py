"""Experiments for comparing two FMUs, and their execution through either interface."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Integral
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import (
    INTEGERS,
    DefaultExperiment,
    Fmu,
    FmuDescription,
    Inputs,
    Interface,
    Value,
    Variable,
    run_model_exchange,
)
from pyjoystick.runs.experiments import COLUMNS
from pyjoystick.runs.joystick_fmus import has_si_unit
from pyjoystick.support import (
    DEFAULT_DURATION,
    DEFAULT_OUTPUT_INTERVAL,
    DEFAULT_TOLERANCE,
    FloatArray,
    ParameterError,
    angle,
    finite,
    positive,
)

#: Tolerance of CVode in Model Exchange.
CVODE_TOLERANCE: Final = 1e-10


#: Release angles (rad), small and large, on both sides.
RELEASE_ANGLES: Final = tuple(math.radians(degrees) for degrees in (-20.0, -10.0, 5.0, 15.0))

# Hz. Its crossings of the middle, where C may jump, fall between samples at usual output intervals.
_FREQUENCY: Final = 2.1
_TORQUE: Final = 2.0
_MOTION: Final = ("theta", "omega", "alpha")
_DEFAULT_STEPS: Final = 500
_MOST_STEPS: Final = 10_000_000


@dataclass(frozen=True, slots=True, eq=False)
class Experiment:
    """An experiment for both FMUs.

    Attributes:
        label: short description
        time: times to compare (s), equally spaced, shape (n,), n >= 2
        parameters: values by name; others keep each FMU's own
        inputs: see `pyjoystick.fmu.Inputs`; others keep each FMU's own
    """

    label: str
    time: FloatArray
    parameters: Mapping[str, Value] = field(default_factory=dict)
    inputs: Inputs = field(default_factory=dict)


def is_joystick(fmu: FmuDescription) -> bool:
    """Whether it has what a free oscillation sets and reads, in SI units."""
    return _has(fmu, ("theta_start", *COLUMNS))


def is_inverse(fmu: FmuDescription) -> bool:
    """Whether its inputs are a motion in SI units, as in ``JoystickInverse``."""
    return set(fmu.names("input")) == set(_MOTION) and _has(fmu, _MOTION)


def _has(fmu: FmuDescription, names: Sequence[str]) -> bool:
    return all(name in fmu.variables and has_si_unit(fmu, name) for name in names)


def experiments_for(
    first: FmuDescription,
    second: FmuDescription,
    *,
    release_angles: Iterable[float] | None = None,
    duration: float | None = None,
    output_interval: float | None = None,
    settings: Mapping[str, float] | None = None,
    inputs: pd.DataFrame | None = None,
) -> list[Experiment]:
    """Default experiments for the comparison of two FMUs.

    Joysticks are released at several angles, and driven from rest in the middle by a sinusoidal torque.
    ``JoystickInverse`` follows sines of several amplitudes. Any other FMU runs the first FMU's default
    experiment, or else the second's, or else 1 s.

    Args:
        first: one FMU
        second: the other
        release_angles: release angles, or amplitudes (rad); by default `RELEASE_ANGLES`
        duration: length of each run (s)
        output_interval: sampling interval (s); rounded so that it divides the duration
        settings: parameters by name and constant inputs, the same in all experiments
        inputs: a table of inputs over time (s), which replaces the sines; joysticks are then released
            in the middle unless `release_angles` is given

    Raises:
        ParameterError: a value is not allowed, or `release_angles` are given for FMUs that are not joysticks
    """
    given = _typed(first, settings or {})
    held = {name: value for name, value in given.items() if _is_input(first, name)}
    parameters = {name: value for name, value in given.items() if name not in held}
    driven = held if inputs is None else inputs.assign(**held)
    driveable = set(first.names("input")) & set(second.names("input"))
    checked = None if release_angles is None else [angle("release_angle", value) for value in release_angles]
    if is_joystick(first) and is_joystick(second):
        time = _joystick_instants(duration, output_interval)
        start = checked or (RELEASE_ANGLES if inputs is None else [0.0])
        releases = [_release(value, time, parameters, driven) for value in start]
        by_torque = checked is None and inputs is None and "T" in driveable and "T" not in held
        return [*releases, *([_driven(time, parameters, held)] if by_torque else [])]
    if inputs is None and is_inverse(first) and is_inverse(second):
        time = _joystick_instants(duration, output_interval)
        return [_motion(value, time, parameters) for value in checked or RELEASE_ANGLES]
    if checked is not None:
        raise ParameterError(
            "release_angle", f"{checked[0]:.6g} rad", "left out for FMUs that are not joysticks"
        )
    time = _default_instants(first.experiment, second.experiment, duration, output_interval)
    label = f"{time[0]:g} to {time[-1]:g} s" + ("" if inputs is None else ", driven")
    return [Experiment(label, time, parameters, driven)]


def _release(start: float, time: FloatArray, parameters: Mapping[str, Value], inputs: Inputs) -> Experiment:
    for name in ("theta_start", "omega_start"):
        if name in parameters:
            raise ParameterError(name, parameters[name], "left out", "the angle of release takes its place")
    label = f"{math.degrees(start):.6g} deg" + (", driven" if len(inputs) else "")
    return Experiment(label, time, {**parameters, "theta_start": start}, inputs)


def _driven(time: FloatArray, parameters: Mapping[str, Value], held: Mapping[str, Value]) -> Experiment:
    torque = _TORQUE * np.sin(2.0 * math.pi * _FREQUENCY * time)
    inputs = pd.DataFrame({"T": torque}, index=time).assign(**held)
    return Experiment(f"T of {_TORQUE:g} N.m", time, parameters, inputs)


def _motion(amplitude: float, time: FloatArray, parameters: Mapping[str, Value]) -> Experiment:
    """The imposed motion theta = amplitude * cos(2 pi f t) with its two derivatives."""
    rate = 2.0 * math.pi * _FREQUENCY
    theta = amplitude * np.cos(rate * time)
    omega = -amplitude * rate * np.sin(rate * time)
    motion = pd.DataFrame({"theta": theta, "omega": omega, "alpha": -(rate**2) * theta}, index=time)
    return Experiment(f"sine of {math.degrees(amplitude):.6g} deg", time, parameters, motion)


def _joystick_instants(duration: float | None, interval: float | None) -> FloatArray:
    return _instants(
        0.0,
        DEFAULT_DURATION if duration is None else duration,
        DEFAULT_OUTPUT_INTERVAL if interval is None else interval,
    )


def _default_instants(
    first: DefaultExperiment, second: DefaultExperiment, duration: float | None, interval: float | None
) -> FloatArray:
    proposed = first if first.stop_time is not None else second
    start = proposed.start_time or 0.0
    if duration is None:
        end = proposed.stop_time
        duration = end - start if end is not None and end > start else 1.0
    if interval is None:
        interval = proposed.step_size or duration / _DEFAULT_STEPS
    return _instants(start, duration, interval)


def _instants(start: float, duration: float, interval: float) -> FloatArray:
    length = positive("duration", duration, "s")
    step = positive("output_interval", interval, "s")
    if not length / _MOST_STEPS <= step <= length:
        allowed = f"from {length / _MOST_STEPS:.3g} s to the duration, {length:g} s"
        raise ParameterError("output_interval", interval, allowed)
    steps = round(length / step)
    return start + length * np.arange(steps + 1) / steps


def _is_input(fmu: FmuDescription, name: str) -> bool:
    return name in fmu.variables and fmu.variables[name].causality == "input"


def _typed(fmu: FmuDescription, settings: Mapping[str, float]) -> dict[str, Value]:
    """Numbers in the types of the variables: integers, and 0 and 1 for Booleans."""
    return {
        name: _in_type(fmu.variables[name], value) if name in fmu.variables else value
        for name, value in settings.items()
    }


def _in_type(variable: Variable, value: float) -> Value:
    if variable.type in INTEGERS and isinstance(value, Integral):
        return int(value)
    number = finite(variable.name, value, variable.unit)
    if variable.type == "Boolean" and number in (0.0, 1.0):
        return bool(number)
    if variable.type in INTEGERS and number.is_integer() and abs(number) < 2.0**53:  # beyond, it is rounded
        return int(number)
    return number


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Tolerances of integrators.

    Attributes:
        co_simulation: inside the FMUs
        model_exchange: CVode
    """

    co_simulation: float = DEFAULT_TOLERANCE
    model_exchange: float = CVODE_TOLERANCE


def run(
    fmu: Path, interface: Interface, experiment: Experiment, outputs: Sequence[str], tolerances: Tolerances
) -> pd.DataFrame:
    """Run an FMU through an experiment; in Co-Simulation, its times are the communication points.

    Raises:
        UnknownNameError, ParameterError, SeriesError: the FMU does not accept the experiment
        FmuFileError, UnsupportedFmuError: the FMU cannot be loaded, or lacks the interface
        SimulationError: the FMU rejects its settings, fails or terminates the run
    """
    if interface == "ModelExchange":
        return run_model_exchange(
            fmu,
            experiment.time,
            parameters=experiment.parameters,
            inputs=experiment.inputs,
            outputs=outputs,
            tolerance=tolerances.model_exchange,
        )
    with Fmu(fmu) as opened:
        return opened.run(
            experiment.time,
            parameters=experiment.parameters,
            inputs=experiment.inputs,
            outputs=outputs,
            tolerance=tolerances.co_simulation,
        )
