"""One simulation in progress, driven call by call."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from ctypes import c_double, c_ubyte

import numpy as np

from pyjoystick.fmu.description import Variable
from pyjoystick.fmu.failures import failure
from pyjoystick.fmu.inputs import checked_inputs, input_series
from pyjoystick.fmu.interface import RowFormat, TextGetter
from pyjoystick.fmu.interrupts import CtrlC
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.preparation import Preparation, prepare
from pyjoystick.fmu.stepping.calls import access2, access3, bound, change_mode, do_step2, do_step3
from pyjoystick.fmu.stepping.kernel import start, stopped_short
from pyjoystick.fmu.stepping.program import (
    BETWEEN_RUNS,
    EARLY,
    ENDED,
    FATAL,
    FLAGS_SIZE,
    FLOAT64,
    FUNCTION,
    OK,
    POINT,
    REACHED,
    STEP,
    TERMINATE,
    WARNING,
    Group,
    Workspace,
)
from pyjoystick.fmu.values import Value, checked_outputs, checked_parameters
from pyjoystick.support import FloatArray

#: New values in the order in which to set them.
Changes = Sequence[tuple[str, Value]]


class LiveInstance:
    """An instance during a simulation; its methods take the time (s) at which they are called.

    It is started by the code that starts runs. All methods raise `FmuRunError`; after an error, the instance
    must be abandoned.
    """

    def __init__(
        self,
        pool: InstancePool,
        time: float,
        stop_time: float | None,
        parameters: Mapping[str, Value],
        inputs: Mapping[str, Value],
        tolerance: float,
    ) -> None:
        """Take an instance to its first communication point; arguments as in `Fmu.start`."""
        description = pool.description
        points = np.array([time, math.inf if stop_time is None else stop_time])
        self._preparation = prepare(
            description,
            pool.library.fmi,
            points,
            np.zeros(2, np.bool_),
            tolerance,
            checked_parameters(description, parameters),
            (),
            input_series(description, checked_inputs(description, inputs), points),
            (),
        )
        program = self._preparation.program
        if stop_time is None:
            program = program._replace(stop_defined=0)
        self._setters: dict[str, _Setter] = {}
        self._getters: dict[tuple[str, ...], _Getter] = {}
        self._saved: set[int] = set()
        self._pool = pool
        self._instance = pool.take()
        self._begin()
        self._workspace = self._instance.workspace(0)
        is_new, self._instance.is_new = self._instance.is_new, False
        try:
            with CtrlC():
                status = start(program, self._workspace, is_new, 0)
            self._check(status, int(self._workspace.place[FUNCTION]), time)
        except BaseException:
            self.abandon()
            raise
        self._step = _Step(self._preparation, self._workspace, no_going_back=not description.saves_states)

    def step(self, time: float, end: float, changes: Changes, names: tuple[str, ...]) -> tuple[Value, ...]:
        """Set changed values, step to `end` (s) and get the variables of these names there."""
        self._begin()
        self._set(time, changes)
        # `end` is passed as is: `end` - `time` may differ from the requested length by rounding.
        with CtrlC():
            status = self._step.take(time, end - time)
        self._check(status, STEP, time)
        return self._get(end, names)

    def set(self, time: float, changes: Changes) -> None:
        """Set variables."""
        self._begin()
        self._set(time, changes)

    def get(self, time: float, names: tuple[str, ...]) -> tuple[Value, ...]:
        """Get values of variables."""
        self._begin()
        return self._get(time, names)

    def save(self, time: float) -> int:
        """Save the state, see `Instance.save`."""
        with self._instance.reporting(time):
            state = self._instance.save()
        self._saved.add(state)
        return state

    def restore(self, time: float, state: int) -> None:
        """Restore a saved state."""
        with self._instance.reporting(time):
            self._instance.restore(state)

    def forget(self, time: float, state: int) -> None:
        """Free a saved state."""
        self._saved.remove(state)
        with self._instance.reporting(time):
            self._instance.forget(state)

    def stop(self, time: float = 0.0) -> None:
        """End the simulation and return the instance to the pool."""
        try:
            for state in tuple(self._saved):
                self.forget(time, state)
            self._begin()
            function = self._preparation.program.functions[TERMINATE]
            self._check(change_mode(int(function), self._workspace.instance), TERMINATE, time)
        finally:
            self._give_back()

    def abandon(self) -> None:
        """Return an unusable instance to the pool."""
        self._instance.is_broken = True
        self._give_back()

    def _give_back(self) -> None:
        self._workspace.place[POINT] = BETWEEN_RUNS
        self._pool.give_back(self._instance)

    def _begin(self) -> None:
        """Collect the messages of the next call."""
        log = self._instance.log
        if self._preparation.interface.version == 2:  # other users of FMPy may have replaced its logger
            log.attach()
        log.clear()

    def _set(self, time: float, changes: Changes) -> None:
        for name, value in changes:
            setter = self._setters.get(name)
            if setter is None:
                variable = self._pool.description.variables[name]
                setter = self._setters[name] = _Setter(self._preparation, self._workspace, variable)
            self._check(setter.set(value), setter.function, time)

    def _get(self, time: float, names: tuple[str, ...]) -> tuple[Value, ...]:
        getter = self._getters.get(names)
        if getter is None:
            variables = checked_outputs(self._pool.description, names, texts=True)
            getter = self._getters[names] = _Getter(self._preparation, self._workspace, variables)
        for function, call in getter.calls:
            status = call()
            if getter.texts is not None:
                getter.texts.check()
            self._check(status, function, time)
        return getter.values()

    def _check(self, status: int, function: int, time: float) -> None:
        """Raise the error for a bad status."""
        if status not in (OK, WARNING):
            instance = self._instance
            self._workspace.place[FUNCTION] = function
            error = failure(instance, self._workspace, self._preparation.interface, status, time)
            instance.is_broken, instance.is_lost = True, status == FATAL
            raise error


class _Step:
    """A call of the step function as the kernel makes it, with its constant arguments laid out in advance."""

    def __init__(self, preparation: Preparation, workspace: Workspace, *, no_going_back: bool) -> None:
        self._time, self._length = c_double(), c_double()
        address, flags = int(preparation.program.functions[STEP]), workspace.flags_address
        arguments = workspace.instance, self._time, self._length, int(no_going_back)
        self._told = (c_ubyte * FLAGS_SIZE).from_address(flags)
        self._reached = c_double.from_address(flags + REACHED)
        if preparation.interface.version == 2:
            self._call = bound(do_step2, address, *arguments, is_short=False)
        else:
            told = flags, flags + 8, flags + 16, flags + REACHED
            self._call = bound(do_step3, address, *arguments, *told, is_short=False)

    def take(self, time: float, length: float) -> int:
        self._time.value, self._length.value = time, length
        status = self._call()
        if status in (OK, WARNING):
            # FMI 2 FMUs leave the flags alone.
            if self._told[8]:
                return ENDED
            if self._told[16] or stopped_short(self._reached.value, time, length):
                return EARLY
        return status


def _access(
    preparation: Preparation, workspace: Workspace, group: Group, row: int, address: int = 0
) -> Callable[[], int]:
    """A call of a setter or getter, or of the function at `address` instead."""
    function = address or int(preparation.program.functions[group.function])
    count = group.size - group.surplus
    arguments = workspace.instance, group.references, count, row + group.offset
    if preparation.interface.version == 2:
        return bound(access2, function, *arguments, is_short=True)
    return bound(access3, function, *arguments, group.size, is_short=True)


class _Setter:
    """Sets one variable."""

    def __init__(self, preparation: Preparation, workspace: Workspace, variable: Variable) -> None:
        self._form = RowFormat(preparation.interface, "Set", [variable])
        self._row = self._form.rows(1)
        (group,) = self._form.groups
        self._cell = np.ctypeslib.as_ctypes_type(self._form.dtype[0]).from_buffer(self._row)
        self._call = _access(preparation, workspace, group, self._row.ctypes.data)
        self.function = group.function

    def set(self, value: Value) -> int:
        self._cell.value = self._form.text(value.encode()) if isinstance(value, str) else value
        return self._call()


class _Getter:
    """Gets several variables at once, with one call per type."""

    def __init__(self, preparation: Preparation, workspace: Workspace, variables: Sequence[Variable]) -> None:
        interface = preparation.interface
        self._form = RowFormat(interface, "Get", variables)
        self._row = self._form.rows(1)
        self._truths = [i for i, one in enumerate(variables) if one.type == "Boolean"]
        self._floats: FloatArray | None = None
        if all(one.kind == FLOAT64 for one in self._form.groups):
            numbers = self._row.view(np.float64)[: len(variables)]
            self._floats = numbers if self._form.columns == [*range(len(variables))] else None
        self.texts: TextGetter | None = None
        special: dict[int, int] = {}
        if any(one.type == "String" for one in variables):
            place = interface.place("Get", interface.types["String"])
            self.texts = TextGetter(interface, int(preparation.program.functions[place]), self._form)
            special[place] = self.texts.address
        address = self._row.ctypes.data
        self.calls = [
            (one.function, _access(preparation, workspace, one, address, special.get(one.function, 0)))
            for one in self._form.groups
        ]

    def values(self) -> tuple[Value, ...]:
        """The values as Python objects, in the order of the variables."""
        if self._floats is not None:
            return tuple(self._floats.tolist())
        found: tuple[Value, ...] = self._form.readable(self._row)[0].item()
        if not self._truths:
            return found
        return tuple(bool(one) if i in self._truths else one for i, one in enumerate(found))
