"""One run of a plan as calls of a module's functions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from pyjoystick.fmu.preparation import Preparation
from pyjoystick.fmu.sandbox.exchange import InputTables, Layout, Setting, packed
from pyjoystick.fmu.sandbox.machine import Machine, MachineError
from pyjoystick.fmu.stepping.program import DISCARD
from pyjoystick.support import FloatArray

#: Approximate size of a chunk of the table (numbers), as the module's memory is for its model.
_PIECE: Final = 2**16


class RefusedError(Exception):
    """A call of the module that failed in a way that FMI allows.

    Attributes:
        what: the operation
        status: FMI status
        messages: messages of the model
        end: when the model terminated the simulation (s); None if it did not
    """

    def __init__(self, what: str, status: int, messages: tuple[str, ...], end: float | None = None) -> None:
        super().__init__(what)
        self.what, self.status, self.messages, self.end = what, status, messages, end


class SandboxedRun:
    """Executes one run, and holds its results so far.

    Attributes:
        table: samples at the communication points, shape (points, columns of the layout)
        rows: number of filled rows
        after: a sample after the last row, if the model terminated the simulation between two points
    """

    def __init__(
        self, machine: Machine, preparation: Preparation, layout: Layout, inputs: InputTables
    ) -> None:
        self._machine = machine
        self._program = preparation.program
        self._times = self._program.times
        self._layout = layout
        self._inputs = inputs
        self.table = np.empty((len(self._times), layout.n))
        self.rows = 0
        self.after: FloatArray | None = None

    @property
    def reached(self) -> float:
        """The last communication point (s) known to have been reached."""
        return float(self._times[max(0, self.rows - 1)])

    def carry_out(self, start_values: Sequence[Setting]) -> None:
        """Run from the start values to the end; raises `RefusedError` or MachineError."""
        first, last = 0, len(self._times) - 1
        experiment = float(self._times[0]), float(self._times[-1]), float(self._program.tolerance)
        self._require_good("the set-up of the experiment", self._machine.call("explore_begin", *experiment))
        self._set("the setting of start values", [*start_values, *self._inputs.at_start()])
        self._require_good("the initialization", self._machine.call("explore_initialize"))
        most = max(2, _PIECE // max(1, self._layout.n + 2 * self._inputs.n))
        while True:
            until = min(first + most - 1, self._inputs.next_change(first, last))
            self._record(first, until)
            if until == last:
                return
            first = until
            self._set("the setting of inputs", self._inputs.at(first))

    def _set(self, what: str, settings: Sequence[Setting]) -> None:
        for one in settings:
            content, (references, values) = packed((one.references, one.values))
            at = self._machine.place(content)
            self._require_good(what, self._machine.call(one.function, one.n, at + references, at + values))

    def _record(self, first: int, until: int) -> None:
        """Take samples from one communication point to another; the first is taken again."""
        times = self._times[first : until + 1]
        rows, table = self._call_record(times, self._inputs.n, self._inputs.table(first, until))
        if not 0 <= rows <= len(times):
            raise MachineError(f"it filled {rows} rows of {len(times)}")
        self.table[first : first + rows] = table[:rows]
        self.rows = max(self.rows, first + rows)
        if rows < len(times):
            raise self._refusal("the run", self._machine.call("explore_status"))

    def _call_record(self, times: FloatArray, n: int, inputs: tuple[bytes, bytes]) -> tuple[int, FloatArray]:
        """Number of rows that the module claims to have filled, and the table."""
        layout, call = self._layout, self._machine.call
        room = 8 * len(times) * layout.n
        parts = (
            bytes(room),
            times.tobytes(),
            layout.references,
            layout.kinds,
            self._inputs.references,
            *inputs,
        )
        content, begins = packed(parts)
        address = self._machine.place(content)
        table, points, references, kinds, own, values, slopes = (address + begin for begin in begins)
        call("explore_inputs", n, own, len(times), values, slopes)
        rows: int = call("explore_record", layout.n, references, kinds, len(times), points, table)
        numbers = np.frombuffer(self._machine.read(table, room), "<f8")
        return rows, numbers.reshape(len(times), layout.n)

    def _require_good(self, what: str, status: int) -> None:
        if status:
            raise self._refusal(what, status)

    def _refusal(self, what: str, status: int) -> RefusedError:
        messages = tuple(self._machine.text("explore_message").splitlines())
        if status != DISCARD or not self.rows:
            return RefusedError(what, status, messages)
        # The model terminated the simulation between this point and the next.
        next_point = float(self._times[min(self.rows, len(self._times) - 1)])
        end = self._machine.call("explore_time")
        end = min(max(end, self.reached), next_point) if math.isfinite(end) else self.reached
        if end > self.reached:
            rows, table = self._call_record(np.array([end]), 0, (b"", b""))
            self.after = table if rows == 1 else None
        return RefusedError(what, status, messages, end)
