"""Co-Simulation runs of one loaded FMU."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack
from ctypes import Array, c_double, c_int, c_uint
from dataclasses import dataclass
from os import PathLike
from types import TracebackType
from typing import Any, Final, Self

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from pyjoystick._types import FloatArray
from pyjoystick.checks import increasing_times, positive
from pyjoystick.errors import PyJoystickError
from pyjoystick.fmu.description import FmuDescription, Variable, read_description
from pyjoystick.fmu.files import find_fmu
from pyjoystick.fmu.inputs import Inputs, InputSeries, checked_inputs, communication_points, input_series
from pyjoystick.fmu.instance import Instance, instantiated
from pyjoystick.fmu.plan import Plan
from pyjoystick.fmu.values import Value, checked_outputs, checked_parameters
from pyjoystick.tables import make_table

#: Tolerance that the FMU's integrator is asked to keep.
DEFAULT_TOLERANCE: Final = 1e-8

_KINDS: Final = {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean"}
_TYPES: Final[dict[str, tuple[Any, type]]] = {
    "Real": (c_double, np.float64),
    "Integer": (c_int, np.int32),
    "Boolean": (c_int, np.bool_),
}
AnyArray = NDArray[Any]


class Fmu:
    """A Co-Simulation FMU (FMI 2.0), unpacked and instantiated once and run as often as wanted.

    >>> with Fmu("Joystick") as joystick:  # doctest: +SKIP
    ...     table = joystick.run([0.0, 0.5, 1.0], parameters={"theta_start": -0.35})

    Close it when done, best by `with`; what was unpacked is then deleted. Not to be shared between threads.

    Attributes:
        description: what the FMU says of itself
    """

    def __init__(self, fmu: str | PathLike[str]) -> None:
        """Open an FMU.

        Args:
            fmu: a name such as ``Joystick``, or the path of any .fmu file (see `find_fmu`)

        Raises:
            FmuNotFoundError: there is no such file
            FmuFileError: it is no FMU, or a broken one
            UnsupportedFmuError: it has no Co-Simulation, no binary for this machine, or is not of FMI 2.0
        """
        self.description: FmuDescription = read_description(find_fmu(fmu))
        with ExitStack() as stack:
            self._instance: Instance = stack.enter_context(instantiated(self.description, "CoSimulation"))
            self._close = weakref.finalize(self, stack.pop_all().close)
        self._used = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Free the instance and delete what was unpacked; closing twice does no harm."""
        self._close()

    def run(
        self,
        time: ArrayLike,
        *,
        parameters: Mapping[str, Value] | None = None,
        inputs: Inputs | None = None,
        outputs: Iterable[str] | None = None,
        tolerance: float = DEFAULT_TOLERANCE,
    ) -> pd.DataFrame:
        """Run the FMU from its start values and record it; earlier runs leave no trace.

        Args:
            time: instants to record (s), shape (n,), n >= 2, increasing; they are the communication points,
                and the kinks and jumps of the inputs with them
            parameters: values of parameters and start values by name, in the units of the FMU; those not
                given keep the FMU's own
            inputs: inputs by name, constant or changing in time, see `Inputs`; those not given keep the
                FMU's own. Where the FMU follows input derivatives the straight pieces are exact, else each
                communication step holds the value at its beginning.
            outputs: names of the variables to record; every output where not given
            tolerance: what the FMU's integrator is asked to keep

        Returns:
            a table indexed by ``time`` (s), one column a variable in the unit of the FMU; at a jump of an
            input the row is the one after it. `make_table` says where the units are.

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: a name is not one of the FMU's
            ParameterError, SeriesError: a value or series is not allowed
            FmuRunError: the FMU refuses its settings or fails during the run; it carries what the FMU said
        """
        if not self._close.alive:
            raise PyJoystickError(f"{self.description.path} has been closed")
        instants = increasing_times(time)
        tolerance = positive("tolerance", tolerance)
        values = checked_parameters(self.description, parameters or {})
        table = checked_inputs(self.description, {} if inputs is None else inputs)
        recorded = checked_outputs(self.description, outputs)
        points = communication_points(instants, table) if self.description.variable_steps else instants
        series = input_series(self.description, table, points)
        self._make_ready(float(instants[0]))
        with self._instance.reporting():
            _initialize(self._instance, points, tolerance, values, series)
            columns = _carry_out(self._instance, points, np.isin(points, instants), series, recorded)
            self._instance.fmi.terminate()
        return make_table(instants, columns, [variable.quantity for variable in recorded])

    def plan(
        self,
        time: ArrayLike,
        *,
        varied: Iterable[str] = (),
        parameters: Mapping[str, Value] | None = None,
        inputs: Inputs | None = None,
        outputs: Iterable[str] | None = None,
        tolerance: float = DEFAULT_TOLERANCE,
    ) -> Plan:
        """Prepare many runs that differ in a few parameters; everything else is checked here, once.

        Args:
            time: as in `run`
            varied: names of the parameters and start values that each run gives
            parameters: values that all runs share, as in `run`
            inputs: as in `run`
            outputs: as in `run`
            tolerance: as in `run`

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: a name is not one of the FMU's
            ParameterError, SeriesError: a value or series is not allowed, or a name is given twice
        """
        return Plan(self, time, varied, parameters or {}, inputs, outputs, tolerance)

    def _make_ready(self, start: float) -> None:
        """Bring the instance back to where it was after instantiation."""
        if self._instance.fatal:
            raise PyJoystickError(f"{self.description.path} has failed for good; open it again")
        with self._instance.reporting():
            if self._used:
                self._instance.fmi.reset()
        self._used = True
        self._instance.time = start


def _initialize(
    instance: Instance,
    points: FloatArray,
    tolerance: float,
    values: Mapping[str, Value],
    series: Sequence[InputSeries],
) -> None:
    fmi = instance.fmi
    stop_time = float(points[-1]) if instance.description.takes_stop_time else None
    fmi.setupExperiment(tolerance=tolerance, startTime=float(points[0]), stopTime=stop_time)
    for name, value in values.items():
        _set(fmi, instance.description.variables[name], value)
    fmi.enterInitializationMode()
    for one in series:
        _set(fmi, one.variable, one.values[0])
    fmi.exitInitializationMode()


def _carry_out(
    instance: Instance,
    points: FloatArray,
    is_recorded: NDArray[np.bool_],
    series: Sequence[InputSeries],
    variables: Sequence[Variable],
) -> dict[str, AnyArray]:
    """Step from point to point; the columns of what was recorded."""
    recorder = _Recorder(instance.fmi, variables, int(is_recorded.sum()))
    follows = instance.description.interpolates_inputs
    moving = [one for one in series if follows and np.any(one.slopes)]
    times = points.tolist()
    for k, time in enumerate(times):
        instance.time = time
        for one in series:
            if k and (one in moving or one.values[k] != one.values[k - 1]):
                _set(instance.fmi, one.variable, one.values[k])
        if is_recorded[k]:
            recorder.record()
        if k + 1 == len(times):
            break
        for one in moving:
            reference = [one.variable.value_reference]
            instance.fmi.setRealInputDerivatives(reference, [1], [float(one.slopes[k])])
        instance.fmi.doStep(time, times[k + 1] - time)
    return recorder.columns()


def _set(fmi: Any, variable: Variable, value: Any) -> None:
    kind = _KINDS.get(variable.type, "String")
    typed = {"Real": float, "Integer": int, "Boolean": bool, "String": str}[kind](value)
    getattr(fmi, f"set{kind}")([variable.value_reference], [typed])


class _Recorder:
    """Rows of values, read with one FMI call a type."""

    def __init__(self, fmi: Any, variables: Sequence[Variable], rows: int) -> None:
        self._fmi = fmi
        self._variables = variables
        self._row = 0
        self._readings: list[_Reading] = []
        for kind, (c_type, dtype) in _TYPES.items():
            group = [variable for variable in variables if _KINDS[variable.type] == kind]
            if group:
                references = (c_uint * len(group))(*(variable.value_reference for variable in group))
                data: AnyArray = np.empty((rows, len(group)), dtype=dtype)
                get = getattr(fmi, f"fmi2Get{kind}")
                self._readings.append(_Reading(group, get, references, (c_type * len(group))(), data))

    def record(self) -> None:
        """Add a row."""
        for reading in self._readings:
            reading.get(self._fmi.component, reading.references, len(reading.group), reading.buffer)
            reading.data[self._row] = reading.buffer
        self._row += 1

    def columns(self) -> dict[str, AnyArray]:
        """What was recorded, by name in the order of the variables."""
        found = {v.name: one.data[:, i] for one in self._readings for i, v in enumerate(one.group)}
        return {variable.name: found[variable.name] for variable in self._variables}


@dataclass(frozen=True, slots=True)
class _Reading:
    """The variables of one type: how they are read, and the rows so far."""

    group: Sequence[Variable]
    get: Callable[..., int]
    references: Array[c_uint]
    buffer: Array[Any]
    data: AnyArray
