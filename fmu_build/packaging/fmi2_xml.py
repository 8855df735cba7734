"""modelDescription.xml of FMI 2.0.4."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from typing import Any

from lxml import etree

from fmu_build.description import EnumerationType, ModelDescription, Unknown, Variable
from fmu_build.errors import BuildError
from fmu_build.packaging.fmi2_units import distinct_display_unit, unit_definitions
from fmu_build.packaging.text import xml_text
from fmu_build.request import FmiType

LICENSE = "See documentation/licenses/license.txt"

# What the runtime can do. Both kinds of FMU are one library with one identifier.
_CAPABILITIES = {
    "needsExecutionTool": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "false",
}
_MODEL_EXCHANGE = {**_CAPABILITIES, "completedIntegratorStepNotNeeded": "false"}
_CO_SIMULATION = {
    **_CAPABILITIES,
    "canHandleVariableCommunicationStepSize": "true",
    "canInterpolateInputs": "true",
    "maxOutputDerivativeOrder": "1",
    "canRunAsynchronuously": "false",
}
_LOG_CATEGORIES = {
    "logEvents": "All events, during initialization and simulation",
    "logSingularLinearSystems": "Singular linear systems of equations",
    "logNonlinearSystems": "Solution of nonlinear systems of equations",
    "logDynamicStateSelection": "Dynamic selection of states",
    "logStatusWarning": "Messages of functions that return fmi2Warning",
    "logStatusDiscard": "Messages of functions that return fmi2Discard",
    "logStatusError": "Messages of functions that return fmi2Error",
    "logStatusFatal": "Messages of functions that return fmi2Fatal",
    "logStatusPending": "Messages of functions that return fmi2Pending",
    "logAll": "All messages",
}


def model_description_xml(
    description: ModelDescription,
    *,
    guid: str,
    fmi_types: Sequence[FmiType],
    source_files: Sequence[str],
    generation_tool: str,
    generation_time: str | None,
) -> bytes:
    """The file's content.

    `source_files` are the C files in sources/. `generation_time` is written where it is given: a date of
    today would make every build of the same model a different file.
    Raises `ModelicaError` for a unit that is not one.
    """
    root = etree.Element("fmiModelDescription")
    _set(
        root,
        fmiVersion="2.0",
        modelName=description.model_name,
        guid=guid,
        description=description.description or None,
        license=LICENSE,
        generationTool=generation_tool,
        generationDateAndTime=generation_time,
        variableNamingConvention="structured",
        numberOfEventIndicators=description.number_of_event_indicators,
    )
    interfaces = {"me": ("ModelExchange", _MODEL_EXCHANGE), "cs": ("CoSimulation", _CO_SIMULATION)}
    for fmi_type in ("me", "cs"):
        if fmi_type in fmi_types:
            tag, capabilities = interfaces[fmi_type]
            interface = _add(root, tag, modelIdentifier=description.identifier, **capabilities)
            files = _add(interface, "SourceFiles")
            for name in source_files:
                _add(files, "File", name=name)
    root.extend(unit_definitions(description.variables))
    root.extend(_type_definitions(description.variables))
    categories = _add(root, "LogCategories")
    for name, text in _LOG_CATEGORIES.items():
        _add(categories, "Category", name=name, description=text)
    experiment = description.default_experiment
    _add(
        root,
        "DefaultExperiment",
        startTime=experiment.start_time,
        stopTime=experiment.stop_time,
        tolerance=experiment.tolerance,
        stepSize=experiment.step_size,
    )
    variables = _add(root, "ModelVariables")
    for value_reference, variable in enumerate(description.variables):
        variables.append(_scalar_variable(value_reference, variable))
    root.append(_model_structure(description))
    content: bytes = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    return content


def generation_time() -> str | None:
    """`SOURCE_DATE_EPOCH` as FMI writes dates, None where it is not set; raises `BuildError` if malformed."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    if not epoch:
        return None
    try:
        moment = datetime.fromtimestamp(int(epoch), UTC)
    except (ValueError, OverflowError, OSError) as error:
        raise BuildError(
            f"the environment variable SOURCE_DATE_EPOCH is {epoch!r}, not a number of seconds since 1970"
        ) from error
    return moment.strftime("%Y-%m-%dT%H:%M:%SZ")


def _scalar_variable(value_reference: int, variable: Variable) -> etree._Element:
    element = etree.Element("ScalarVariable")
    _set(
        element,
        name=variable.name,
        valueReference=value_reference,
        description=variable.description or None,
        causality=variable.causality,
        variability=variable.variability,
        initial=variable.initial,
    )
    whole = variable.type in ("Integer", "Enumeration")
    attributes: dict[str, Any] = {}
    if variable.enumeration is not None:
        attributes["declaredType"] = variable.enumeration.name
    if variable.type != "Boolean":
        attributes["quantity"] = variable.quantity or None
    if variable.type == "Real":
        attributes |= {"unit": variable.unit or None, "displayUnit": distinct_display_unit(variable) or None}
    if variable.type != "Boolean":
        attributes |= {"min": _number(variable.minimum, whole), "max": _number(variable.maximum, whole)}
    if variable.type == "Real":
        attributes["nominal"] = variable.nominal
    if variable.start is not None:
        attributes["start"] = (
            bool(variable.start) if variable.type == "Boolean" else _number(variable.start, whole)
        )
    if variable.derivative_of is not None:
        attributes["derivative"] = variable.derivative_of + 1
    if variable.reinit:
        attributes["reinit"] = True
    _add(element, variable.type, **attributes)
    return element


def _number(value: float | None, whole: bool) -> float | None:
    if value is None:
        return None
    return int(value) if whole else float(value)


def _type_definitions(variables: Iterable[Variable]) -> list[etree._Element]:
    types: dict[str, EnumerationType] = {}
    for variable in variables:
        if variable.enumeration is not None:
            known = types.setdefault(variable.enumeration.name, variable.enumeration)
            if known != variable.enumeration:
                raise BuildError(f"internal error: two enumerations are named {known.name!r}")
    if not types:
        return []
    definitions = etree.Element("TypeDefinitions")
    for name in sorted(types):
        enumeration = _add(_add(definitions, "SimpleType", name=name), "Enumeration")
        for value, (literal, description) in enumerate(types[name].literals, start=1):
            _add(enumeration, "Item", name=literal, value=value, description=description or None)
    return [definitions]


def _model_structure(description: ModelDescription) -> etree._Element:
    structure = etree.Element("ModelStructure")
    for tag, unknowns in (
        ("Outputs", description.outputs),
        ("Derivatives", description.derivatives),
        ("InitialUnknowns", description.initial_unknowns),
    ):
        if unknowns:
            parent = _add(structure, tag)
            for unknown in unknowns:
                _add_unknown(parent, unknown)
    return structure


def _add_unknown(parent: etree._Element, unknown: Unknown) -> None:
    # Indices count the ScalarVariables from 1; value references are their positions from 0.
    _add(
        parent,
        "Unknown",
        index=unknown.value_reference + 1,
        dependencies=" ".join(str(reference + 1) for reference in unknown.dependencies),
        dependenciesKind=" ".join(unknown.dependency_kinds),
    )


def _add(parent: etree._Element, tag: str, **attributes: Any) -> etree._Element:
    element = etree.SubElement(parent, tag)
    _set(element, **attributes)
    return element


def _set(element: etree._Element, **attributes: Any) -> None:
    """Sets what is not None; booleans, numbers and text in the XML schema's spelling."""
    for name, value in attributes.items():
        if isinstance(value, bool):
            element.set(name, "true" if value else "false")
        elif isinstance(value, float):
            element.set(name, repr(value))
        elif value is not None:
            element.set(name, xml_text(str(value)))
