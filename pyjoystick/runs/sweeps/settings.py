"""Settings of a sweep: a TOML file, checked against its FMU."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Final

import numpy as np

from pyjoystick.fmu import (
    FmuDescription,
    Inputs,
    Reduction,
    Value,
    checked_inputs,
    checked_parameters,
    find_fmu,
    read_inputs,
)
from pyjoystick.motion import RecordError
from pyjoystick.runs.experiments import time_grid
from pyjoystick.runs.fmu_settings import fmu_of, joystick_values, value_of
from pyjoystick.runs.sweeps.results import COLUMNS, columns_of, read_results
from pyjoystick.runs.sweeps.sampling import METHODS, Sampling
from pyjoystick.runs.sweeps.variations import Variation, read_variation
from pyjoystick.support import (
    DEFAULT_OUTPUT_INTERVAL,
    DEFAULT_TOLERANCE,
    FloatArray,
    PyJoystickError,
    SettingsError,
    Table,
    UnknownInputError,
    positive,
    read_toml,
)

#: Range of tolerances that integrators can achieve.
_TOLERANCES: Final = (1e-13, 1e-2)


@dataclass(frozen=True, slots=True, eq=False)
class Settings:
    """Contents of a settings file.

    Attributes:
        path: the file
        title: title for people
        fmu: the FMU; ``fmu.path`` is its file
        time: samples of a run (s), shape (n,), from which the reductions are computed
        tolerance: tolerance of the FMU's integrator
        time_limit: wall-clock limit of a run (s), see `Fmu`; None if the file has none
        parameters: parameters that are the same in every run, in the FMU's units
        inputs: inputs, the same in every run
        varied: how the other parameters vary
        sampling: how the runs are chosen
        results: what to keep of a run
        document: the file as parsed from TOML, for the record
    """

    path: Path
    title: str
    fmu: FmuDescription
    time: FloatArray
    tolerance: float
    time_limit: float | None
    parameters: Mapping[str, Value]
    inputs: Inputs
    varied: Mapping[str, Variation]
    sampling: Sampling
    results: tuple[Reduction, ...]
    document: Mapping[str, Any]


def read_settings(path: str | PathLike[str] | Table, find: Callable[[str], Path] = find_fmu) -> Settings:
    """Read the settings of a sweep; docs/sweeps.md describes the file.

    Args:
        path: the TOML file; paths in it are relative to its folder
        find: function that returns the file for the name or path of an FMU

    Raises:
        InputFileError: the file cannot be read
        SettingsError: a setting is not allowed
        FmuNotFoundError, FmuFileError: there is no such FMU, or it is broken
    """
    root = read_toml(path)
    fmu = fmu_of(root.table("fmu", required=True), find)
    joystick = joystick_values(root.table("fmu"), fmu)
    parameters = _parameters(root.table("parameters"), fmu)
    varied = _varied(root.table("vary", required=True), fmu, parameters)
    experiment = root.table("experiment")
    settings = Settings(
        path=root.path,
        title=root.text("title", ""),
        fmu=fmu,
        time=_time(experiment, fmu),
        tolerance=_tolerance(experiment, fmu),
        time_limit=_time_limit(experiment),
        parameters={name: value for name, value in joystick.items() if name not in varied} | parameters,
        inputs=_inputs(experiment, root.table("inputs"), fmu),
        varied=varied,
        sampling=_sampling(root.table("sampling", required=True), varied),
        results=read_results(root.tables("results"), fmu),
        document=root.content,
    )
    root.finish()
    for name in varied:
        if name in (*columns_of(settings.results), *COLUMNS):
            raise root.table("vary").error(name, "has the name of another column of the results")
    return settings


def _time(experiment: Table, fmu: FmuDescription) -> FloatArray:
    """Times of the samples; missing settings are those that the FMU proposes."""
    proposed = fmu.experiment
    start = experiment.number("start", proposed.start_time or 0.0)
    end = proposed.stop_time
    duration = experiment.number("duration", end - start if end is not None and end > start else None)
    step = proposed.step_size or min(DEFAULT_OUTPUT_INTERVAL, duration)
    interval = experiment.number("output_interval", step)
    with experiment.at():
        return np.asarray(start + time_grid(duration, interval))


def _tolerance(experiment: Table, fmu: FmuDescription) -> float:
    tolerance = experiment.number("tolerance", fmu.experiment.tolerance or DEFAULT_TOLERANCE)
    low, high = _TOLERANCES
    if not low <= tolerance <= high:
        raise experiment.error("tolerance", f"must be a number from {low:g} to {high:g}")
    return tolerance


def _time_limit(experiment: Table) -> float | None:
    if "time_limit" not in experiment:
        return None
    with experiment.at("time_limit"):
        return positive("time_limit", experiment.value("time_limit"), "s")


def _parameters(table: Table, fmu: FmuDescription) -> dict[str, Value]:
    values: dict[str, Value] = {}
    for name, given in table.items():
        with table.at(name):
            variable = fmu.variables.get(name)
            values[name] = given if variable is None else value_of(variable, given)
            checked_parameters(fmu, {name: values[name]})
    return values


def _inputs(experiment: Table, constants: Table, fmu: FmuDescription) -> Inputs:
    """Constants of [inputs], and series of the CSV file that [experiment] names as ``input_file``.

    The file has the format of `pyjoystick.fmu.read_inputs`.
    """
    values: dict[str, Value] = {}
    known = fmu.names("input")
    for name, given in constants.items():
        with constants.at(name):
            if name not in known:
                raise UnknownInputError(name, known)
            values[name] = value_of(fmu.variables[name], given)
    if "input_file" not in experiment:
        return values
    try:
        table = read_inputs(experiment.path.parent / experiment.text("input_file"), fmu)
        checked_inputs(fmu, table)
    except RecordError:
        raise
    except PyJoystickError as error:
        raise experiment.error("input_file", str(error)) from error
    for name in values:
        if name in table:
            raise SettingsError(constants.path, constants.name, name, None, "is in the input_file too")
    return table.assign(**values)


def _varied(table: Table, fmu: FmuDescription, constants: Mapping[str, Value]) -> dict[str, Variation]:
    varied: dict[str, Variation] = {}
    for name, inner in table.subtables():
        if name in constants:
            raise SettingsError(table.path, table.name, name, None, "is in [parameters] too; must be in one")
        varied[name] = read_variation(inner, name, fmu)
    if not varied:
        raise table.error("", 'must have one table per parameter, such as [vary."damping.C"]')
    return varied


def _sampling(table: Table, varied: Mapping[str, Variation]) -> Sampling:
    method = next(one for one in METHODS if one == table.choice("method", METHODS))
    if method == "grid":
        sampling = Sampling(method)
    else:
        sampling = Sampling(method, table.integer("count", 1), table.integer("seed", 0, 0))
    with table.at():
        sampling.check(varied)
    return sampling
