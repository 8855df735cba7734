"""Write the UnitDefinitions of a model description, the same in FMI 2 and FMI 3."""

from __future__ import annotations

from collections.abc import Iterable

from lxml import etree

from fmu_build.packaging.units import BASE_UNITS, Unit, UnitError, conversion, parse_unit
from fmu_build.support.description import Variable
from fmu_build.support.errors import ModelicaError

# Offered to importers in addition to the display units of the model.
_USUAL_DISPLAY_UNITS = {
    "rad": ("deg",),
    "rad/s": ("deg/s", "rev/min"),
    "rad/s2": ("deg/s2",),
    "m": ("cm", "mm"),
    "m/s": ("mm/s", "km/h"),
    "s": ("ms",),
    "kg": ("g",),
    "kg.m2": ("kg.cm2", "g.cm2"),
    "J": ("mJ",),
    "N/m": ("N/mm",),
    "N.m": ("N.mm", "N.cm"),
    "N.m/rad": ("N.m/deg",),
    "N.m.s/rad": ("N.m.s/deg",),
    "K": ("degC",),
    "Pa": ("kPa", "bar"),
}


def distinct_display_unit(variable: Variable) -> str:
    """Return the variable's display unit, or "" if it has none or it equals the unit."""
    return "" if variable.display_unit == variable.unit else variable.display_unit


def unit_definitions(variables: Iterable[Variable]) -> list[etree._Element]:
    """Return at most one `UnitDefinitions` element: every unit, with its base unit and display units.

    Raises `ModelicaError`, which names the variable, for an invalid unit or display unit.
    """
    display_units: dict[str, set[str]] = {}
    for variable in variables:
        display_unit = distinct_display_unit(variable)
        if display_unit and not variable.unit:
            raise ModelicaError(f"variable {variable.name!r} has displayUnit {display_unit!r} but no unit")
        if not variable.unit:
            continue
        known = display_units.setdefault(variable.unit, set(_USUAL_DISPLAY_UNITS.get(variable.unit, ())))
        try:
            parse_unit(variable.unit)
            if display_unit:
                conversion(variable.unit, display_unit)
                known.add(display_unit)
        except UnitError as error:
            raise ModelicaError(f"variable {variable.name!r}: {error}") from error
    if not display_units:
        return []
    definitions = etree.Element("UnitDefinitions")
    for name in sorted(display_units):
        definitions.append(_unit(name, sorted(display_units[name])))
    return [definitions]


def add_unit_definitions(model_description: bytes) -> tuple[bytes, list[str]]:
    """Add the missing unit definitions to an FMI 2 model description; return it and the added units.

    A unit that is not a Modelica unit is defined by its name alone, which the standard allows. Descriptions
    of other FMI versions, and complete ones, are returned unchanged.
    """
    root = etree.fromstring(model_description)
    used = {variable.get("unit") for variable in root.iterfind("ModelVariables/ScalarVariable/Real")}
    defined = {unit.get("name") for unit in root.iterfind("UnitDefinitions/Unit")}
    missing = sorted(unit for unit in used - defined if unit)
    if root.get("fmiVersion") != "2.0" or not missing:
        return model_description, []
    definitions = root.find("UnitDefinitions")
    if definitions is None:
        definitions = etree.Element("UnitDefinitions")
        interfaces = [child for child in root if child.tag in ("ModelExchange", "CoSimulation")]
        interfaces[-1].addnext(definitions)
    for name in missing:
        try:
            definitions.append(_unit(name, []))
        except UnitError:
            etree.SubElement(definitions, "Unit", name=name)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8"), missing


def _unit(name: str, display_units: list[str]) -> etree._Element:
    element = etree.Element("Unit", name=name)
    element.append(_base_unit(parse_unit(name)))
    for display_name in display_units:
        factor, offset = conversion(name, display_name)
        display = etree.SubElement(element, "DisplayUnit", name=display_name, factor=repr(factor))
        if offset:
            display.set("offset", repr(offset))
    return element


def _base_unit(unit: Unit) -> etree._Element:
    element = etree.Element("BaseUnit")
    for base, exponent in zip(BASE_UNITS, unit.exponents, strict=True):
        if exponent:
            element.set(base, str(exponent))
    if unit.factor != 1:
        element.set("factor", repr(float(unit.factor)))
    if unit.offset:
        element.set("offset", repr(float(unit.offset)))
    return element
