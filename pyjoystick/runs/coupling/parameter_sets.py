"""Parameter values of a component, within a system's description or in a file of their own (SSV)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Final, Literal
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from fmpy import read_model_description

from pyjoystick.fmu import INTEGERS, REALS, FmuDescription, Value, Variable
from pyjoystick.runs.coupling.ssp_elements import BESIDES, NAMESPACES, require_known, tag
from pyjoystick.runs.coupling.system import Component
from pyjoystick.support import InputFileError

SspVersion = Literal["1.0", "2.0"]
_BASE_UNITS: Final = ("kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset")
#: One name for the values of all components, because ecos applies only the sets of a given name.
_PARAMETERS: Final = "parameters"
_SET_TYPE: Final = "application/x-ssp-parameter-set"
#: Namespace of the annotation with the uncertainty of a value.
_MEASURED: Final = "pyjoystick.measured"


@dataclass(frozen=True, slots=True)
class ParameterNote:
    """Uncertainty and origin of a value.

    Attributes:
        uncertainty: its standard uncertainty, in its unit; None if unknown
        source: its origin; may be empty
    """

    uncertainty: float | None
    source: str


def parameter_set_xml(
    component: Component,
    description: FmuDescription,
    notes: Mapping[str, ParameterNote],
    version: SspVersion,
) -> bytes:
    """Values of a component as an SSV file.

    The standard has no place for uncertainties: they are written to the description of a parameter, for
    people, and to an annotation, ``<pj:Measured standardUncertainty="..." source="..."/>``.
    """
    root = parameter_set(component, description, version)
    for parameter in root.iter(tag("ssv:Parameter")):
        note = notes.get(parameter.get("name", ""))
        if note is not None:
            _annotate(parameter, note)
    add_units(root, "ssv:Units", [description])
    return xml_file(root)


def _annotate(parameter: Element, note: ParameterNote) -> None:
    error = "" if note.uncertainty is None else f"{note.uncertainty:.2g}"
    unit = parameter[0].get("unit", "")
    text = "; ".join(filter(None, (error and f"standard uncertainty {error} {unit}".rstrip(), note.source)))
    if not text:
        return
    parameter.set("description", text)
    annotation = SubElement(
        SubElement(parameter, tag("ssv:Annotations")), tag("ssc:Annotation"), type=_MEASURED
    )
    known = {"standardUncertainty": "" if note.uncertainty is None else repr(note.uncertainty)}
    known["source"] = note.source
    SubElement(annotation, tag("pj:Measured"), {key: one for key, one in known.items() if one})


def parameter_set(component: Component, description: FmuDescription, version: SspVersion) -> Element:
    """Values of a component as a parameter set."""
    found = Element(tag("ssv:ParameterSet"), version=version, name=_PARAMETERS)
    parameters = SubElement(found, tag("ssv:Parameters"))
    for name, value in component.parameters.items():
        parameter = SubElement(parameters, tag("ssv:Parameter"), name=name)
        add_type(parameter, "ssv", description.variables[name]).set("value", _text(value))
    return found


def bind(element: Element, source: str | Element) -> None:
    """Bind values to a component: a set, or the name of the file that contains it."""
    bindings = SubElement(element, tag("ssd:ParameterBindings"))
    if isinstance(source, str):
        SubElement(bindings, tag("ssd:ParameterBinding"), type=_SET_TYPE, source=source)
        return
    binding = SubElement(bindings, tag("ssd:ParameterBinding"))
    SubElement(binding, tag("ssd:ParameterValues")).append(source)


def add_type(parent: Element, prefix: str, variable: Variable) -> Element:
    """Add the type of a variable, with its unit."""
    kind = "Real" if variable.type in REALS else "Integer" if variable.type in INTEGERS else variable.type
    element = SubElement(parent, tag(f"{prefix}:{kind}"))
    if kind == "Real" and variable.unit:
        element.set("unit", variable.unit)
    return element


def _text(value: Value) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def add_units(root: Element, name: str, descriptions: Iterable[FmuDescription]) -> None:
    """All units declared by an FMU, with their exponents of SI base units."""
    declared = {
        unit.name: unit.baseUnit
        for description in descriptions
        for unit in read_model_description(str(description.path), validate=False).unitDefinitions
    }
    units = SubElement(root, tag(name))
    for name, base in sorted(declared.items()):
        unit = SubElement(units, tag("ssc:Unit"), name=name)
        exponents = {key: str(getattr(base, key)) for key in _BASE_UNITS if base is not None}
        SubElement(
            unit, tag("ssc:BaseUnit"), {k: v for k, v in exponents.items() if float(v) != (k == "factor")}
        )


def bound_parameters(path: Path, element: Element, read: Callable[[str], bytes]) -> Iterator[Element]:
    """Parameters with a value that are bound to a component.

    Args:
        path: the archive
        element: the component
        read: reads a file of the archive; raises KeyError if there is none

    Raises:
        InputFileError: something in the binding is not supported or not allowed
    """
    for binding in element.iterfind("ssd:ParameterBindings/ssd:ParameterBinding", NAMESPACES):
        source = PurePosixPath(binding.get("source", ""))
        content = binding
        if source.name:
            if source.suffix != ".ssv" or source.is_absolute() or ".." in source.parts or ":" in str(source):
                reason = f"parameters from {str(source)!r}, which is no .ssv file of the archive"
                raise InputFileError(path, f"component {element.get('name')!r}: {reason}")
            try:
                content = ElementTree.fromstring(read(str(source)))
            except ElementTree.ParseError as error:
                raise InputFileError(path, f"{source} cannot be read: {error}") from error
        inside = [binding.find(f"ssd:{name}", NAMESPACES) for name in ("ParameterValues", "ParameterMapping")]
        has_values, has_mapping = (one is not None for one in inside)
        reason = ""
        if binding.get("prefix") or binding.get("sourceBase") or has_mapping:
            reason = "parameters with a prefix, a base or a mapping are not supported"
        elif has_values == bool(source.name):
            found = "both a source and" if has_values else "neither a source nor"
            reason = f"a ParameterBinding has {found} values"
        if reason:
            raise InputFileError(path, f"component {element.get('name')!r}: {reason}")
        if content is binding:
            yield from content.iterfind(
                "ssd:ParameterValues/ssv:ParameterSet/ssv:Parameters/ssv:Parameter", NAMESPACES
            )
        else:
            require_known(path, content, "ssv:ParameterSet")
            yield from content.iterfind("ssv:Parameters/ssv:Parameter", NAMESPACES)


def value_of(path: Path, parameter: Element) -> Value:
    """Value of a parameter in the archive `path`; raises InputFileError if it is not supported."""
    values = [one for one in parameter if one.tag.rpartition("}")[2] not in BESIDES]
    if parameter.find("ssc:Dimension", NAMESPACES) is not None:
        raise InputFileError(path, f"parameter {parameter.get('name')!r}: an array is not supported")
    if len(values) > 1:
        raise InputFileError(path, f"parameter {parameter.get('name')!r}: has {len(values)} values")
    typed = next(iter(values), Element("}no type"))
    kind, text = typed.tag.rpartition("}")[2], typed.get("value", "")
    number = text.replace("_", " ")  # XML has no digits in groups, as Python has
    try:
        if kind in ("Real", "Float64", "Float32"):
            return float(number)
        if kind in INTEGERS:
            return int(number)
        if kind == "Boolean":
            return {"true": True, "1": True, "false": False, "0": False}[text]
    except (KeyError, ValueError):
        kind = f"{kind} {text!r}"
    if kind == "String":
        return text
    raise InputFileError(path, f"parameter {parameter.get('name')!r}: a value of {kind} is not supported")


def xml_file(root: Element) -> bytes:
    """An element as the content of a file, with the namespace prefixes that tools expect."""
    for prefix, uri in NAMESPACES.items():
        ElementTree.register_namespace(prefix, uri)
    ElementTree.indent(root)
    content: bytes = ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)
    return content + b"\n"
