"""XML elements with attributes in the XML schema's spelling, and elements common to FMI 2 and FMI 3."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from datetime import UTC, datetime
from typing import Any

from lxml import etree

from fmu_build.packaging.fmi2_units import distinct_display_unit
from fmu_build.support.description import DefaultExperiment, EnumerationType, Variable
from fmu_build.support.errors import BuildError

LICENSE = "See documentation/licenses/license.txt"
_LOG_CATEGORIES = {
    "logEvents": "All events, during initialization and simulation",
    "logStatusWarning": "Messages of functions that return {prefix}Warning",
    "logStatusDiscard": "Messages of functions that return {prefix}Discard",
    "logStatusError": "Messages of functions that return {prefix}Error",
    "logAll": "All messages",
}


def add(parent: etree._Element, tag: str, **attributes: Any) -> etree._Element:
    """Add an element to `parent`, with the attributes that are not None."""
    element = etree.SubElement(parent, tag)
    put(element, **attributes)
    return element


def put(element: etree._Element, **attributes: Any) -> None:
    """Set the attributes that are not None, in the XML schema's spelling."""
    for name, value in attributes.items():
        if isinstance(value, bool):
            element.set(name, "true" if value else "false")
        elif isinstance(value, float):
            element.set(name, repr(value))
        elif value is not None:
            element.set(name, xml_text(str(value)))


def document(root: etree._Element) -> bytes:
    """Return the XML file with this root element."""
    content: bytes = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    return content


def generation_time() -> str | None:
    """Return `SOURCE_DATE_EPOCH` as an FMI date, None if unset; raises `BuildError` if malformed."""
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


def add_log_categories(root: etree._Element, prefix: str) -> None:
    """Add the standard log categories that the runtime uses; `prefix` is ``fmi2`` or ``fmi3``."""
    categories = add(root, "LogCategories")
    for name, text in _LOG_CATEGORIES.items():
        add(categories, "Category", name=name, description=text.format(prefix=prefix))


def add_default_experiment(root: etree._Element, experiment: DefaultExperiment) -> None:
    """Add the model's default experiment."""
    add(
        root,
        "DefaultExperiment",
        startTime=experiment.start_time,
        stopTime=experiment.stop_time,
        tolerance=experiment.tolerance,
        stepSize=experiment.step_size,
    )


def value_attributes(variable: Variable) -> dict[str, Any]:
    """Return the attributes of the variable's type element that FMI 2 and FMI 3 have in common."""
    attributes: dict[str, Any] = {"start": _start(variable), "reinit": variable.reinit or None}
    if variable.enumeration is not None:
        attributes["declaredType"] = variable.enumeration.name
    if variable.type != "Boolean":
        attributes["quantity"] = variable.quantity or None
        attributes["min"] = _number(variable.minimum, variable)
        attributes["max"] = _number(variable.maximum, variable)
    if variable.type == "Real":
        attributes["unit"] = variable.unit or None
        attributes["displayUnit"] = distinct_display_unit(variable) or None
        attributes["nominal"] = variable.nominal
    return attributes


def _start(variable: Variable) -> float | bool | None:
    if variable.start is not None and variable.type == "Boolean":
        return bool(variable.start)
    return _number(variable.start, variable)


def _number(value: float | None, variable: Variable) -> float | None:
    if value is None:
        return None
    return float(value) if variable.type == "Real" else int(value)


def enumeration_types(variables: Iterable[Variable]) -> list[EnumerationType]:
    """Return the enumeration types of the variables, each once and sorted by name."""
    types: dict[str, EnumerationType] = {}
    for variable in variables:
        if variable.enumeration is not None:
            known = types.setdefault(variable.enumeration.name, variable.enumeration)
            if known != variable.enumeration:
                raise BuildError(f"internal error: two enumerations are named {known.name!r}")
    return [types[name] for name in sorted(types)]


def add_items(parent: etree._Element, enumeration: EnumerationType) -> None:
    """Add the literals of an enumeration, numbered from 1."""
    for value, (literal, description) in enumerate(enumeration.literals, start=1):
        add(parent, "Item", name=literal, value=value, description=description or None)


_NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def xml_text(text: str) -> str:
    """Return the text with a space for each character that XML 1.0 cannot represent, even escaped."""
    return _NOT_XML.sub(" ", text)
