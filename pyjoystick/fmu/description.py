"""Description of an FMU, from its modelDescription.xml."""

from __future__ import annotations

import copyreg
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final, Literal

import numpy as np

from pyjoystick.motion import DisplayUnit, Quantity

#: A minimum up to this means "above zero"; Modelica.Constants.small is 1e-60.
_SMALL: Final = 1e-50

Interface = Literal["CoSimulation", "ModelExchange"]


def _read_only(table: dict[str, Any]) -> MappingProxyType[str, Any]:
    return MappingProxyType(table)


# A description is sent to other processes, including read-only tables.
copyreg.pickle(MappingProxyType, lambda table: (_read_only, (dict(table),)))


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of an FMU; absent attributes are None or an empty string.

    `start` is as written in the file; `minimum`, `maximum` and `nominal` are in `unit`, with large integers
    exact; `initial` is ``exact``, ``approx`` or ``calculated``. `shape` is that of the array (FMI 3), also
    for its elements; `element` is the element's index, from 0. `is_fmi3` determines the width of an
    enumeration; `items` are its values, if they are declared. `is_set_in_steps` says whether it may be set in
    Intermediate Update Mode.
    """

    name: str
    type: str
    causality: str
    variability: str
    initial: str
    value_reference: int
    description: str
    unit: str
    display_unit: DisplayUnit | None
    start: str | None
    minimum: float | None
    maximum: float | None
    is_array: bool = False
    nominal: float = 1.0
    shape: tuple[int, ...] = ()
    element: int | None = None
    is_fmi3: bool = False
    items: tuple[int, ...] = ()
    is_set_in_steps: bool = False

    @property
    def settable_at_start(self) -> bool:
        """Whether it is a parameter or has a settable start value (inputs are set as inputs)."""
        if (
            self.causality in ("input", "independent", "structuralParameter")
            or self.variability == "constant"
        ):
            return False
        return self.initial in ("exact", "approx")

    def elements(self) -> tuple[Variable, ...]:
        """Elements of an array, ``x[1,1]``, ``x[1,2]`` and so on, last index fastest; else the variable."""
        if not self.is_array:
            return (self,)
        return tuple(
            replace(
                self, name=f"{self.name}[{','.join(str(i + 1) for i in place)}]", is_array=False, element=k
            )
            for k, place in enumerate(np.ndindex(self.shape))
        )

    @property
    def whole(self) -> str:
        """Name of the array that the variable is an element of, else its own name."""
        return self.name if self.element is None else self.name.rpartition("[")[0]

    @property
    def must_be_positive(self) -> bool:
        """Whether the minimum stands for "above zero", which Modelica and FMI cannot express otherwise."""
        return self.minimum is not None and 0.0 < self.minimum <= _SMALL

    @property
    def reference(self) -> tuple[str, int]:
        """Type and value reference: equal for all names of one variable."""
        # In FMI 2, enumerations are integers; in FMI 3, a value reference belongs to one type.
        is_integer = self.type == "Enumeration" and not self.is_fmi3
        return "Integer" if is_integer else self.type, self.value_reference

    @property
    def quantity(self) -> Quantity:
        """Name, unit and description for tables."""
        return Quantity(self.name, self.unit, self.display_unit, self.description)


@dataclass(frozen=True, slots=True)
class DefaultExperiment:
    """Settings that the FMU proposes; times in s, None if not given."""

    start_time: float | None
    stop_time: float | None
    tolerance: float | None
    step_size: float | None


@dataclass(frozen=True, slots=True)
class FmuDescription:
    """An FMU as described by its modelDescription.xml.

    Attributes:
        path: the .fmu file
        model_name: qualified name of the model
        description: one-line description of the model
        fmi_version: such as ``2.0``
        guid: identifier that ties binary and description together
        generation_tool, generation_date: as written, else empty
        interfaces: model identifier by interface (``CoSimulation``, ``ModelExchange``)
        binaries: files under ``binaries/``, such as ``linux64/Joystick.so``
        has_sources: the C sources are included
        variables: by name, in the order of the file
        experiment: proposed settings
        interpolates_inputs: Co-Simulation uses input derivatives within a step (FMI 2)
        asks_for_inputs: Co-Simulation requests inputs within a step (FMI 3, intermediate update)
        variable_steps: Co-Simulation supports communication steps of different lengths
        saves_states: Co-Simulation can save and restore its state
        one_instance: Co-Simulation can be instantiated only once per process
        directional_derivatives, adjoint_derivatives: Co-Simulation provides them
        log_categories: names of the FMU's log categories
    """

    path: Path
    model_name: str
    description: str
    fmi_version: str
    guid: str
    generation_tool: str
    generation_date: str
    interfaces: Mapping[str, str]
    binaries: tuple[str, ...]
    has_sources: bool
    variables: Mapping[str, Variable]
    experiment: DefaultExperiment
    interpolates_inputs: bool
    variable_steps: bool
    saves_states: bool
    one_instance: bool = False
    asks_for_inputs: bool = False
    directional_derivatives: bool = False
    adjoint_derivatives: bool = False
    log_categories: tuple[str, ...] = ()

    @property
    def identity(self) -> dict[str, str]:
        """Identification of the FMU for documents and logs; missing items are empty."""
        return {
            "path": str(self.path),
            "model": self.model_name,
            "made_by": self.generation_tool,
            "made_at": self.generation_date,
            "guid": self.guid,
        }

    @property
    def platforms(self) -> tuple[str, ...]:
        """Names of the platforms with binaries, such as ``linux64``."""
        return tuple(sorted({file.split("/")[0] for file in self.binaries if "/" in file}))

    @property
    def takes_stop_time(self) -> bool:
        """Whether a stop time may be set; FMUs by OpenModelica up to 1.14 step to it at once."""
        return not self.generation_tool.startswith("OpenModelica")

    def find(self, name: str) -> Variable | None:
        """Return a variable or an element of an array; None if there is none of that name."""
        whole = self.variables.get(name) or self.variables.get(name.rpartition("[")[0])
        return next((one for one in (whole, *whole.elements()) if one.name == name), None) if whole else None

    @property
    def is_ours(self) -> bool:
        """Whether this project made the FMU; such instances are reset and run in the caller's process."""
        return self.generation_tool.split(" ")[0] == "pyjoystick"

    def names(self, causality: str) -> tuple[str, ...]:
        """Names of the variables of one causality, in the order of the file."""
        return tuple(name for name, variable in self.variables.items() if variable.causality == causality)

    def settable_names(self) -> tuple[str, ...]:
        """Names that a run accepts as parameters or start values."""
        return tuple(name for name, variable in self.variables.items() if variable.settable_at_start)
