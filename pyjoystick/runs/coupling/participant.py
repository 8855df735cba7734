"""One FMU in the hands of a master."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pyjoystick.fmu import FmuDescription, FmuLibrary, UnsupportedFmuError, Value, checked_parameters

_SETTERS = {
    "Integer": "setInteger",
    "Enumeration": "setInteger",
    "Boolean": "setBoolean",
    "String": "setString",
}


class Participant:
    """An initialized instance of an FMU of FMI 2.0, which is stepped from outside.

    Attributes:
        description: the FMU
        inputs, outputs: names of the connected variables, in the order of `set` and `get`
        time: the communication point (s) that it is at
        steps: how often it was stepped
    """

    def __init__(
        self,
        description: FmuDescription,
        parameters: Mapping[str, Value],
        inputs: Sequence[str],
        outputs: Sequence[str],
        tolerance: float,
    ) -> None:
        """Load, instantiate and initialize the FMU at time 0.

        Raises:
            UnsupportedFmuError: not FMI 2.0, no Co-Simulation, or no binary for this machine
            FmuFileError: it is broken or cannot be instantiated
            FmuRunError: it refuses the parameters
        """
        if not description.fmi_version.startswith("2."):
            reason = f"is an FMU of FMI {description.fmi_version}; coupled runs take FMI 2.0"
            raise UnsupportedFmuError(description.path, reason)
        self.description = description
        self.inputs, self.outputs = tuple(inputs), tuple(outputs)
        self.time = 0.0
        self.steps = 0
        self._inputs = self._references(inputs)
        self._outputs = self._references(outputs)
        self._library = FmuLibrary(description, "CoSimulation")
        try:
            self._instance = self._library.instantiate()
            self._initialize(checked_parameters(description, parameters), tolerance)
        except BaseException:
            self._library.close()
            raise

    def _references(self, names: Sequence[str]) -> list[int]:
        return [self.description.variables[name].value_reference for name in names]

    def _initialize(self, parameters: Mapping[str, Value], tolerance: float) -> None:
        fmi = self._instance.fmi
        with self._instance.reporting(self.time):
            fmi.setupExperiment(tolerance=tolerance, startTime=self.time)
            for name, value in parameters.items():
                variable = self.description.variables[name]
                getattr(fmi, _SETTERS.get(variable.type, "setReal"))([variable.value_reference], [value])
            fmi.enterInitializationMode()
            fmi.exitInitializationMode()

    def set(self, values: Sequence[float]) -> None:
        """Give the inputs their values at the present communication point."""
        if self._inputs:
            with self._instance.reporting(self.time):
                self._instance.fmi.setReal(self._inputs, list(values))

    def set_rates(self, rates: Sequence[float]) -> None:
        """Let the inputs change within the next step at these rates (unit of the input per s)."""
        if self._inputs:
            with self._instance.reporting(self.time):
                self._instance.fmi.setRealInputDerivatives(self._inputs, [1] * len(self._inputs), list(rates))

    def get(self, names: Sequence[str] | None = None) -> list[float]:
        """Values of the connected outputs, or of any variables by name."""
        references = self._outputs if names is None else self._references(names)
        with self._instance.reporting(self.time):
            return [float(value) for value in self._instance.fmi.getReal(references)] if references else []

    def step(self, end: float) -> None:
        """Go on to the communication point `end` (s); raises FmuRunError where the FMU cannot."""
        with self._instance.reporting(self.time):
            self._instance.fmi.doStep(self.time, end - self.time)
        self.time = end
        self.steps += 1

    def save(self) -> tuple[Any, float]:
        """The state of the FMU, for `restore`; to be given to `forget`."""
        with self._instance.reporting(self.time):
            return self._instance.fmi.getFMUState(), self.time

    def restore(self, saved: tuple[Any, float]) -> None:
        """Be again as when `saved` was made."""
        with self._instance.reporting(self.time):
            self._instance.fmi.setFMUState(saved[0])
        self.time = saved[1]

    def forget(self, saved: tuple[Any, float]) -> None:
        """Free what `save` made."""
        self._instance.fmi.freeFMUState(saved[0])

    def close(self) -> None:
        """Free the instance and unload the FMU."""
        self._instance.free()
        self._library.close()
