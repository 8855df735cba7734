"""Inputs of the runs of a sweep: constants, and series from a CSV file."""

from __future__ import annotations

from pyjoystick.fmu import FmuDescription, Inputs, Value, checked_inputs, read_inputs as read_input_file
from pyjoystick.motion import RecordError
from pyjoystick.runs.sweeps.amounts import value_of
from pyjoystick.support import PyJoystickError, SettingsError, Table, UnknownInputError


def read_inputs(fmu: FmuDescription, experiment: Table, constants: Table) -> Inputs:
    """The constants of [inputs], and the series of the CSV file that [experiment] names as ``input_file``.

    The file is as `pyjoystick.fmu.read_inputs` takes it.

    Raises:
        SettingsError: an unknown input, a value that is not allowed, or an input given twice
        RecordError: the CSV file cannot be read, or a cell or a unit in it is wrong
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
    try:
        table = read_input_file(experiment.path.parent / experiment.text("input_file"), fmu)
        checked_inputs(fmu, table)
    except RecordError:
        raise
    except PyJoystickError as error:
        raise experiment.error("input_file", str(error)) from error
    for name in values:
        if name in table:
            raise SettingsError(constants.path, constants.name, name, None, "is in the input_file too")
    return table.assign(**{name: float(value) for name, value in values.items()})
