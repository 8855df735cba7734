"""Co-Simulation of an FMU."""

from __future__ import annotations

import logging
import threading
import weakref
from collections.abc import Iterable, Mapping
from functools import partial
from os import PathLike
from typing import TYPE_CHECKING, Any, Final, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.description_file import read_description
from pyjoystick.fmu.errors import FmuEndedError, UnsupportedFmuError
from pyjoystick.fmu.files import find_fmu
from pyjoystick.fmu.inputs import Inputs
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.linearization import Linearization, linearize
from pyjoystick.fmu.not_finite import warn_not_finite
from pyjoystick.fmu.own_process.pool import ProcessPool, new_pool
from pyjoystick.fmu.plan import Plan
from pyjoystick.fmu.sandbox.pool import SandboxPool
from pyjoystick.fmu.sensitivities import advice, counterpart, has_sensitivities, wanted_names
from pyjoystick.fmu.stepper import Stepper
from pyjoystick.fmu.values import Value, default_outputs
from pyjoystick.motion import make_table
from pyjoystick.support import DEFAULT_TOLERANCE, FloatArray, ParameterError, Shown

if TYPE_CHECKING:
    import pandas as pd

_LOG = logging.getLogger(__name__)
#: Kinds of pools in which instances can run.
_PLACES: Final = {
    InstancePool: "in this process",
    ProcessPool: "in a process of its own",
    SandboxPool: "in a sandbox",
}

_V = TypeVar("_V")


class Fmu(Shown):
    """A Co-Simulation FMU (FMI 2.0 or 3.0), loaded once for any number of runs.

    >>> with Fmu("Joystick") as joystick:  # doctest: +SKIP
    ...     table = joystick.run([0.0, 0.5, 1.0], parameters={"theta_start": -0.35})

    Use it in a `with` statement or close it; the unpacked files are then deleted. It is thread-safe:
    each run has its own instance of the FMU, which is kept for later runs. Pickling stores
    the path of the file; unpickling opens that file again (FmuNotFoundError if it is missing).

    For many runs see `plan`.

    Attributes:
        description: contents of the FMU's modelDescription.xml
    """

    _shown_by = "pyjoystick.fmu.notebook"

    def __init__(
        self,
        fmu: str | PathLike[str],
        *,
        own_process: bool | None = None,
        time_limit: float | None = None,
        sandbox: bool = False,
    ) -> None:
        """Open an FMU.

        Args:
            fmu: a name such as ``Joystick``, or the path of any .fmu file (see `find_fmu`)
            own_process: run the FMU in a separate process (one per thread of a batch), where it can neither
                crash, exit nor hang the caller, nor mix its output with the caller's. By default, FMUs
                made by this project (according to their ``generationTool``) run in the caller's process and
                all others in their own.
            time_limit: wall-clock limit of a run (s), or ``math.inf``. By default, there is no limit in the
                caller's process, where a run can only be stopped between two communication points, and
                300 s in a separate process, which is killed, and in a sandbox.
            sandbox: run the WebAssembly module of an FMI 2.0 FMU (``fmu_build --platform wasm32``)
                instead of its binary. It has no access to files, network or processes; memory and
                instructions are limited. For untrusted FMUs; supports `run` and `plan`, but not `start` and
                `linearize`.

        Raises:
            FmuNotFoundError: there is no such file
            FmuFileError: the file is not an FMU, is broken, or crashes when it is loaded
            UnsupportedFmuError: it has no Co-Simulation, no binary for this machine, no module for a sandbox,
                or another FMI version
            MissingPackageError: `sandbox` needs wasmtime (``pip install 'pyjoystick[sandbox]'``)
            ParameterError: `sandbox` together with `own_process`
        """
        if sandbox and own_process is not None:
            raise ParameterError("own_process", own_process, "left out where sandbox is True")
        self.description: FmuDescription = read_description(find_fmu(fmu))
        self._path = self.description.path.absolute()  # now: the current folder may change
        choice = {"own_process": own_process, "time_limit": time_limit, "sandbox": sandbox}
        self._choice: dict[str, Any] = choice
        self._pool = (
            SandboxPool(self.description, time_limit)
            if sandbox
            else new_pool(self.description, own_process, time_limit)
        )
        _LOG.info(
            "opened %s: %s, FMI %s, made by %s; runs %s",
            self.description.path,
            self.description.model_name,
            self.description.fmi_version,
            self.description.generation_tool or "an unknown tool",
            _PLACES[type(self._pool)],
        )
        self._close = weakref.finalize(self, self._pool.close)
        self._lock = threading.Lock()
        self._sensitive: Fmu | None = None

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(Fmu, **self._choice), (self._path,)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Free the instances and delete the unpacked files; may be called more than once."""
        self._close()
        if self._sensitive is not None:
            self._sensitive._close()

    def run(
        self,
        time: ArrayLike,
        *,
        parameters: Mapping[str, Value] | None = None,
        inputs: Inputs | None = None,
        outputs: Iterable[str] | None = None,
        tolerance: float = DEFAULT_TOLERANCE,
    ) -> pd.DataFrame:
        """Run the FMU from its start values and record it, independently of earlier runs.

        Args:
            time: times to record (s), shape (n,), n >= 2, increasing; together with the kinks and jumps of
                the inputs they are the communication points
            parameters: parameters and start values by name, in the units of the FMU; others keep the FMU's
                own values
            inputs: inputs by name, constant or over time, see `Inputs`; others keep the FMU's own values. If
                the FMU uses input derivatives, inputs are linear between samples; otherwise each is constant
                during a communication step, at its value at the start of the step.
            outputs: names of the variables to record, arrays by element (``x[1]``, ``grid[2,3]``); by default
                every output, with arrays as their elements
            tolerance: tolerance of the FMU's integrator

        Returns:
            a table indexed by ``time`` (s), with one column per variable in the unit of the FMU; at a jump of
            an input, the row holds the values after it, but what an FMU changes at events only, such as
            integers, Booleans and branches, it may change with the next step. Integers of any size are exact;
            text is text.
            `make_table` describes where the units are; ``attrs["left_out"]`` names outputs that a table
            cannot hold (binary data, clocks) and that were therefore omitted by default.

        Warns:
            NotFiniteWarning: results are NaN or infinite

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: the FMU has no such name
            ParameterError, SeriesError: a value or series is not allowed
            FmuEndedError: the FMU terminated the simulation; the error's `samples` is the table so far
            FmuTimeLimitError: the run takes longer than `time_limit`
            FmuCrashError: the FMU's process ended
            FmuFuelError, FmuMemoryError, FmuTrapError: the FMU breaks a limit or a rule of its sandbox
            FmuRunError: the FMU rejects its settings or fails during the run; it carries the FMU's messages
        """
        left_out: tuple[str, ...] = ()
        if outputs is None:
            recorded, left_out = default_outputs(self.description, texts=True)
            outputs = [variable.name for variable in recorded]
        plan = self.plan(time, parameters=parameters, inputs=inputs, outputs=outputs, tolerance=tolerance)
        try:
            samples = _columns(plan, plan.record())
        except FmuEndedError as error:
            error.samples = _table(plan, error.samples.instants, _columns(plan, error.samples.raw))
            raise
        warn_not_finite(self.description.path, plan.time, samples)
        table = _table(plan, plan.time, samples)
        if left_out:
            table.attrs["left_out"] = list(left_out)
        return table

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
        """Prepare many runs that differ in a few parameters; everything else is checked once, here.

        Args:
            time: as in `run`
            varied: names of the parameters and start values that differ between runs
            parameters: values common to all runs, as in `run`
            inputs: as in `run`
            outputs: as in `run`, but without text variables by default; `Plan.left_out` names those
            tolerance: as in `run`

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: the FMU has no such name
            ParameterError, SeriesError: a value or series is not allowed, or a name is given twice
        """
        return Plan(self, self._pool, time, varied, _without_none(parameters), inputs, outputs, tolerance)

    def start(
        self,
        time: float = 0.0,
        *,
        parameters: Mapping[str, Value] | None = None,
        inputs: Mapping[str, Value] | None = None,
        outputs: Iterable[str] | None = None,
        stop_time: float | None = None,
        tolerance: float = DEFAULT_TOLERANCE,
    ) -> Stepper:
        """Start a simulation that the caller steps; close it when done.

        With the same communication points, and `stop_time` at the last of them, results are bitwise those of
        `run`.

        Args:
            time: start time (s)
            parameters: as in `run`
            inputs: initial values by name; others keep the FMU's own values
            outputs: variables that a step returns, as in `run`
            stop_time: the end (s), if known; an FMU may adapt its own steps to it, as ours do
            tolerance: as in `run`

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: the FMU has no such name
            ParameterError: a value is not allowed
            UnsupportedFmuError: the FMU can be instantiated only once per process and would run in this one,
                or it is in a sandbox
            FmuRunError: the FMU rejects its settings
        """
        settings = _without_none(parameters), _without_none(inputs), outputs, tolerance
        return Stepper(self, self._steppable(), time, stop_time, *settings)

    def linearize(
        self,
        time: float = 0.0,
        *,
        parameters: Mapping[str, Value] | None = None,
        inputs: Mapping[str, float] | None = None,
        outputs: Iterable[str] | None = None,
        tolerance: float = DEFAULT_TOLERANCE,
        step: float | None = None,
    ) -> Linearization:
        """Linearize the FMU at a point of a motion, with the FMU's own derivatives.

        Args:
            time: time of the point on the motion from the start values (s); 0 is the start
            parameters: as in `run`; start values determine the point
            inputs: constant inputs by name; others keep the FMU's own values
            outputs: names of real variables, the rows of C and D; by default every continuous output
            tolerance: as in `run`
            step: longest communication step on the way to the point (s), with which some FMUs integrate; by
                default that of the FMU's default experiment, or a thousandth of the time

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: the FMU has no such name
            ParameterError: a value is not allowed, the time is negative, or the steps are too many
            UnsupportedFmuError: the FMU provides neither directional nor adjoint derivatives, or is in a
                sandbox
            FmuRunError: the FMU rejects its settings, fails before the point or has no derivatives there
        """
        arguments = time, _without_none(parameters), _without_none(inputs), outputs, tolerance, step
        pool = self._steppable()
        if isinstance(pool, ProcessPool):
            found: Linearization = pool.linearize(*arguments)
            return found
        with pool.lent() as instance:
            return linearize(instance, *arguments)

    @property
    def sensitive(self) -> Fmu | None:
        """FMU of this model whose outputs include sensitivities; None if there is none.

        This one, if it was built with sensitivities; otherwise the one of the same name in the
        ``sensitivities`` folder next to it, opened on first use and closed with this one. Its plans and
        batches compute sensitivities for many runs, under names such as ``sensitivity.theta.J``.

        Raises:
            UnsupportedFmuError: the FMU there is of another model
        """
        if has_sensitivities(self.description):
            return self
        with self._lock:
            if self._sensitive is None and (path := counterpart(self.description, self._path)) is not None:
                self._sensitive = Fmu(path, **self._choice)
            return self._sensitive

    def sensitivities(
        self,
        time: ArrayLike,
        *,
        by: Iterable[str],
        outputs: Iterable[str],
        parameters: Mapping[str, Value] | None = None,
        inputs: Inputs | None = None,
        tolerance: float = DEFAULT_TOLERANCE,
    ) -> pd.DataFrame:
        """Derivatives of a run with respect to parameters and start values, exact through events.

        Args:
            time: as in `run`
            by: names of parameters
            outputs: names of the variables to differentiate
            parameters: as in `run`
            inputs: as in `run`
            tolerance: as in `run`; it also applies to sensitivities

        Returns:
            a table as from `run`, with columns ``sensitivity.OUTPUT.PARAMETER``, grouped by output

        Raises:
            UnknownParameterError, UnknownVariableError: the FMU has no parameter or variable of that name
            UnsupportedFmuError: neither this FMU nor the one in the ``sensitivities`` folder next to it was
                built with them
            As `run`
        """
        sensitive = self.sensitive
        if sensitive is None:
            raise UnsupportedFmuError(
                self.description.path, f"has no sensitivities: {advice(self.description)}"
            )
        names = wanted_names(sensitive.description, outputs, by)
        return sensitive.run(time, parameters=parameters, inputs=inputs, outputs=names, tolerance=tolerance)

    def _steppable(self) -> InstancePool | ProcessPool:
        """The pool, for operations that a sandbox does not support."""
        if isinstance(self._pool, SandboxPool):
            raise UnsupportedFmuError(
                self.description.path, "runs in a sandbox, which supports only whole runs"
            )
        return self._pool


def _without_none(values: Mapping[str, _V] | None) -> Mapping[str, _V]:
    return {} if values is None else values  # a table has no truth value for `or`


def _columns(plan: Plan, samples: NDArray[np.void]) -> dict[str, NDArray[Any]]:
    return {
        variable.name: samples[variable.name] != 0 if variable.type == "Boolean" else samples[variable.name]
        for variable in plan.variables
    }


def _table(plan: Plan, time: FloatArray, columns: Mapping[str, NDArray[Any]]) -> pd.DataFrame:
    return make_table(time, columns, [variable.quantity for variable in plan.variables])
