"""Statements about derivatives in modelDescription.xml, in both versions of FMI."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from typing import Any

import pytest
from lxml import etree

from fmu_build.packaging import fmi2_xml, fmi3_xml
from fmu_build.support.description import ModelDescription, Unknown


def _root(version: str, description: ModelDescription) -> Any:
    arguments: dict[str, Any] = {"guid": "{1-2}", "generation_tool": "tool", "generation_time": None}
    arguments["fmi_types"] = ("me", "cs")
    if version == "2.0":
        content = fmi2_xml.model_description_xml(description, source_files=["model.c"], **arguments)
    else:
        content = fmi3_xml.model_description_xml(description, **arguments)
    return etree.parse(BytesIO(content)).getroot()


@pytest.mark.parametrize("provided", [False, True])
@pytest.mark.parametrize(
    ("version", "attributes"),
    [
        ("2.0", ["providesDirectionalDerivative"]),
        ("3.0", ["providesDirectionalDerivatives", "providesAdjointDerivatives"]),
    ],
)
def test_capability(
    version: str, attributes: list[str], provided: bool, description: ModelDescription
) -> None:
    root = _root(version, replace(description, has_directional_derivatives=provided))
    for interface in ("ModelExchange", "CoSimulation"):
        found = [root.find(interface).get(attribute) for attribute in attributes]
        assert found == ["true" if provided else "false"] * len(attributes)


def test_parameters_as_knowns(description: ModelDescription) -> None:
    """FMI 2 has them in the initialization only, FMI 3 always."""
    numbers = {variable.name: n for n, variable in enumerate(description.variables)}
    rate = Unknown(numbers["der(v)"], (numbers["x"], numbers["k"]), ("dependent", "dependent"))
    described = replace(description, derivatives=(description.derivatives[0], rate))
    (in_fmi2,) = _root("2.0", described).xpath(
        f"ModelStructure/Derivatives/Unknown[@index={numbers['der(v)'] + 1}]"
    )
    assert in_fmi2.get("dependencies") == str(numbers["x"] + 1)
    (in_fmi3,) = _root("3.0", described).xpath(
        f"ModelStructure/ContinuousStateDerivative[@valueReference={numbers['der(v)']}]"
    )
    assert in_fmi3.get("dependencies") == f"{numbers['x']} {numbers['k']}"
