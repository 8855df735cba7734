"""The elements of SSP 1.0 and 2.0, and those that each may contain.

What stands elsewhere would be ignored: a misspelled connection, values under another prefix.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Final
from xml.etree.ElementTree import Element

from pyjoystick.support import InputFileError

#: Namespaces of both versions of the standard, and OMSimulator's.
NAMESPACES: Final = {
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "pj": "urn:pyjoystick:measured",
    "oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
}
_TYPES: Final = (
    *("Real", "Integer", "Boolean", "String", "Enumeration", "Binary", "Float32", "Float64", "Clock"),
    *(f"{kind}{bits}" for kind in ("Int", "UInt") for bits in (8, 16, 32, 64)),
)
_TRANSFORMATIONS: Final = " ".join(
    f"{space}:{kind}Transformation"
    for space in ("ssc", "ssd")
    for kind in ("Linear", "BooleanMapping", "IntegerMapping", "EnumerationMapping")
)
_ELEMENT: Final = "ssd:Connectors ssd:ElementGeometry ssd:ParameterBindings"
#: Children by element, besides annotations and metadata. What is not listed here is not looked into.
_CHILDREN: Final = {
    name: frozenset(children.split())
    for name, children in {
        "ssd:SystemStructureDescription": "ssd:System ssd:Enumerations ssd:Units ssd:DefaultExperiment",
        "ssd:System": f"{_ELEMENT} ssd:Elements ssd:Connections ssd:SignalDictionaries ssd:SystemGeometry "
        "ssd:GraphicalElements",
        "ssd:Elements": "ssd:Component ssd:SignalDictionaryReference ssd:System",
        "ssd:Component": _ELEMENT,
        "ssd:Connectors": "ssd:Connector",
        "ssd:Connector": " ".join(
            ("ssd:ConnectorGeometry ssc:Dimension ssd:Clock", *(f"ssc:{one}" for one in _TYPES))
        ),
        "ssd:ParameterBindings": "ssd:ParameterBinding",
        "ssd:ParameterBinding": "ssd:ParameterValues ssd:ParameterMapping",
        "ssd:ParameterValues": "ssv:ParameterSet",
        "ssd:Connections": "ssd:Connection",
        "ssd:Connection": f"ssd:ConnectionGeometry {_TRANSFORMATIONS}",
        "ssd:DefaultExperiment": "",
        "ssd:Units": "ssc:Unit",
        "ssv:Units": "ssc:Unit",
        "ssc:Unit": "ssc:BaseUnit",
        "ssv:ParameterSet": "ssv:Parameters ssv:Enumerations ssv:Units",
        "ssv:Parameters": "ssv:Parameter",
        "ssv:Parameter": " ".join(("ssc:Dimension", *(f"ssv:{one}" for one in _TYPES))),
    }.items()
} | {f"ssv:{one}": frozenset[str]() for one in _TYPES}
#: Elements that one element may contain more than once.
_REPEATED: Final = frozenset(
    (
        *("ssd:Component", "ssd:Connection", "ssd:Connector", "ssd:ParameterBinding", "ssd:System"),
        *("ssd:SignalDictionaryReference", "ssc:Dimension", "ssc:Unit", "ssv:Parameter"),
    )
)
_ANYWHERE: Final = ("Annotations", "MetaData", "Signature")
#: What a parameter may contain besides its value.
BESIDES: Final = _ANYWHERE


def tag(name: str) -> str:
    """A name with its namespace."""
    prefix, _, local = name.partition(":")
    return f"{{{NAMESPACES[prefix]}}}{local}"


def require_known(path: Path, root: Element, name: str) -> None:
    """Raise `InputFileError` for an element that SSP does not have in its place, or not more than once.

    Args:
        path: the archive
        root: an element
        name: what it must be, as ``ssv:ParameterSet``
    """
    if root.tag != tag(name):
        raise InputFileError(path, f"has {_in_words(root)}, must be {name}")
    _require_children(path, root, name)


def _require_children(path: Path, parent: Element, name: str) -> None:
    where = f"{name} {parent.get('name')!r}" if parent.get("name") else name
    allowed = {tag(one): one for one in _CHILDREN[name]}
    anywhere = {tag(f"{space}:{one}") for space in ("ssc", "ssd", "ssv") for one in _ANYWHERE}
    for text in (parent.text, *(child.tail for child in parent)):
        if text and not text.isspace():
            raise InputFileError(path, f"{where}: has the text {text.strip()[:40]!r}, may have none")
    for child in parent:
        if child.tag not in allowed and child.tag not in anywhere:
            raise InputFileError(path, f"{where}: {_in_words(child)} does not belong there")
    for one, count in Counter(child.tag for child in parent).items():
        if count > 1 and one in allowed and (allowed[one] not in _REPEATED or name.endswith("Description")):
            raise InputFileError(path, f"{where}: has {count} of {allowed[one]}, may have one")
    for child in parent:
        if allowed.get(child.tag) in _CHILDREN:
            _require_children(path, child, allowed[child.tag])


def _in_words(element: Element) -> str:
    space, _, local = str(element.tag).rpartition("}")
    known = {uri: prefix for prefix, uri in NAMESPACES.items()}
    prefix = known.get(space.lstrip("{"))
    if prefix is not None:
        return f"an element {prefix}:{local}"
    return f"an element {local!r} of the unknown namespace {space.lstrip('{')!r}"
