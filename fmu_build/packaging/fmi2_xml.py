"""Write modelDescription.xml of FMI 2.0.4."""

from __future__ import annotations

from collections.abc import Collection, Sequence

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
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
}
_MODEL_EXCHANGE = {**_CAPABILITIES, "completedIntegratorStepNotNeeded": "false"}
_CO_SIMULATION = {
    **_CAPABILITIES,
    "canHandleVariableCommunicationStepSize": "true",
    "canInterpolateInputs": "true",
    "maxOutputDerivativeOrder": "1",
    "canRunAsynchronuously": "false",
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
    """Return the file's content.

    `source_files` are the C files in sources/. `generation_time` is omitted by default: the current date
    would make every build of the same model differ. Raises `ModelicaError` for an invalid unit.
    """
    root = etree.Element("fmiModelDescription")
    put(
        root,
        fmiVersion="2.0",
        modelName=description.model_name,
        guid=guid,
        description=description.description or None,
        license=LICENSE,
        generationTool=generation_tool,
        generationDateAndTime=generation_time,
        variableNamingConvention="structured",
        numberOfEventIndicators=len(description.event_indicators),
    )
    interfaces = {"me": ("ModelExchange", _MODEL_EXCHANGE), "cs": ("CoSimulation", _CO_SIMULATION)}
    for fmi_type in ("me", "cs"):
        if fmi_type in fmi_types:
            tag, capabilities = interfaces[fmi_type]
            interface = add(
                root,
                tag,
                modelIdentifier=description.identifier,
                providesDirectionalDerivative=description.has_directional_derivatives,
                **capabilities,
            )
            files = add(interface, "SourceFiles")
            for name in source_files:
                add(files, "File", name=name)
    root.extend(unit_definitions(description.variables))
    _add_type_definitions(root, description.variables)
    add_log_categories(root, "fmi2")
    add_default_experiment(root, description.default_experiment)
    variables = add(root, "ModelVariables")
    for value_reference, variable in enumerate(description.variables):
        variables.append(_scalar_variable(value_reference, variable))
    root.append(_model_structure(description))
    return document(root)


def _scalar_variable(value_reference: int, variable: Variable) -> etree._Element:
    element = etree.Element("ScalarVariable")
    put(
        element,
        name=variable.name,
        valueReference=value_reference,
        description=variable.description or None,
        causality=variable.causality,
        variability=variable.variability,
        initial=variable.initial,
    )
    index = None if variable.derivative_of is None else variable.derivative_of + 1
    add(element, variable.type, derivative=index, **value_attributes(variable))
    return element


def _add_type_definitions(root: etree._Element, variables: Sequence[Variable]) -> None:
    types = enumeration_types(variables)
    definitions = add(root, "TypeDefinitions") if types else root
    for enumeration in types:
        add_items(add(add(definitions, "SimpleType", name=enumeration.name), "Enumeration"), enumeration)


def _model_structure(description: ModelDescription) -> etree._Element:
    structure = etree.Element("ModelStructure")
    parameters = {n for n, v in enumerate(description.variables) if v.causality == "parameter"}
    for tag, unknowns in (
        ("Outputs", [_without(unknown, parameters) for unknown in description.outputs]),
        ("Derivatives", [_without(unknown, parameters) for unknown in description.derivatives]),
        ("InitialUnknowns", description.initial_unknowns),
    ):
        if unknowns:
            parent = add(structure, tag)
            for unknown in unknowns:
                _add_unknown(parent, unknown)
    return structure


def _without(unknown: Unknown, left_out: Collection[int]) -> Unknown:
    """Remove some dependencies: in FMI 2, parameters are knowns during initialization only."""
    pairs = zip(unknown.dependencies, unknown.dependency_kinds, strict=True)
    kept = [(reference, kind) for reference, kind in pairs if reference not in left_out]
    return Unknown(unknown.value_reference, tuple(r for r, _ in kept), tuple(k for _, k in kept))


def _add_unknown(parent: etree._Element, unknown: Unknown) -> None:
    # Indices of ScalarVariables are one-based; value references are their zero-based positions.
    add(
        parent,
        "Unknown",
        index=unknown.value_reference + 1,
        dependencies=" ".join(str(reference + 1) for reference in unknown.dependencies),
        dependenciesKind=" ".join(unknown.dependency_kinds),
    )
