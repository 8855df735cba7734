"""Inputs of the runs of a sweep: constants, and series from a CSV file."""

from __future__ import annotations

import re
from typing import Final

import pandas as pd

from pyjoystick.fmu import FmuDescription, Inputs, Value, checked_inputs
from pyjoystick.runs.errors import SweepFileError
from pyjoystick.runs.sweeps.amounts import value_of
from pyjoystick.support import PyJoystickError, SettingsError, Table, UnknownInputError

_UNIT: Final = re.compile(r"\s*\([^()]*\)$")


def read_inputs(fmu: FmuDescription, experiment: Table, constants: Table) -> Inputs:
    """The constants of [inputs], and the series of the CSV file that [experiment] names as ``input_file``.

    The first column of the file is time (s); the headings are names of inputs, with or without `` (unit)``.

    Raises:
        SettingsError: an unknown input, a value that is not allowed, or an input given twice
        SweepFileError: the CSV file cannot be read
    """
    values: dict[str, Value] = {}
    known = fmu.names("input")
    for name, given in constants.items():
        try:
            if name not in known:
                raise UnknownInputError(name, known)
            values[name] = value_of(fmu.variables[name], given)
        except PyJoystickError as error:
            raise constants.refused(name, error) from error
    if experiment.optional("input_file") is None:
        return values
    table = _read_series(experiment)
    for name in values:
        if name in table:
            raise SettingsError(constants.path, constants.name, name, None, "is in the input_file too")
    try:
        checked_inputs(fmu, table)
    except PyJoystickError as error:
        raise experiment.error("input_file", str(error)) from error
    return table.assign(**{name: float(value) for name, value in values.items()})


def _read_series(experiment: Table) -> pd.DataFrame:
    path = experiment.path.parent / experiment.text("input_file")
    try:
        table = pd.read_csv(path, index_col=0, comment="#")
    except (OSError, ValueError) as error:
        raise SweepFileError(path, f"cannot be read as CSV: {error}") from error
    return table.rename(columns=lambda heading: _UNIT.sub("", str(heading)))
