"""Co-Simulation runs of one loaded FMU."""

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
#: Where the instances of a pool run.
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

    Close it when done, best with a `with` statement; the unpacked files are then deleted. Several threads may
    use it at once: each run has its own instance of the FMU, which is kept for later runs. Pickling stores
    the path of the file; unpickling opens that file again (FmuNotFoundError if it is missing).

    For many runs see `plan`.

    Attributes:
        description: the FMU's own description
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
            own_process: run the FMU in a process of its own (one a thread of a batch), where it can neither
                crash, end nor hang the caller, nor mix its output with the caller's. Where not given, FMUs
                that this project made (their ``generationTool`` says so) run in the caller's process and all
                others in their own.
            time_limit: what a run may take by the clock, s, or ``math.inf``. Where not given: any time in the
                caller's process, where a run is ended between two communication points; 300 s in a process
                of its own, which is ended, and in a sandbox.
            sandbox: run the WebAssembly module of an FMU of FMI 2.0 (``fmu_build --platform wasm32``) in
                place of its binary. It reaches no file, network or process; memory and instructions are
                bounded. For FMUs from strangers; `run` and `plan` work, `start` and `linearize` do not.

        Raises:
            FmuNotFoundError: there is no such file
            FmuFileError: it is no FMU, or a broken one, or it crashes when it is loaded
            UnsupportedFmuError: it has no Co-Simulation, no binary for this machine, no module for a sandbox,
                or another FMI version
            MissingPackageError: `sandbox` needs wasmtime (``pip install 'pyjoystick[sandbox]'``)
            ParameterError: `sandbox` together with `own_process`
        """
        if sandbox and own_process is not None:
            raise ParameterError("own_process", own_process, "left out where sandbox is True")
        self.description: FmuDescription = read_description(find_fmu(fmu))
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
        return partial(Fmu, **self._choice), (self.description.path.absolute(),)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Free the instances and delete what was unpacked; closing twice does no harm."""
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
            time: instants to record (s), shape (n,), n >= 2, increasing; they are the communication points,
                and the kinks and jumps of the inputs with them
            parameters: values of parameters and start values by name, in the units of the FMU; those not
                given keep the FMU's own
            inputs: inputs by name, constant or changing in time, see `Inputs`; those not given keep the
                FMU's own. Where the FMU follows input derivatives the straight pieces are exact, else each
                communication step holds the value at its beginning.
            outputs: names of the variables to record, of an array element by element (``x[1]``,
                ``grid[2,3]``); every output where not given, arrays as their elements
            tolerance: of the FMU's integrator

        Returns:
            a table indexed by ``time`` (s), one column a variable in the unit of the FMU; at a jump of an
            input the row is the one after it. Whole numbers of any size are exact; text is text. `make_table`
            says where the units are; ``attrs["left_out"]`` names outputs without such a value (binary data,
            clocks) where `outputs` is not given.

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: a name is not one of the FMU's
            ParameterError, SeriesError: a value or series is not allowed
            FmuEndedError: the FMU ended the simulation by itself; its `samples` is the table up to there
            FmuTimeLimitError: the run takes longer than `time_limit`
            FmuCrashError: the FMU's process ended
            FmuFuelError, FmuMemoryError, FmuTrapError: the FMU breaks a limit or a rule of its sandbox
            FmuRunError: the FMU refuses its settings or fails during the run; it carries the FMU's messages
        """
        left_out: tuple[str, ...] = ()
        if outputs is None:
            recorded, left_out = default_outputs(self.description, texts=True)
            outputs = [variable.name for variable in recorded]
        plan = self.plan(time, parameters=parameters, inputs=inputs, outputs=outputs, tolerance=tolerance)
        try:
            table = _table(plan, plan.time, plan.record())
        except FmuEndedError as error:
            error.samples = _table(plan, error.samples.instants, error.samples.raw)
            raise
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
            varied: names of the parameters and start values that each run gives
            parameters: values that all runs share, as in `run`
            inputs: as in `run`
            outputs: as in `run`, but without texts where not given; `Plan.left_out` names those
            tolerance: as in `run`

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: a name is not one of the FMU's
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
        """Begin a simulation that goes on step by step, as its user says; close it when done.

        With the same communication points, and `stop_time` at the last of them, the results are those of
        `run`, bit for bit.

        Args:
            time: of the start (s)
            parameters: as in `run`
            inputs: values at the start by name; those not given keep the FMU's own
            outputs: as in `run`; what a step returns
            stop_time: the end (s) where it is known: the FMU may choose its own steps by it, as ours do
            tolerance: as in `run`

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: a name is not one of the FMU's
            ParameterError: a value is not allowed
            UnsupportedFmuError: the FMU can be instantiated only once in a process, and would be in this one;
                or it is in a sandbox
            FmuRunError: the FMU refuses its settings
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
    ) -> Linearization:
        """The linear system that the FMU is near one point of a motion, from its own derivatives.

        Args:
            time: where on the motion from the start values, s; 0 is the start
            parameters: as in `run`; start values choose the point
            inputs: constant inputs by name; those not given keep the FMU's own
            outputs: names of real variables, the rows of C and D; every continuous output where not given
            tolerance: as in `run`

        Raises:
            UnknownParameterError, UnknownInputError, UnknownVariableError: a name is not one of the FMU's
            ParameterError: a value is not allowed, or the time is negative
            UnsupportedFmuError: the FMU provides neither directional nor adjoint derivatives, or is in a
                sandbox
            FmuRunError: the FMU refuses its settings, fails on the way or has no derivatives there
        """
        arguments = time, _without_none(parameters), _without_none(inputs), outputs, tolerance
        pool = self._steppable()
        if isinstance(pool, ProcessPool):
            found: Linearization = pool.linearize(*arguments)
            return found
        with pool.lent() as instance:
            return linearize(instance, *arguments)

    @property
    def sensitive(self) -> Fmu | None:
        """The FMU of this model that has sensitivities as outputs; None where there is none.

        This one, if it was built for them; else the one of the same name in the folder ``sensitivities``
        beside it, opened when it is first asked for and closed with this one. Its plans and batches give
        sensitivities for many runs: their names are ``sensitivity.theta.J`` and so on.

        Raises:
            UnsupportedFmuError: the FMU there is of another model
        """
        if has_sensitivities(self.description):
            return self
        with self._lock:
            if self._sensitive is None and (path := counterpart(self.description)) is not None:
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
        """Derivatives of a run by parameters and start values, exact through events.

        Args:
            time: as in `run`
            by: names of parameters
            outputs: names of the variables that are differentiated
            parameters: as in `run`
            inputs: as in `run`
            tolerance: as in `run`; sensitivities keep it too

        Returns:
            a table as that of `run`, with the columns ``sensitivity.OUTPUT.PARAMETER``, those of one output
            together

        Raises:
            UnknownParameterError, UnknownVariableError: the FMU has no parameter or variable of that name
            UnsupportedFmuError: neither this FMU nor the one in ``sensitivities`` beside it was built for
                them
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
        """The pool, for what a sandbox does not do."""
        if isinstance(self._pool, SandboxPool):
            raise UnsupportedFmuError(self.description.path, "is in a sandbox, which does whole runs only")
        return self._pool


def _without_none(values: Mapping[str, _V] | None) -> Mapping[str, _V]:
    return {} if values is None else values  # `or` would ask a table whether it is true


def _table(plan: Plan, time: FloatArray, samples: NDArray[np.void]) -> pd.DataFrame:
    columns = {
        variable.name: samples[variable.name] != 0 if variable.type == "Boolean" else samples[variable.name]
        for variable in plan.variables
    }
    return make_table(time, columns, [variable.quantity for variable in plan.variables])
