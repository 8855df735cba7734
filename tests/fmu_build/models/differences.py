"""Central differences of an FMU in Model Exchange, to compare with its own derivatives."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from fmpy.fmi2 import FMU2Model
from numpy.typing import NDArray

from .case import Array
from .runner import Fmu

_DOUBLES = ctypes.POINTER(ctypes.c_double)

STEP = 1e-5
"""Step of the differences as part of a value; their error is about its square, and rounding divided by it."""


class Probe:
    """One instance in Model Exchange whose knowns can be moved."""

    def __init__(self, fmu: Fmu) -> None:
        self.description = fmu.description
        self.states = [unknown.variable.derivative for unknown in fmu.description.derivatives]
        self.model = FMU2Model(
            guid=fmu.description.guid,
            modelIdentifier=fmu.description.modelExchange.modelIdentifier,
            unzipDirectory=str(fmu.folder),
        )
        self.model.instantiate()
        self.model.setupExperiment(startTime=0.0)
        self.model.enterInitializationMode()
        self.time = 0.0

    def set(self, values: Mapping[str, float]) -> None:
        """Parameters and inputs by name."""
        for variable in self.description.modelVariables:
            if variable.name in values:
                kind = "Integer" if variable.type == "Enumeration" else variable.type
                setter = getattr(self.model, f"set{kind}")
                setter([variable.valueReference], [values[variable.name]])

    def read(self, variables: Sequence[Any]) -> Array:
        """Values of Real variables."""
        return np.array(self.model.getReal([variable.valueReference for variable in variables]))

    def jacobian(self, unknowns: Sequence[Any], knowns: Sequence[Any]) -> Array:
        """The FMU's own derivatives, a column for each known."""
        references = [variable.valueReference for variable in unknowns]
        columns = [
            self.model.getDirectionalDerivative(references, [known.valueReference], [1.0]) for known in knowns
        ]
        return np.array(columns).reshape(len(knowns), len(unknowns)).T

    def advance(self, stop_time: float, steps: int) -> None:
        """From Event Mode at the start roughly along the solution, in the branches that hold there."""
        next_event = self.settle()
        for target in np.linspace(0.0, stop_time, steps + 1)[1:]:
            end = min(float(target), next_event)
            x, step = self.get_states(), end - self.time
            self.model.setTime(self.time + 0.5 * step)
            self.set_states(x + 0.5 * step * self._derivatives())
            self.model.setTime(end)
            self.set_states(x + step * self._derivatives())
            self.time = end
            self.model.completedIntegratorStep()
            self.model.enterEventMode()
            next_event = self.settle()

    def settle(self) -> float:
        """From Event Mode to Continuous-Time Mode; gives the time of the next time event."""
        while (info := self.model.newDiscreteStates())[0]:
            pass
        self.model.enterContinuousTimeMode()
        return float(info[5]) if info[4] else np.inf

    def get_states(self) -> Array:
        x = np.zeros(len(self.states))
        self.model.getContinuousStates(x.ctypes.data_as(_DOUBLES), len(x))
        return x

    def set_states(self, x: Array) -> None:
        self.model.setContinuousStates(x.ctypes.data_as(_DOUBLES), len(x))

    def _derivatives(self) -> Array:
        x = np.zeros(len(self.states))
        self.model.getDerivatives(x.ctypes.data_as(_DOUBLES), len(x))
        return x

    def move(self, known: Any, value: float) -> None:
        """Set a state, an input, a tunable parameter or the time, from and to Continuous-Time Mode."""
        if known.causality == "independent":
            self.model.setTime(value)
        elif known in self.states:
            x = self.get_states()
            x[self.states.index(known)] = value
            self.set_states(x)
        else:
            self.model.enterEventMode()
            self.model.setReal([known.valueReference], [value])
            self.settle()  # discrete variables that follow a parameter are set at events

    def differences(self, unknowns: Sequence[Any], knowns: Sequence[Any]) -> Differences:
        """At the present point; no event may be so near that a step would pass it."""
        centres = self.read(knowns)
        columns = []
        for known, centre in zip(knowns, centres, strict=True):
            around = []
            for value in (*_beside(centre), centre):
                self.move(known, value)
                around.append(self.read(unknowns))
            columns.append((around[0], around[1]))
        return Differences.of(columns, self.read(unknowns), centres)


@dataclass(frozen=True)
class Differences:
    """Unknowns in rows, knowns in columns."""

    central: Array
    smooth: NDArray[np.bool_]
    """Whether the differences to both sides agree: where not, there is a kink or a jump between them."""
    resolution: Array
    """The size of the unknown over that of the known."""

    @classmethod
    def of(cls, columns: Sequence[tuple[Array, Array]], values: Array, centres: Array) -> Differences:
        after, before = (
            np.array([c[i] for c in columns]).reshape(len(columns), len(values)).T for i in (0, 1)
        )
        steps = STEP * _sizes(centres)
        ahead, behind = (after - values[:, np.newaxis]) / steps, (values[:, np.newaxis] - before) / steps
        central = (after - before) / (2.0 * steps)
        resolution = _sizes(values)[:, np.newaxis] / _sizes(centres)[np.newaxis, :]
        return cls(
            central, np.abs(ahead - behind) <= 0.01 * np.maximum(np.abs(central), resolution), resolution
        )

    def largest_error(self, found: Array) -> tuple[float, int, int]:
        """How far the worst derivative is off, relative to what differences resolve; its row and column."""
        size = np.maximum(np.abs(self.central), self.resolution)
        off = np.where(self.smooth, np.abs(found - self.central) / size, 0.0)
        row, column = np.unravel_index(np.argmax(off), off.shape)
        return float(off[row, column]), int(row), int(column)


def initial_differences(
    fmu: Fmu, values: Mapping[str, float], unknowns: Sequence[Any], knowns: Sequence[Any]
) -> Differences:
    """The same of the initial values, with a new instance for each step."""

    def solved(moved: Mapping[str, float]) -> Array:
        with probe(fmu) as other:
            other.set({**values, **moved})
            return other.read(unknowns)

    centres = np.array([float(values.get(known.name, known.start)) for known in knowns])
    columns = []
    for known, centre in zip(knowns, centres, strict=True):
        after, before = (solved({known.name: value}) for value in _beside(centre))
        columns.append((after, before))
    return Differences.of(columns, solved({}), centres)


@contextmanager
def probe(fmu: Fmu) -> Iterator[Probe]:
    """An instance in Initialization Mode."""
    found = Probe(fmu)
    try:
        yield found
    finally:
        found.model.freeInstance()


def may_be_moved(known: Any, centre: float) -> bool:
    """Whether a step to either side is within the range of a variable."""
    low, high = (
        float(bound) if bound is not None else sign * np.inf
        for bound, sign in ((known.min, -1), (known.max, 1))
    )
    above, below = _beside(centre)
    return low <= below and above <= high


def _beside(centre: float) -> tuple[float, float]:
    step = STEP * float(_sizes(np.array(centre)))
    return centre + step, centre - step


def _sizes(values: Array) -> Array:
    return np.maximum(np.abs(values), 1e-3)
