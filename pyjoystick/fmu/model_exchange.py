"""Model Exchange runs with an external integrator, as a check of Co-Simulation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from os import PathLike
from typing import TYPE_CHECKING, Any, Final

import fmpy
import numpy as np
from fmpy.simulation import Input
from numpy.typing import ArrayLike, NDArray

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.description_file import read_description
from pyjoystick.fmu.errors import THE_END, FmuEndedError, FmuRunError
from pyjoystick.fmu.files import find_fmu
from pyjoystick.fmu.inputs import Inputs, InputTable, checked_inputs
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.interface import c_interface
from pyjoystick.fmu.library import FmuLibrary
from pyjoystick.fmu.own_process.pool import is_apart, run_apart
from pyjoystick.fmu.values import INTEGERS, Value, checked_outputs, checked_parameters
from pyjoystick.motion import make_table
from pyjoystick.support import ParameterError, SimulationError, increasing_times, positive

if TYPE_CHECKING:
    import pandas as pd

#: Largest rounding error of a time, relative to a step, with which FMPy's loop takes every step.
_ROUNDED: Final = 2e-8


def run_model_exchange(
    fmu: str | PathLike[str],
    time: ArrayLike,
    *,
    parameters: Mapping[str, Value] | None = None,
    inputs: Inputs | None = None,
    outputs: Iterable[str] | None = None,
    tolerance: float = 1e-10,
    own_process: bool | None = None,
    time_limit: float | None = None,
) -> pd.DataFrame:
    """Run an FMU through Model Exchange and FMPy's CVode (SUNDIALS).

    Args:
        fmu: a name such as ``Joystick``, or the path of any .fmu file
        time: times to record (s), equally spaced, shape (n,), n >= 2
        parameters: as in `Fmu.run`
        inputs: as in `Fmu.run`, but always followed exactly
        outputs: as in `Fmu.run`
        tolerance: relative tolerance of CVode
        own_process: as in `Fmu`
        time_limit: as in `Fmu`

    Returns:
        a table as from `Fmu.run`

    Raises:
        ParameterError: the time is not equally spaced, or as in `Fmu.run`
        UnknownNameError, SeriesError: as in `Fmu.run`
        FmuNotFoundError, FmuFileError, UnsupportedFmuError: as in `Fmu`
        FmuEndedError, FmuCrashError, FmuTimeLimitError: as in `Fmu.run`
        FmuRunError: the FMU rejects its settings or fails
        SimulationError: CVode failed
    """
    instants = increasing_times(time)
    interval = float(instants[-1] - instants[0]) / (len(instants) - 1)
    farthest = float(np.abs(instants).max())
    if np.spacing(farthest) > _ROUNDED * interval:  # FMPy's loop adds up its steps, and loses some there
        allowed = f"nearer to 0 for Model Exchange in steps of {interval:g} s"
        raise ParameterError("time", f"up to {farthest:.9g} s", allowed)
    grid = instants[0] + interval * np.arange(len(instants))
    if np.max(np.abs(grid - instants)) > 1e-9 * interval:
        raise ParameterError("time", "unequal steps", "equally spaced for Model Exchange")
    description = read_description(find_fmu(fmu))
    values = checked_parameters(description, {} if parameters is None else parameters)
    table = checked_inputs(description, {} if inputs is None else inputs)
    recorded = checked_outputs(description, outputs)
    if is_apart(description, own_process):
        given = {"time": instants, "parameters": parameters, "inputs": inputs, "tolerance": tolerance}
        names = [variable.name for variable in recorded]
        found: pd.DataFrame = run_apart(description, time_limit, given | {"outputs": names})
        return found
    with ExitStack() as stack:
        library = FmuLibrary(description, "ModelExchange")
        stack.callback(library.close)
        instance = library.instantiate()
        stack.callback(instance.free)
        folder = str(library.folder)
        model_description = fmpy.read_model_description(folder, validate=False)
        signals = input_signals(description, table) if table.columns else None
        if signals is not None:
            apply_inputs_with_time(instance.fmi, model_description, signals)
        rows = _simulate(
            instance,
            folder,
            model_description=model_description,
            validate=False,
            fmi_type="ModelExchange",
            solver="CVode",
            start_time=float(instants[0]),
            stop_time=float(instants[-1]),
            output_interval=interval,
            record_events=False,
            relative_tolerance=positive("tolerance", tolerance),
            start_values=dict(values),
            input=signals,
            output=list(dict.fromkeys(variable.whole for variable in recorded)),
        )
    columns = {variable.name: _column(rows, variable) for variable in recorded}
    quantities = [variable.quantity for variable in recorded]
    if len(rows) != len(instants):
        end, samples = float(rows["time"][-1]), make_table(rows["time"], columns, quantities)
        raise FmuEndedError(end, THE_END, description.path, (), samples)
    return make_table(instants, columns, quantities)


def _simulate(instance: Instance, folder: str, **settings: Any) -> Any:
    """Run FMPy's loop; converts its errors to ours, with the time that was reached."""
    reached = [settings["start_time"]]

    def remember(time: float, _: object) -> bool:
        reached[0] = time
        return True

    try:
        with instance.reporting(reached[0]):
            return fmpy.simulate_fmu(folder, fmu_instance=instance.fmi, step_finished=remember, **settings)
    except FmuRunError as error:
        raise FmuRunError(reached[0], error.reason, error.path, error.messages) from error
    except RuntimeError as error:  # from FMPy if CVode fails; begins with a source file of CVode
        raise SimulationError(reached[0], f"CVode: {str(error).rpartition('.c: ')[2]}") from error


def _column(rows: Any, variable: Variable) -> NDArray[Any]:
    found = rows[variable.whole]
    column: NDArray[Any] = (
        found if variable.element is None else found.reshape(len(rows), -1)[:, variable.element]
    )
    return column


def input_signals(description: FmuDescription, table: InputTable) -> NDArray[Any]:
    """All inputs over time as FMPy needs them; those missing in the table keep their start values.

    Raises:
        ParameterError: an input of the table is text
    """
    stored = c_interface(description.fmi_version).types
    variables = [description.variables[name] for name in description.names("input")]
    for one in variables:
        if one.type == "String" and one.name in table.columns:
            raise ParameterError(one.name, "text", "left out: Model Exchange does not support text inputs")
    variables = [one for one in variables if one.type in stored and one.type != "String" and not one.is_array]
    types = [
        ("time", np.dtype(np.float64)),
        *(
            (one.name, np.dtype(np.bool_) if one.type == "Boolean" else stored[one.type].dtype)
            for one in variables
        ),
    ]
    signals = np.empty(len(table.time), dtype=types)
    signals["time"] = table.time
    for one in variables:
        signals[one.name] = table.columns[one.name] if one.name in table.columns else _start(one)
    return signals


def _start(variable: Variable) -> float | bool:
    text = variable.start or "0"
    if variable.type == "Boolean":
        return text in ("true", "1")
    return int(text) if variable.type in INTEGERS else float(text)


def apply_inputs_with_time(fmi: Any, model_description: Any, signals: NDArray[Any]) -> None:
    """Make the inputs follow the time whenever it is set.

    FMPy's loop sets the time in the right-hand side that CVode integrates, but the inputs only once per step,
    which would make them constant in between at any tolerance.

    Args:
        fmi: FMPy's object of the instance
        model_description: as read by FMPy
        signals: from `input_signals`
    """
    inputs = Input(fmi, model_description, signals)
    set_time = fmi.setTime

    def set_time_and_inputs(time: float) -> None:
        set_time(time)
        # At a jump, use the value after it, because CVode restarts there and evaluates this instant first.
        inputs.apply(time, discrete=False, after_event=True)

    fmi.setTime = set_time_and_inputs
