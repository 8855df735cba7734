"""The description of a compiled model, independent of the compiler and of the FMI version."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

ValueType = Literal["Real", "Integer", "Boolean", "Enumeration"]
Causality = Literal["parameter", "calculatedParameter", "input", "output", "local", "independent"]
Variability = Literal["constant", "fixed", "tunable", "discrete", "continuous"]
Initial = Literal["exact", "approx", "calculated"]
DependencyKind = Literal["dependent", "constant", "fixed", "tunable", "discrete"]


@dataclass(frozen=True, slots=True)
class EnumerationType:
    """A Modelica enumeration: its qualified name and its literals with their descriptions."""

    name: str
    literals: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Variable:
    """One scalar variable; its value reference is its position in `ModelDescription.variables`."""

    name: str
    type: ValueType
    causality: Causality
    variability: Variability
    initial: Initial | None
    start: float | int | bool | None
    description: str = ""
    unit: str = ""
    display_unit: str = ""
    quantity: str = ""
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    derivative_of: int | None = None
    """Value reference of the state whose time derivative this variable is."""
    reinit: bool = False
    enumeration: EnumerationType | None = None


@dataclass(frozen=True, slots=True)
class Terminal:
    """Variables that are connected together, such as angle and torque of a shaft.

    `members` are (variable, name in the terminal, kind): connected values are equal for ``signal``, and sum
    to zero for ``inflow`` and ``outflow`` (FMI 3.0.2, section 2.4.9.2).
    """

    name: str
    members: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True, slots=True)
class Unknown:
    """An entry of FMI's ModelStructure: value references of the unknown and of its dependencies."""

    value_reference: int
    dependencies: tuple[int, ...]
    dependency_kinds: tuple[DependencyKind, ...]


@dataclass(frozen=True, slots=True)
class InputStep:
    """Values that inputs take at a time (s) and keep until the next step."""

    time: float
    values: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class DefaultExperiment:
    """The `experiment` annotation of the Modelica class, or these defaults; times in seconds."""

    start_time: float = 0.0
    stop_time: float = 1.0
    tolerance: float = 1e-8
    step_size: float = 1e-3
    input_steps: tuple[InputStep, ...] = ()
    """Inputs over time; before the first step, or without steps, inputs have their start values."""


@dataclass(frozen=True, slots=True)
class ModelDescription:
    """The content of modelDescription.xml, for either FMI version."""

    model_name: str
    """The qualified Modelica class, such as ``PreloadedSprings.Joystick.Joystick``."""
    description: str
    variables: tuple[Variable, ...]
    outputs: tuple[Unknown, ...]
    derivatives: tuple[Unknown, ...]
    initial_unknowns: tuple[Unknown, ...]
    event_indicators: tuple[str, ...]
    """The expression of each event indicator, in Modelica names."""
    default_experiment: DefaultExperiment = field(default_factory=DefaultExperiment)
    documentation: str = ""
    """The HTML of the class's Documentation annotation."""
    terminals: tuple[Terminal, ...] = ()
    has_directional_derivatives: bool = False

    @property
    def identifier(self) -> str:
        """The last part of the class name: the FMU's file name and FMI's modelIdentifier."""
        return self.model_name.rpartition(".")[2]


@dataclass(frozen=True, slots=True)
class GeneratedModel:
    """A model as C source for the runtime's `model.h`, with its description."""

    description: ModelDescription
    c_source: str
    notes: str = ""
    """Remarks for the user who builds the FMU, one per line."""
    texts: bytes = b""
    """The source texts, as `check_results` of the generator takes them."""
