"""Model Exchange runs with an external integrator, as a check of Co-Simulation."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from contextvars import ContextVar
from os import PathLike
from typing import TYPE_CHECKING, Any, Final

import fmpy
import fmpy.simulation
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
from pyjoystick.fmu.not_finite import warn_not_finite
from pyjoystick.fmu.own_process.pool import is_apart, run_apart
from pyjoystick.fmu.values import INTEGERS, REALS, Value, checked_outputs, checked_parameters
from pyjoystick.motion import make_table
from pyjoystick.support import ParameterError, SimulationError, increasing_times, positive

if TYPE_CHECKING:
    import pandas as pd

#: Largest rounding error of a time, relative to a step, with which FMPy's loop takes every step.
_ROUNDED: Final = 2e-8
#: FMPy lets CVode take at most 500 steps from one output to the next, so a run has at least so many outputs.
_FEWEST_OUTPUTS: Final = 200
#: Where a table of inputs has more kinks than this, only those after a pause are events: FMPy's loop searches
#: all of them in every step, and CVode's error control sees the others.
_MOST_KINKS: Final = 5000
#: Relative difference of slopes that rounding can cause.
_STRAIGHT: Final = 1e-9
#: FMPy's functions that set values of discrete types.
_DISCRETE_SETTER: Final = re.compile(r"fmi2Set(Integer|Boolean)|fmi3Set(U?Int\d+|Boolean)")
#: Rounding errors of a time that CVode reaches, in spacings of numbers.
_ROUNDINGS: Final = 16.0
#: A pause is so many times as long as the usual time between two kinks.
_PAUSE: Final = 5.0


#: Whether FMPy's loop is this module's.
_IS_STRICT: ContextVar[bool] = ContextVar("is_strict", default=False)


def _is_close(a: float, b: float, **settings: float) -> bool:
    """Return whether times are equal: apart from rounding in runs of this module, or as FMPy has it."""
    if _IS_STRICT.get():
        return abs(a - b) <= _ROUNDINGS * float(np.spacing(max(abs(a), abs(b))))
    return math.isclose(a, b, **settings)


# FMPy takes times for equal that differ by 1e-9 of the time, by which it would misplace events.
fmpy.simulation.isclose = _is_close


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
        inputs: as in `Fmu.run`, but always followed exactly: CVode restarts at their kinks and jumps
        outputs: as in `Fmu.run`
        tolerance: relative tolerance of CVode
        own_process: as in `Fmu`
        time_limit: as in `Fmu`

    Returns:
        a table as from `Fmu.run`

    Warns:
        NotFiniteWarning: results are NaN or infinite

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
    if np.max(np.abs(grid - instants)) > 1e-9 * interval + 2.0 * np.spacing(farthest):
        raise ParameterError("time", "unequal steps", "equally spaced for Model Exchange")
    parts = math.ceil(_FEWEST_OUTPUTS / (len(instants) - 1))
    parts = parts if np.spacing(farthest) <= _ROUNDED * interval / parts else 1
    description = read_description(find_fmu(fmu))
    values = checked_parameters(description, {} if parameters is None else parameters)
    table = checked_inputs(description, {} if inputs is None else inputs)
    recorded = checked_outputs(description, outputs)
    if is_apart(description, own_process):
        given = {"time": instants, "parameters": parameters, "inputs": inputs, "tolerance": tolerance}
        names = [variable.name for variable in recorded]
        found: pd.DataFrame = run_apart(description, time_limit, given | {"outputs": names})
        # The warning of the other process reached nobody.
        warn_not_finite(description.path, instants, {name: found[name].to_numpy() for name in names})
        return found
    with ExitStack() as stack:
        library = FmuLibrary(description, "ModelExchange")
        stack.callback(library.close)
        instance = library.instantiate()
        stack.callback(instance.free)
        folder = str(library.folder)
        model_description = fmpy.read_model_description(folder, validate=False)
        signals = input_signals(description, table, float(instants[0])) if table.columns else None
        if signals is not None:
            apply_inputs_with_time(instance.fmi, model_description, signals)
            keep_discrete_inputs_between_events(instance.fmi)
        rows = _simulate(
            instance,
            folder,
            model_description=model_description,
            validate=False,
            fmi_type="ModelExchange",
            solver="CVode",
            start_time=float(instants[0]),
            stop_time=float(instants[-1]),
            output_interval=interval / parts,
            record_events=False,
            relative_tolerance=positive("tolerance", tolerance),
            start_values=dict(values),
            input=signals,
            output=list(dict.fromkeys(variable.whole for variable in recorded)),
        )[::parts]
    columns = {variable.name: _column(rows, variable) for variable in recorded}
    quantities = [variable.quantity for variable in recorded]
    if len(rows) != len(instants):
        end, samples = float(rows["time"][-1]), make_table(rows["time"], columns, quantities)
        raise FmuEndedError(end, THE_END, description.path, (), samples)
    warn_not_finite(description.path, instants, columns)
    return make_table(instants, columns, quantities)


def _simulate(instance: Instance, folder: str, **settings: Any) -> Any:
    """Run FMPy's loop; converts its errors to ours, with the time that was reached."""
    reached = [settings["start_time"]]

    def remember(time: float, _: object) -> bool:
        reached[0] = time
        return True

    strict = _IS_STRICT.set(True)
    try:
        with instance.reporting(reached[0]):
            return fmpy.simulate_fmu(folder, fmu_instance=instance.fmi, step_finished=remember, **settings)
    except FmuRunError as error:
        raise FmuRunError(reached[0], error.reason, error.path, error.messages) from error
    except RuntimeError as error:  # from FMPy if CVode fails; begins with a source file of CVode
        raise SimulationError(reached[0], f"CVode: {str(error).rpartition('.c: ')[2]}") from error
    except Exception as error:
        if type(error) is Exception:  # from FMPy, such as for a nominal value below zero
            raise SimulationError(reached[0], f"FMPy: {error}") from error
        raise
    finally:
        _IS_STRICT.reset(strict)


def _column(rows: Any, variable: Variable) -> NDArray[Any]:
    found = rows[variable.whole]
    column: NDArray[Any] = (
        found if variable.element is None else found.reshape(len(rows), -1)[:, variable.element]
    )
    return column


def input_signals(description: FmuDescription, table: InputTable, start: float) -> NDArray[Any]:
    """All inputs over time as FMPy needs them; those missing in the table keep their start values.

    Two rows with the same time are an event to FMPy, at which CVode starts anew. Rows at which an input has a
    kink are therefore given twice: otherwise CVode can step over a short pulse, as long as nothing moves.

    Args:
        description: of the FMU
        table: the inputs
        start: the time at which the run starts (s); of rows at this time, only the last counts

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
    rows = _rows(description, table, start)
    signals = np.empty(len(rows), dtype=types)
    signals["time"] = table.time[rows]
    for one in variables:
        signals[one.name] = table.columns[one.name][rows] if one.name in table.columns else _start(one)
    return signals


def _rows(description: FmuDescription, table: InputTable, start: float) -> NDArray[np.intp]:
    """The rows that FMPy needs, with kinks twice."""
    time = table.time
    first = int(np.searchsorted(time, start, side="right")) - 1
    rows = np.arange(first if first >= 0 and time[first] == start else 0, len(time))
    if len(rows) == 1:
        return np.repeat(rows, 2)  # FMPy does not take a single one
    steps = np.diff(time[rows])
    kinks = np.zeros(len(rows), dtype=bool)
    for name, column in table.columns.items():
        if description.variables[name].type in REALS:
            rises = np.diff(column[rows].astype(np.float64))
            slopes = np.divide(rises, steps, out=np.zeros_like(rises), where=steps > 0.0)
            before, after = np.concatenate(([0.0], slopes)), np.concatenate((slopes, [0.0]))
            kinks |= np.abs(after - before) > _STRAIGHT * np.maximum(np.abs(before), np.abs(after))
    if np.count_nonzero(kinks) > _MOST_KINKS:
        pauses = np.diff(time[rows][kinks], prepend=-np.inf)
        kinks[kinks] = pauses > _PAUSE * np.median(pauses[1:])
    return np.repeat(rows, np.where(kinks, 2, 1))


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
    inputs = _Inputs(fmi, model_description, signals)
    set_time = fmi.setTime

    def set_time_and_inputs(time: float) -> None:
        set_time(time)
        inputs.apply(time, discrete=False)

    fmi.setTime = set_time_and_inputs


def keep_discrete_inputs_between_events(fmi: Any) -> None:
    """Set discrete inputs in Event Mode and before only, as the standard demands.

    FMPy sets them, too, wherever CVode looks for events.

    Args:
        fmi: FMPy's object of the instance
    """
    is_continuous = False

    def within(name: str, *, continuous: bool) -> None:
        enter = getattr(fmi, name)

        def entered() -> Any:
            nonlocal is_continuous
            is_continuous = continuous
            return enter()

        setattr(fmi, name, entered)

    def outside(name: str) -> None:
        set_values = getattr(fmi, name)
        setattr(fmi, name, lambda *arguments: None if is_continuous else set_values(*arguments))

    within("enterEventMode", continuous=False)
    within("enterContinuousTimeMode", continuous=True)
    for name in dir(fmi):
        if _DISCRETE_SETTER.fullmatch(name):
            outside(name)


class _Inputs(Input):  # type: ignore[misc]  # FMPy has no types
    """Inputs at times that differ by more than rounding from those of jumps, which FMPy takes for equal."""

    @staticmethod
    def interpolate(
        time: float,
        t: NDArray[np.float64],
        table: NDArray[np.float64],
        discrete: bool = False,
        after_event: bool = False,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return values and derivatives of continuous inputs, at a jump those after it.

        CVode restarts at jumps and evaluates these instants first.

        Args:
            time: the time (s)
            t: the times of the rows (s), shape (n,)
            table: the values, shape (number of inputs, n)
            discrete: of FMPy; not used
            after_event: of FMPy; not used
        """
        del discrete, after_event
        rounding = _ROUNDINGS * np.spacing(abs(time))
        row = int(np.searchsorted(t, time + rounding, side="right")) - 1
        if not 0 <= row < len(t) - 1:
            return table[:, max(row, 0)], np.zeros(len(table))
        slopes = (table[:, row + 1] - table[:, row]) / (t[row + 1] - t[row])
        return table[:, row] + (time - t[row]) * slopes, slopes
