"""Execution of a plan's runs in a sandbox."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.errors import (
    THE_END,
    FmuEndedError,
    FmuFuelError,
    FmuMemoryError,
    FmuRunError,
    FmuTimeLimitError,
    FmuTrapError,
    UnsupportedFmuError,
)
from pyjoystick.fmu.runner import Job, Samples
from pyjoystick.fmu.sandbox.exchange import InputTables, Layout, settings_of
from pyjoystick.fmu.sandbox.machine import (
    FuelError,
    LateError,
    Machine,
    MachineError,
    MachineMemoryError,
    StoppedError,
)
from pyjoystick.fmu.sandbox.pool import SandboxPool
from pyjoystick.fmu.sandbox.run import RefusedError, SandboxedRun
from pyjoystick.fmu.stepping.program import ERROR, OK, STOPPED, TEXT
from pyjoystick.fmu.stepping.reducing import Operation, reduce_run

_KINDS: Final[dict[type[MachineError], type[FmuRunError]]] = {
    LateError: FmuTimeLimitError,
    FuelError: FmuFuelError,
    MachineMemoryError: FmuMemoryError,
}
_LABELS: Final = {2: "discard", 3: "error", 4: "fatal"}


class SandboxRunner:
    """Like `pyjoystick.fmu.runner.Runner`, on a machine that is replaced if it breaks."""

    def __init__(self, pool: SandboxPool, job: Job, operations: Sequence[Operation]) -> None:
        """Initialize without a machine.

        Args:
            pool: machines with the FMU
            job: the runs
            operations: what to keep of each run

        Raises:
            UnsupportedFmuError: a variable is text, which a module does not support
        """
        self._path = pool.description.path
        preparation = self._preparation = job.preparation
        program = preparation.program
        if any(group.kind == TEXT for group in (*program.constants, *program.inputs, *program.outputs)):
            raise UnsupportedFmuError(
                self._path, "has text among its variables; a sandbox supports only numbers"
            )
        self._pool = pool
        self._job = job
        self._operations = operations
        self._constants = settings_of(preparation, program.constants, program.constants_row)
        self._inputs = InputTables(preparation)
        self._layout = Layout(preparation)
        self._recorded = program.recorded
        self._machine: Machine | None = None
        self._run: SandboxedRun
        self._failed: tuple[int, FmuRunError] | None = None

    def close(self) -> None:
        """Return the machine to the pool."""
        if self._machine is not None:
            machine, self._machine = self._machine, None
            self._pool.give_back(machine)

    def advance(self, first: int, last: int, values: NDArray[np.float64]) -> int:
        """Execute the runs `first` to `last` - 1, up to the first that fails.

        Returns:
            OK, STOPPED, or ERROR, which requires a call of `failure`

        Raises:
            FmuFileError: the module cannot be started again
        """
        job = self._job
        for run in range(first, last):
            if job.stop[0]:
                return STOPPED
            try:
                self._carry_out(run)
            except StoppedError:
                return STOPPED
            except FmuRunError as error:
                self._failed = run, error
                return ERROR
            finally:
                if self._machine is not None and not self._machine.is_alive:
                    self.close()
            samples = values[run if len(values) > 1 else 0]
            samples[:, self._layout.columns] = self._run.table[self._recorded]
            reduce_run(self._operations, job.instants, samples, job.cells[run])
            job.done[run] = True
        return OK

    def failure(self, _status: int) -> tuple[int, FmuRunError]:
        """Index of the run that failed, and the error."""
        assert self._failed is not None
        return self._failed

    def recorded(self) -> NDArray[np.void]:
        """Samples of the last run in the types of the FMU, by variable, shape (samples,)."""
        return self._layout.rows(self._run.table[self._recorded])

    def _carry_out(self, run: int) -> None:
        """Execute one run, leaving its samples in `_run`; raises FmuRunError or StoppedError."""
        if self._machine is None:
            self._machine = self._pool.take()
        job = self._job
        row = job.rows.ctypes.data + run * self._preparation.program.varied_stride
        varied = settings_of(self._preparation, self._preparation.program.varied, row)
        limit = math.inf if job.time_limit is None else job.time_limit
        current = self._run = SandboxedRun(self._machine, self._preparation, self._layout, self._inputs)
        try:
            self._machine.run(
                lambda: current.carry_out([*self._constants, *varied]), limit, lambda: bool(job.stop[0])
            )
        except StoppedError:
            raise
        except MachineError as error:
            kind = _KINDS.get(type(error), FmuTrapError)
            raise kind(current.reached, f"in the sandbox: {error}", self._path) from None
        except RefusedError as refusal:
            raise self._error(refusal) from None
        self._require_numbers()

    def _error(self, refusal: RefusedError) -> FmuRunError:
        """Make the error for a call that failed."""
        if refusal.end is None:
            label = _LABELS.get(refusal.status, "not a status")
            reason = f"{refusal.what} failed with status {refusal.status} ({label})"
            return FmuRunError(self._run.reached, reason, self._path, refusal.messages)
        self._require_numbers()
        error = FmuEndedError(refusal.end, THE_END, self._path, refusal.messages)
        error.samples = self._samples_until(refusal.end)
        return error

    def _samples_until(self, end: float) -> Samples:
        """The recorded samples, plus one at the end if none was taken there."""
        run, kept = self._run, self._recorded[: self._run.rows]
        instants = self._preparation.program.times[: run.rows][kept]
        table = run.table[: run.rows][kept]
        if run.after is not None:
            instants, table = np.append(instants, end), np.concatenate((table, run.after))
        numbers = np.empty_like(table)
        numbers[:, self._layout.columns] = table
        return Samples(instants, numbers, self._layout.rows(table))

    def _require_numbers(self) -> None:
        """Raise FmuTrapError for values outside their types."""
        run = self._run
        tables = [run.table[: run.rows], *([] if run.after is None else [run.after])]
        for name in filter(None, map(self._layout.wrong_column, tables)):
            reason = f"in the sandbox: {name} is not a number of its type"
            raise FmuTrapError(run.reached, reason, self._path)
