"""The FMUs of a coupled run, and the signals between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from typing import Any, Self

import numpy as np

from pyjoystick.fmu import REALS, FmuDescription, Value, checked_parameters, stepped
from pyjoystick.runs.coupling.system import CoupledSystem
from pyjoystick.runs.errors import CouplingError
from pyjoystick.support import FloatArray


class Participant:
    """An initialized instance of an FMU (FMI 2.0 or 3.0) at a communication point.

    Attributes:
        description: the FMU
        inputs, outputs: the connected variables, in the order of `set` and `get`
        time: the communication point (s)
        steps: number of steps so far
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
            UnsupportedFmuError: no Co-Simulation, or no binary for this machine
            FmuFileError: it is broken or cannot be instantiated
            FmuRunError: it rejects the parameters
        """
        self.description = description
        self.inputs = [description.variables[name] for name in inputs]
        self.outputs = [description.variables[name] for name in outputs]
        self.time = 0.0
        self.steps = 0
        with ExitStack() as stack:
            self._instance = stack.enter_context(stepped(description))
            with self._instance.reporting(self.time):
                self._instance.initialize(self.time, tolerance, checked_parameters(description, parameters))
            self._stack = stack.pop_all()

    def set(self, values: Sequence[float]) -> None:
        """Set the inputs at the current communication point."""
        with self._instance.reporting(self.time):
            self._instance.set(self.inputs, values)

    def set_rates(self, rates: Sequence[float]) -> None:
        """Set the rates of the real inputs for the next step (unit of the input per s)."""
        moving = {i: variable for i, variable in enumerate(self.inputs) if variable.type in REALS}
        with self._instance.reporting(self.time):
            self._instance.set_input_derivatives(list(moving.values()), [rates[i] for i in moving])

    def get(self, names: Sequence[str] | None = None) -> list[float]:
        """Get the connected outputs, or any variables by name."""
        variables = self.outputs if names is None else [self.description.variables[name] for name in names]
        with self._instance.reporting(self.time):
            return self._instance.get(variables)

    def step(self, end: float) -> None:
        """Step to the communication point `end` (s); raises FmuRunError if the FMU cannot."""
        with self._instance.reporting(self.time):
            self._instance.step(self.time, end - self.time)
        self.time = end
        self.steps += 1

    def save(self) -> tuple[Any, float]:
        """Save the state of the FMU, for `restore`; to be freed by `forget`."""
        with self._instance.reporting(self.time):
            return self._instance.save(), self.time

    def restore(self, saved: tuple[Any, float]) -> None:
        """Restore a saved state."""
        with self._instance.reporting(self.time):
            self._instance.restore(saved[0])
        self.time = saved[1]

    def forget(self, saved: tuple[Any, float]) -> None:
        """Free a saved state; that of an FMU that failed is freed with its instance."""
        if not self._instance.is_broken:
            with self._instance.reporting(self.time):
                self._instance.forget(saved[0])

    def close(self) -> None:
        """Free the instance and unload the FMU."""
        self._stack.close()


class Network:
    """The FMUs of a system, loaded and initialized; a context manager that unloads them.

    A signal is a connected input; arrays of signals are in the order of the system's connections.

    Attributes:
        system: the system
        participants: by name of the component
    """

    def __init__(self, system: CoupledSystem, tolerance: float) -> None:
        """Load the FMUs; raises as `CoupledSystem.describe` and `Participant`."""
        described = system.describe()
        self.system = system
        self.participants: dict[str, Participant] = {}
        sources = [connection.source.split(".", 1) for connection in system.connections]
        targets = [connection.target.split(".", 1) for connection in system.connections]
        outputs = {
            c.name: list(dict.fromkeys(variable for name, variable in sources if name == c.name))
            for c in system.components
        }
        self._fed_by = [(name, outputs[name].index(variable)) for name, variable in sources]
        self._signals = {
            c.name: [i for i, (name, _) in enumerate(targets) if name == c.name] for c in system.components
        }
        with ExitStack() as stack:
            for component in system.components:
                inputs = [variable for name, variable in targets if name == component.name]
                participant = Participant(
                    described[component.name],
                    component.parameters,
                    inputs,
                    outputs[component.name],
                    tolerance,
                )
                stack.callback(participant.close)
                self.participants[component.name] = participant
            self._stack = stack.pop_all()

    def copy(self) -> FloatArray:
        """Copy the outputs at the current communication point to the inputs.

        Returns:
            the signals, shape (n,)
        """
        signals = self._outputs()
        self.set(signals)
        return signals

    def exchange(self) -> FloatArray:
        """Copy outputs to inputs until nothing changes.

        An output may depend directly on inputs, as a torque does on an angle; one pass per component is
        enough unless such dependencies form a loop.

        Returns:
            the signals, shape (n,)

        Raises:
            CouplingError: the outputs form an algebraic loop
        """
        signals = self._outputs()
        for _ in self.participants:
            self.set(signals)
            before, signals = signals, self._outputs()
            if np.array_equal(before, signals):
                return signals
        changing = zip(self.system.connections, before != signals, strict=True)
        loop = ", ".join(str(connection) for connection, changes in changing if changes)
        reason = "an algebraic loop, which this master does not solve"
        raise CouplingError(self.system.name, loop, reason)

    def _outputs(self) -> FloatArray:
        values = {name: participant.get() for name, participant in self.participants.items()}
        return np.array([values[name][i] for name, i in self._fed_by])

    def set(self, signals: FloatArray) -> None:
        """Set every input."""
        for name, participant in self.participants.items():
            participant.set(signals[self._signals[name]].tolist())

    def set_rates(self, rates: FloatArray) -> None:
        """Set the rate of every input for the next step (unit of the input per s)."""
        for name, participant in self.participants.items():
            participant.set_rates(rates[self._signals[name]].tolist())

    def step(self, end: float) -> None:
        """Step every FMU independently to the communication point `end` (s)."""
        for participant in self.participants.values():
            participant.step(end)

    def save(self) -> dict[str, Any]:
        """Save the states of all FMUs, for `restore` and `forget`."""
        return {name: participant.save() for name, participant in self.participants.items()}

    def restore(self, saved: dict[str, Any]) -> None:
        """Restore the saved state of every FMU."""
        for name, participant in self.participants.items():
            participant.restore(saved[name])

    def forget(self, saved: dict[str, Any]) -> None:
        """Free the saved states."""
        for name, participant in self.participants.items():
            participant.forget(saved[name])

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()
