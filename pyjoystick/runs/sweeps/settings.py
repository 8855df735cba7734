"""The settings of a sweep: a TOML file, checked against the FMU that it names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Final

import numpy as np

from pyjoystick.fmu import (
    MODELS,
    FmuDescription,
    Inputs,
    Reduction,
    Value,
    checked_parameters,
    find_fmu,
    read_description,
)
from pyjoystick.runs.experiments import time_grid
from pyjoystick.runs.sweeps.amounts import value_of
from pyjoystick.runs.sweeps.design import METHODS, Sampling
from pyjoystick.runs.sweeps.input_series import read_inputs
from pyjoystick.runs.sweeps.joystick_file import values_from_joystick_file
from pyjoystick.runs.sweeps.result_settings import read_results
from pyjoystick.runs.sweeps.variation_settings import read_variation
from pyjoystick.runs.sweeps.variations import Variation
from pyjoystick.support import (
    DEFAULT_OUTPUT_INTERVAL,
    DEFAULT_TOLERANCE,
    FloatArray,
    ParameterError,
    PyJoystickError,
    SettingsError,
    Table,
    read_toml,
)

#: Tolerances that an integrator can keep.
_TOLERANCES: Final = (1e-13, 1e-2)


@dataclass(frozen=True, slots=True)
class Settings:
    """What a settings file says.

    Attributes:
        path: the file
        title: a line for people
        fmu: the FMU; ``fmu.path`` is its file
        time: samples of a run (s), shape (n,), which the reductions are taken over
        tolerance: what the FMU's integrator is asked to keep
        parameters: those that are the same in every run, in the FMU's units
        inputs: the same in every run
        varied: how the other parameters vary
        sampling: how the runs are chosen
        results: what is kept of a run
        document: the file as TOML has it, for the record
    """

    path: Path
    title: str
    fmu: FmuDescription
    time: FloatArray
    tolerance: float
    parameters: Mapping[str, Value]
    inputs: Inputs
    varied: Mapping[str, Variation]
    sampling: Sampling
    results: tuple[Reduction, ...]
    document: Mapping[str, Any]


def read_settings(path: str | PathLike[str], find: Callable[[str], Path] = find_fmu) -> Settings:
    """Read the settings of a sweep; docs/sweeps.md describes the file.

    Args:
        path: the TOML file; the paths in it are relative to its folder
        find: from the name or path of an FMU to its file

    Raises:
        InputFileError: the file cannot be read
        SettingsError: something in it is not allowed
        FmuNotFoundError, FmuFileError: there is no such FMU, or it is broken
    """
    root = read_toml(Path(path))
    fmu = _fmu(root, find)
    joystick = _joystick(root, fmu)
    experiment = root.table("experiment")
    time = _time(experiment, fmu)
    tolerance = _tolerance(experiment, fmu)
    constants = root.table("inputs")
    inputs = read_inputs(fmu, experiment, constants)
    parameters = _parameters(root.table("parameters"), fmu)
    varied = _varied(root.table("vary", required=True), fmu, parameters)
    parameters = {name: value for name, value in joystick.items() if name not in varied} | parameters
    settings = Settings(
        path=root.path,
        title=root.text("title", ""),
        fmu=fmu,
        time=time,
        tolerance=tolerance,
        parameters=parameters,
        inputs=inputs,
        varied=varied,
        sampling=_sampling(root.table("sampling", required=True), varied),
        results=read_results(root.tables("results"), fmu),
        document=root.content,
    )
    experiment.finish()
    root.finish()
    return settings


def _fmu(root: Table, find: Callable[[str], Path]) -> FmuDescription:
    table = root.table("fmu", required=True)
    name = table.text("path")
    path = name if name in MODELS else str(root.path.parent / name)
    return read_description(find(path))


def _joystick(root: Table, fmu: FmuDescription) -> dict[str, Value]:
    table = root.table("fmu")
    table.optional("path")
    values = values_from_joystick_file(table, fmu)
    table.finish()
    return values


def _time(experiment: Table, fmu: FmuDescription) -> FloatArray:
    """Times of the samples; what is not given is what the FMU proposes."""
    proposed = fmu.experiment
    start = experiment.number("start", proposed.start_time or 0.0)
    end = proposed.stop_time
    duration = experiment.number("duration", end - start if end is not None and end > start else None)
    step = proposed.step_size or min(DEFAULT_OUTPUT_INTERVAL, duration)
    interval = experiment.number("output_interval", step)
    try:
        return np.asarray(start + time_grid(duration, interval))
    except ParameterError as error:
        raise experiment.refused(error.field, error) from error


def _tolerance(experiment: Table, fmu: FmuDescription) -> float:
    tolerance = experiment.number("tolerance", fmu.experiment.tolerance or DEFAULT_TOLERANCE)
    low, high = _TOLERANCES
    if not low <= tolerance <= high:
        raise experiment.error("tolerance", f"must be a number from {low:g} to {high:g}")
    return tolerance


def _parameters(table: Table, fmu: FmuDescription) -> dict[str, Value]:
    values: dict[str, Value] = {}
    for name, given in table.items():
        try:
            variable = fmu.variables.get(name)
            values[name] = given if variable is None else value_of(variable, given)
            checked_parameters(fmu, {name: values[name]})
        except PyJoystickError as error:
            raise table.refused(name, error) from error
    return values


def _varied(table: Table, fmu: FmuDescription, constants: Mapping[str, Value]) -> dict[str, Variation]:
    varied: dict[str, Variation] = {}
    for name in table.content:
        if name in constants:
            raise SettingsError(table.path, table.name, name, None, "is in [parameters] too; must be in one")
        varied[name] = read_variation(table.table(name), name, fmu)
    if not varied:
        raise SettingsError(
            table.path, table.name, "", None, 'must have one table a parameter, such as [vary."damping.C"]'
        )
    return varied


def _sampling(table: Table, varied: Mapping[str, Variation]) -> Sampling:
    method = next(one for one in METHODS if one == table.choice("method", METHODS))
    if method == "grid":
        sampling = Sampling(method)
    else:
        sampling = Sampling(method, table.integer("count", 1), table.integer("seed", 0, 0))
    table.finish()
    try:
        sampling.check(varied)
    except ParameterError as error:
        raise table.refused(error.field, error) from error
    return sampling
