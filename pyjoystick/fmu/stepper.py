"""An FMU stepped under the caller's control: for control loops, real time and hardware in the loop."""

from __future__ import annotations

import math
import threading
import weakref
from collections import deque
from collections.abc import Iterable, Mapping
from typing import Any, Final, Self

from pyjoystick.fmu.description import Variable
from pyjoystick.fmu.errors import FmuRunError, StepperEndedError, UnsupportedFmuError
from pyjoystick.fmu.inputs import EQUAL_STEPS, ONE_STEP_LENGTH, checked_constants
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.live import LiveInstance
from pyjoystick.fmu.own_process.live import RemoteLiveInstance
from pyjoystick.fmu.own_process.pool import ProcessPool
from pyjoystick.fmu.values import (
    REALS,
    Value,
    checked_outputs,
    checked_parameters,
    checked_value,
    default_outputs,
    limits,
    require_one_name,
    require_scalar,
)
from pyjoystick.support import ParameterError, UnknownInputError, finite, positive

#: Placeholder for no value: compares unequal to everything, so that the variable is set.
_UNSET: Final = object()
#: Tolerance beyond the stop time for steps (relative to it, or to a second), for rounding.
_SLACK: Final = 1e-12


class SavedState:
    """A saved state, returned by `Stepper.save` and freed when no longer referenced.

    Attributes:
        time: time of the state (s)
    """

    def __init__(self, owner: Stepper, time: float, given: Mapping[str, Value], address: int) -> None:
        self.time = time
        self._owner = weakref.ref(owner)
        self._given = dict(given)
        self._address = address

    def __repr__(self) -> str:
        return f"<SavedState at t = {self.time:.9g} s>"


class Stepper:
    """An FMU at a communication point, made by `Fmu.start`; a context manager that ends the simulation.

    >>> with Fmu("Joystick") as fmu, fmu.start(parameters={"theta_start": 0.1}) as joystick:  # doctest: +SKIP
    ...     while joystick.time < 1.0:
    ...         motion = joystick.step(1e-3, T=-0.5 * joystick.outputs["omega"])

    Values are in the units of the FMU, as in `Fmu.run`. Inputs are constant until they are set again. A
    call that fails raises its error and ends the simulation, and so does Ctrl-C within a call, which may have
    stopped in the middle of a step; later calls raise `StepperEndedError`. Threads may share a stepper: their
    calls take turns.

    Attributes:
        description: contents of the FMU's modelDescription.xml
        units: units of the outputs by name
        left_out: names of outputs without a number or text, omitted by default
    """

    def __init__(
        self,
        fmu: Any,
        pool: InstancePool | ProcessPool,
        time: float,
        stop_time: float | None,
        parameters: Mapping[str, Value],
        inputs: Mapping[str, Value],
        outputs: Iterable[str] | None,
        tolerance: float,
    ) -> None:
        description = self.description = pool.description
        if pool.has_one:
            reason = "can be instantiated only once in a process; to be stepped it needs one of its own"
            raise UnsupportedFmuError(description.path, f"{reason} (own_process=True)")
        self._fmu = fmu  # keeps it alive; it closes its pool when collected
        self._time = finite("time", time, "s")
        self._last = math.inf if stop_time is None else finite("stop_time", stop_time, "s")
        if self._last <= self._time:
            raise ParameterError("stop_time", stop_time, f"later than the start at {self._time:g} s")
        self.left_out: tuple[str, ...] = ()
        if outputs is None:
            recorded, self.left_out = default_outputs(description, texts=True)
        else:
            recorded = checked_outputs(description, outputs, texts=True)
        self._length: float | None = None  # of the first step
        self._names = tuple(one.name for one in recorded)
        self.units = {one.name: one.unit for one in recorded}
        values = checked_parameters(description, parameters)
        self._given = checked_constants(description, inputs)
        self._settable: dict[str, tuple[Variable, float, float]] = {}
        self._lock = threading.RLock()
        self._end = ""
        self._values: tuple[Value, ...] | None = None
        self._forgotten: deque[int] = deque()
        kind: Any = RemoteLiveInstance if isinstance(pool, ProcessPool) else LiveInstance
        settings = stop_time, values, self._given, positive("tolerance", tolerance)
        self._instance = kind(pool, self._time, *settings)
        self._stop = weakref.finalize(self, self._instance.stop)

    @property
    def time(self) -> float:
        """The communication point (s)."""
        return self._time

    @property
    def outputs(self) -> dict[str, Value]:
        """The outputs by name at the communication point, with the current inputs.

        Raises:
            FmuRunError: as in `step`
        """
        with self._lock:
            self._require_running()
            if self._values is None:
                self._values = self._call("get", self._names)
            return dict(zip(self._names, self._values, strict=True))

    def step(
        self, length: float, changes: Mapping[str, Value] | None = None, /, **more: Value
    ) -> dict[str, Value]:
        """Set inputs and step to the next communication point.

        Args:
            length: step size (s); the next point is `time` + `length`
            changes: inputs and tunable parameters to change here, by name
            more: the same as keywords

        Returns:
            the outputs at the next point by name, with the inputs of this step

        Raises:
            UnknownInputError: a name is neither an input nor a tunable parameter
            ParameterError: a value or the length is not allowed; the simulation can go on
            FmuEndedError: the FMU terminated the simulation
            FmuTimeLimitError, FmuCrashError: the FMU's process took longer than its `time_limit`, or ended
            StepperEndedError: the simulation had ended before
            FmuRunError: the FMU failed
        """
        with self._lock:
            end = self._next(length)
            new = self._checked(changes, more)
            self._values = self._call("step", end, new, self._names)
            self._time = end
            self._given.update(new)
            return dict(zip(self._names, self._values, strict=True))

    def set(self, changes: Mapping[str, Value] | None = None, /, **more: Value) -> None:
        """Set inputs and tunable parameters from here on; arguments and errors as in `step`."""
        with self._lock:
            new = self._checked(changes, more)
            self._values = None
            self._call("set", new)
            self._given.update(new)

    def get(self, name: str) -> Value:
        """Get the value of any variable at the communication point, arrays by element (``x[1]``).

        Raises:
            UnknownVariableError: the FMU has no such variable
            ParameterError: it has no single value
            FmuRunError: as in `step`
        """
        checked_outputs(self.description, name, texts=True)
        with self._lock:
            value: Value = self._call("get", (name,))[0]
            return value

    def save(self) -> SavedState:
        """Save the current state, for `restore`.

        Raises:
            UnsupportedFmuError: the FMU cannot save its state
            FmuRunError: as in `step`
        """
        if not self.description.saves_states:
            raise UnsupportedFmuError(self.description.path, "cannot save its state (canGetAndSetFMUstate)")
        with self._lock:
            self._forget()
            state = SavedState(self, self._time, self._given, self._call("save"))
            # Any thread may collect it, but only calls of this object may access the FMU.
            weakref.finalize(state, self._forgotten.append, state._address).atexit = False
            return state

    def restore(self, state: SavedState) -> None:
        """Restore a saved state, any number of times.

        Raises:
            ParameterError: another stepper saved it
            FmuRunError: as in `step`
        """
        if state._owner() is not self:
            raise ParameterError("state", state, "saved by this stepper")
        with self._lock:
            self._forget()
            self._values = None
            self._call("restore", state._address)
            self._time, self._given = state.time, dict(state._given)

    def close(self) -> None:
        """End the simulation and return the instance; may be called more than once.

        Raises:
            FmuRunError: the FMU fails during termination
        """
        with self._lock:
            if self._stop.detach() is not None:
                self._end = "it has been closed"
                self._instance.stop(self._time)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        state = f"ended: {self._end}" if self._end else "running"
        return f"<Stepper of {self.description.path.name} at t = {self._time:.9g} s, {state}>"

    def _require_running(self) -> None:
        if self._end:
            raise StepperEndedError(self._time, self._end, self.description.path)

    def _call(self, name: str, *arguments: Any) -> Any:
        self._require_running()
        try:
            return getattr(self._instance, name)(self._time, *arguments)
        except BaseException as error:
            self._end = str(error) if isinstance(error, FmuRunError) else f"{type(error).__name__} in a call"
            if self._stop.detach() is not None:
                self._instance.abandon()
            raise

    def _next(self, length: float) -> float:
        begin = self._time
        end = begin + (length if type(length) is float else positive("length", length, "s"))
        latest = self._last + _SLACK * max(1.0, abs(self._last)) if self._last < math.inf else math.inf
        if not begin < end < math.inf:
            allowed = f"a number of seconds above 0 that moves t = {begin:.9g} s on"
            raise ParameterError("length", length, allowed)
        if end > latest:
            hint = f"the simulation was started with stop_time = {self._last:g} s"
            raise ParameterError("length", length, f"at most {self._last - begin:.9g} s here", hint)
        if not self.description.variable_steps:
            self._require_equal(end - begin)
        return end

    def _require_equal(self, length: float) -> None:
        first = self._length = self._length or length
        if abs(length - first) > EQUAL_STEPS * first:
            hint = ONE_STEP_LENGTH.format(self.description.path.name)
            raise ParameterError("length", f"{length:.9g}", f"{first:.9g} s, as the first", hint)

    def _checked(
        self, changes: Mapping[str, Value] | None, more: Mapping[str, Value]
    ) -> list[tuple[str, Value]]:
        """Values that differ from the previous ones; an FMU may restart its integration at each set value."""
        new = []
        for name, value in (more if changes is None else {**changes, **more}).items():
            variable, low, high = self._settable.get(name) or self._found(name, value)
            is_plain = type(value) is float and low <= value <= high  # the common case, checked fast
            checked = value if is_plain else checked_value(variable, value)
            if self._given.get(name, _UNSET) != checked:
                new.append((name, checked))
        return new

    def _found(self, name: str, value: Value) -> tuple[Variable, float, float]:
        """A variable that may be set at a communication point, and its range if it is real."""
        description = self.description
        variable = description.variables.get(name)
        if variable is None:
            raise UnknownInputError(name, description.names("input"))
        is_tunable = variable.causality == "parameter" and variable.variability == "tunable"
        if variable.causality != "input" and not is_tunable:
            hint = "only inputs and tunable parameters change in a simulation"
            allowed = "given to Fmu.start" if variable.settable_at_start else "left out"
            raise ParameterError(name, value, allowed, hint)
        require_scalar(variable)
        require_one_name(description, "inputs", (*self._settable, name))
        low, high = limits(variable) if variable.type in REALS else (math.inf, -math.inf)
        self._settable[name] = variable, low, high
        return self._settable[name]

    def _forget(self) -> None:
        """Free saved states that are no longer referenced."""
        while self._forgotten:
            self._call("forget", self._forgotten.popleft())
