"""One instance of an FMU: its memory for the compiled loop, and direct calls of its functions.

The methods are the same for FMI 2 and FMI 3 and use Python values. They serve linearization and steps that
a co-simulation master may repeat; whole runs go through `stepping`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from ctypes import c_void_p
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2LastSuccessfulTime, fmi2Terminated

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.drive import IntermediateUpdate
from pyjoystick.fmu.errors import THE_END, FmuEndedError, FmuRunError
from pyjoystick.fmu.interface import c_interface
from pyjoystick.fmu.log import FmuLog
from pyjoystick.fmu.stepping.kernel import stopped_short
from pyjoystick.fmu.stepping.program import BETWEEN_RUNS, DISCARD, FATAL, FLAGS_SIZE, POINT, Workspace
from pyjoystick.fmu.values import INTEGERS, Value, whole_number_for


@dataclass(slots=True, eq=False)
class Instance:
    """One instance of an FMU.

    Attributes:
        description: the FMU
        fmi: FMPy's object, with one method per FMI function
        log: messages of the instance
        is_new: no run has started yet
        is_broken: a run failed or ended early; further runs need another instance
        is_lost: it must not even be freed; the standard forbids all calls after a fatal error
        intermediate_update: answers its requests for inputs within a step; None if it makes none
    """

    description: FmuDescription
    fmi: Any
    log: FmuLog
    is_new: bool = True
    is_broken: bool = False
    is_lost: bool = False
    intermediate_update: IntermediateUpdate | None = None
    _workspace: Workspace | None = field(default=None, init=False)

    def workspace(self, raw_size: int) -> Workspace:
        """Memory for the compiled loop, with `raw_size` bytes for samples."""
        if self._workspace is None or self._workspace.raw.size != raw_size:
            raw, flags = np.zeros(raw_size, np.uint8), np.zeros(FLAGS_SIZE, np.uint8)
            address = int(self.fmi.component)
            place = self.log.place
            place[POINT] = BETWEEN_RUNS
            self._workspace = Workspace(address, place, raw, raw.ctypes.data, flags, flags.ctypes.data)
        return self._workspace

    @contextmanager
    def reporting(self, time: float) -> Iterator[None]:
        """Convert a failing call of FMPy to an `FmuRunError` at `time` (s) with the messages of the FMU."""
        self.log.attach()
        self.log.clear()
        try:
            yield
        except FMICallException as error:
            self.is_broken, self.is_lost = True, self.is_lost or error.status == FATAL
            path, messages = self.description.path, tuple(self.log.messages())
            ended = self.end_of_run(time) if error.status == DISCARD else None
            if ended is not None:
                raise FmuEndedError(ended, THE_END, path, messages) from error
            raise FmuRunError(time, str(error).rstrip("."), path, messages) from error
        except FmuRunError:
            self.is_broken = True
            raise

    def end_of_run(self, time: float) -> float | None:
        """Time at which the FMU (FMI 2) terminated the run (s), after a discarded step; None if it did not.

        Args:
            time: start of the step (s), used if the FMU does not report the time
        """
        with suppress(FMICallException, AttributeError, KeyError):
            if not self._is_fmi2 or not self.fmi.getBooleanStatus(fmi2Terminated):
                return None
            with suppress(FMICallException):
                return max(time, float(self.fmi.getRealStatus(fmi2LastSuccessfulTime)))
            return time
        return None

    def initialize(self, time: float, tolerance: float, values: Mapping[str, Value]) -> None:
        """Initialize at the first communication point, `time` (s), from any state, with values by name."""
        self.begin_initialization(time, tolerance, values)
        self.fmi.exitInitializationMode()

    def begin_initialization(self, time: float, tolerance: float, values: Mapping[str, Value]) -> None:
        """Enter the initialization mode; arguments as for `initialize`."""
        if not self.is_new:
            self.fmi.reset()
        self.is_new = False
        settings = {"tolerance": tolerance, "startTime": time}
        if self._is_fmi2:
            self.fmi.setupExperiment(**settings)
        for name, value in values.items():
            self.set([self.description.variables[name]], [value])
        self.fmi.enterInitializationMode(**({} if self._is_fmi2 else settings))

    def set(self, variables: Sequence[Variable], values: Sequence[Value]) -> None:
        """Set variables, with one call per type.

        Raises:
            ParameterError: a float represents no integer of the variable's type, or several
        """
        for name, places in self._by_type(variables).items():
            given = [self._given(variables[i], values[i]) for i in places]
            getattr(self.fmi, f"set{name}")([variables[i].value_reference for i in places], given)

    @staticmethod
    def _given(variable: Variable, value: Value) -> Value:
        if variable.type in INTEGERS:
            return whole_number_for(variable, float(value) if isinstance(value, str) else value)
        return int(value) if variable.type == "Boolean" else value

    def get(self, variables: Sequence[Variable]) -> list[float]:
        """Get the values of numbers and Booleans."""
        found = [0.0] * len(variables)
        for name, places in self._by_type(variables).items():
            values = getattr(self.fmi, f"get{name}")([variables[i].value_reference for i in places])
            for i, value in zip(places, values, strict=True):
                found[i] = float(value)
        return found

    def set_input_derivatives(self, variables: Sequence[Variable], rates: Sequence[float]) -> None:
        """Set the rates of real inputs (unit per s) for the next step; FMI 2 only."""
        if variables:
            references = [variable.value_reference for variable in variables]
            self.fmi.setRealInputDerivatives(references, [1] * len(references), list(rates))

    def step(self, time: float, length: float) -> None:
        """Step from the communication point `time` (s) to the next, `length` (s) later.

        Raises:
            FmuEndedError: the FMU terminated the run
            FmuRunError: it returned early
        """
        flags = self.fmi.doStep(time, length)
        if flags is None:  # FMI 2
            return
        _, has_ended, is_early, reached = flags
        path, messages = self.description.path, tuple(self.log.messages())
        if has_ended:
            raise FmuEndedError(reached, THE_END, path, messages)
        if is_early or stopped_short(reached, time, length):
            reason = f"fmi3DoStep came back at t = {reached:.9g} s, before the end of the step"
            raise FmuRunError(time, reason, path, messages)

    def save(self) -> int:
        """Save the state; returns its address for `restore`, to be freed by `forget`."""
        return int(self.fmi.getFMUState().value)

    def restore(self, state: int) -> None:
        """Restore a saved state."""
        self.fmi.setFMUState(c_void_p(state))

    def forget(self, state: int) -> None:
        """Free a saved state."""
        self.fmi.freeFMUState(c_void_p(state))

    @property
    def _is_fmi2(self) -> bool:
        return self.description.fmi_version.startswith("2.")

    def _by_type(self, variables: Sequence[Variable]) -> dict[str, list[int]]:
        """Indices of the variables by type, named as in setters and getters."""
        types = c_interface(self.description.fmi_version).types
        places: dict[str, list[int]] = {}
        for i, variable in enumerate(variables):
            places.setdefault(types[variable.type].name, []).append(i)
        return places

    def free(self) -> None:
        """Free the instance, unless it is lost."""
        if not self.is_lost:
            free = getattr(self.fmi, f"fmi{self.description.fmi_version[0]}FreeInstance")
            free(self.fmi.component)
        self.log.close()
