"""terminalsAndIcons/terminalsAndIcons.xml of FMI 3.0.2: which variables are connected together."""

from __future__ import annotations

from lxml import etree

from fmu_build.packaging.elements import add, document
from fmu_build.support.description import ModelDescription

TERMINALS = "terminalsAndIcons/terminalsAndIcons.xml"


def terminals_and_icons_xml(description: ModelDescription) -> bytes:
    """The file's content: where the icon is, and the model's terminals."""
    root = etree.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    graphics = add(root, "GraphicalRepresentation")
    # The icon has four parts of width to three of height, 20 mm wide.
    extent = {"x1": -100.0, "y1": -75.0, "x2": 100.0, "y2": 75.0}
    add(graphics, "CoordinateSystem", **extent, suggestedScalingFactorTo_mm=0.1)
    add(graphics, "Icon", **extent)
    terminals = add(root, "Terminals") if description.terminals else root
    for terminal in description.terminals:
        # Whoever connects one may do without some of the members: "bus", where "plug" would demand all.
        element = add(terminals, "Terminal", name=terminal.name, matchingRule="bus")
        for variable, member, kind in terminal.members:
            names = {"variableName": variable, "memberName": member}
            add(element, "TerminalMemberVariable", **names, variableKind=kind)
    return document(root)
