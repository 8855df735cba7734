"""A system of FMUs: components and connections."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from pyjoystick.fmu import FmuDescription, Value, Variable, checked_parameters, find_fmu, read_description
from pyjoystick.runs.errors import CouplingError
from pyjoystick.support import UnknownNameError

#: FMI 2 types with another name in FMI 3.
_FMI3_NAMES: Final = {"Real": "Float64", "Integer": "Int32"}


@dataclass(frozen=True, slots=True)
class Component:
    """An FMU in a system.

    Attributes:
        name: unique in the system, without a dot
        fmu: a name such as ``Joystick``, or the path of an FMU (FMI 2.0 or 3.0) with Co-Simulation
        parameters: values of parameters and start values by name, in the units of the FMU
    """

    name: str
    fmu: str | Path
    parameters: Mapping[str, Value] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Connection:
    """An output that feeds an input, each as ``component.variable``."""

    source: str
    target: str

    def __str__(self) -> str:
        return f"{self.source} -> {self.target}"


@dataclass(frozen=True, slots=True)
class CoupledSystem:
    """FMUs and the connections between them.

    Attributes:
        name: name of the system
        components: in the order in which a master calls them
        connections: an output may feed several inputs; an input has one source or none
        stop_time: end of the proposed experiment (s), which starts at 0
        description: one-line description
    """

    name: str
    components: tuple[Component, ...]
    connections: tuple[Connection, ...]
    stop_time: float
    description: str = ""

    def describe(self) -> dict[str, FmuDescription]:
        """Check the whole system and return the descriptions of the FMUs by name of the component.

        Raises:
            CouplingError: two components share a name; a connection does not lead from an output to an input
                of a component with the same type and unit; an input has two sources
            FmuNotFoundError, FmuFileError: an FMU is missing or broken
            UnknownParameterError, ParameterError: a parameter is unknown or its value is not allowed
        """
        for name, count in Counter(component.name for component in self.components).items():
            if count > 1 or "." in name or not name:
                raise CouplingError(self.name, name, "component names must be unique and contain no dot")
        described = {c.name: read_description(find_fmu(c.fmu)) for c in self.components}
        for component in self.components:
            checked_parameters(described[component.name], component.parameters)
        for connection in self.connections:
            self._check(connection, described)
        for target, count in Counter(connection.target for connection in self.connections).items():
            if count > 1:
                raise CouplingError(self.name, target, f"is fed by {count} outputs; one is allowed")
        return described

    def _check(self, connection: Connection, described: Mapping[str, FmuDescription]) -> None:
        source = self._end(connection, connection.source, "output", described)
        target = self._end(connection, connection.target, "input", described)
        for what, given, wanted in (
            ("type", _FMI3_NAMES.get(source.type, source.type), _FMI3_NAMES.get(target.type, target.type)),
            ("unit", source.unit, target.unit),
        ):
            if given != wanted:
                reason = f"the output's {what} is {given or 'none'}, the input's {wanted or 'none'}"
                raise CouplingError(self.name, str(connection), f"{reason}; they must be the same")

    def _end(
        self, connection: Connection, path: str, causality: str, described: Mapping[str, FmuDescription]
    ) -> Variable:
        component, _, name = path.partition(".")
        if component not in described:
            known = ", ".join(described)
            raise CouplingError(
                self.name, str(connection), f"there is no component {component!r}; known are {known}"
            )
        names = described[component].names(causality)
        if name not in names:
            unknown = UnknownNameError(name, names, f"{causality} of {component}")
            raise CouplingError(self.name, str(connection), str(unknown))
        return described[component].variables[name]
