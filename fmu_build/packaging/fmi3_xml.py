"""Write modelDescription.xml and terminalsAndIcons.xml of FMI 3.0."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lxml import etree

from fmu_build.packaging.elements import (
    LICENSE,
    add,
    add_default_experiment,
    add_items,
    add_log_categories,
    document,
    enumeration_types,
    put,
    value_attributes,
)
from fmu_build.packaging.fmi2_units import unit_definitions
from fmu_build.support.description import ModelDescription, Unknown, Variable
from fmu_build.support.request import FmiType

# The runtime's capabilities. Both FMI types share one library and one identifier.
_CAPABILITIES = {
    "needsExecutionTool": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canGetAndSetFMUState": "true",
    "canSerializeFMUState": "true",
    "providesPerElementDependencies": "false",
    "providesEvaluateDiscreteStates": "false",
}
_MODEL_EXCHANGE = {**_CAPABILITIES, "needsCompletedIntegratorStep": "true"}
_CO_SIMULATION = {
    **_CAPABILITIES,
    "canHandleVariableCommunicationStepSize": "true",
    "maxOutputDerivativeOrder": "1",
    "providesIntermediateUpdate": "true",
    "mightReturnEarlyFromDoStep": "true",
    "canReturnEarlyAfterIntermediateUpdate": "true",
    "hasEventMode": "true",
}
_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}


def model_description_xml(
    description: ModelDescription,
    *,
    guid: str,
    fmi_types: Sequence[FmiType],
    generation_tool: str,
    generation_time: str | None,
) -> bytes:
    """Return the file's content; `guid` is the instantiation token, the rest is as in FMI 2.

    Event indicators are variables in FMI 3; their value references follow those of the model's variables.
    Raises `ModelicaError` for an invalid unit.
    """
    root = etree.Element("fmiModelDescription")
    put(
        root,
        fmiVersion="3.0",
        modelName=description.model_name,
        instantiationToken=guid,
        description=description.description or None,
        license=LICENSE,
        generationTool=generation_tool,
        generationDateAndTime=generation_time,
        variableNamingConvention="structured",
    )
    own = {
        "modelIdentifier": description.identifier,
        "providesDirectionalDerivatives": description.has_directional_derivatives,
        "providesAdjointDerivatives": description.has_directional_derivatives,
    }
    if "me" in fmi_types:
        add(root, "ModelExchange", **own, **_MODEL_EXCHANGE)
    if "cs" in fmi_types:
        add(root, "CoSimulation", **own, **_CO_SIMULATION)
    root.extend(unit_definitions(description.variables))
    _add_type_definitions(root, description.variables)
    add_log_categories(root, "fmi3")
    add_default_experiment(root, description.default_experiment)
    variables = add(root, "ModelVariables")
    for value_reference, variable in enumerate((*description.variables, *_event_indicators(description))):
        _add_variable(variables, value_reference, variable)
    _add_model_structure(root, description)
    return document(root)


def _event_indicators(description: ModelDescription) -> list[Variable]:
    """Return variables for the event indicators, under a name that the model does not use."""
    name = "eventIndicator"
    while any(variable.name.startswith(f"{name}[") for variable in description.variables):
        name += "_"
    numbered = enumerate((f"Zero crossing of {text}" for text in description.event_indicators), start=1)
    return [
        Variable(f"{name}[{number}]", "Real", "local", "continuous", "calculated", None, text)
        for number, text in numbered
    ]


def _add_variable(parent: etree._Element, value_reference: int, variable: Variable) -> None:
    in_steps = variable.variability == "continuous" and variable.causality in ("input", "output")
    attributes: dict[str, Any] = {
        "name": variable.name,
        "valueReference": value_reference,
        "description": variable.description or None,
        "causality": variable.causality,
        "variability": variable.variability,
        "initial": variable.initial,
        "intermediateUpdate": True if in_steps else None,
        "derivative": variable.derivative_of,
    }
    add(parent, _TYPES[variable.type], **attributes, **value_attributes(variable))


def _add_type_definitions(root: etree._Element, variables: Sequence[Variable]) -> None:
    types = enumeration_types(variables)
    definitions = add(root, "TypeDefinitions") if types else root
    for enumeration in types:
        add_items(add(definitions, "EnumerationType", name=enumeration.name), enumeration)


def _add_model_structure(root: etree._Element, description: ModelDescription) -> None:
    structure = add(root, "ModelStructure")
    for tag, unknowns in (
        ("Output", description.outputs),
        ("ContinuousStateDerivative", description.derivatives),
        ("InitialUnknown", description.initial_unknowns),
    ):
        for unknown in unknowns:
            _add_unknown(structure, tag, unknown)
    for number in range(len(description.event_indicators)):
        # Without a list of dependencies, they may depend on every state and input.
        add(structure, "EventIndicator", valueReference=len(description.variables) + number)


def _add_unknown(structure: etree._Element, tag: str, unknown: Unknown) -> None:
    add(
        structure,
        tag,
        valueReference=unknown.value_reference,
        dependencies=" ".join(map(str, unknown.dependencies)),
        dependenciesKind=" ".join(unknown.dependency_kinds),
    )


TERMINALS = "terminalsAndIcons/terminalsAndIcons.xml"


def terminals_and_icons_xml(description: ModelDescription) -> bytes:
    """Return the file's content: the position of the icon, and the model's terminals."""
    root = etree.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    graphics = add(root, "GraphicalRepresentation")
    # The icon is 20 mm wide, at an aspect ratio of 4:3.
    extent = {"x1": -100.0, "y1": -75.0, "x2": 100.0, "y2": 75.0}
    add(graphics, "CoordinateSystem", **extent, suggestedScalingFactorTo_mm=0.1)
    add(graphics, "Icon", **extent)
    terminals = add(root, "Terminals") if description.terminals else root
    for terminal in description.terminals:
        # "bus" allows a connection that leaves members out; "plug" would require all of them.
        element = add(terminals, "Terminal", name=terminal.name, matchingRule="bus")
        for variable, member, kind in terminal.members:
            names = {"variableName": variable, "memberName": member}
            add(element, "TerminalMemberVariable", **names, variableKind=kind)
    return document(root)
