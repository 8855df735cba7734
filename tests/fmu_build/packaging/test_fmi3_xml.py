"""modelDescription.xml and terminals of FMI 3, and an FMU with a variable of every type."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import fmpy
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave
from lxml import etree

from fmu_build.packaging import package_fmu
from fmu_build.packaging.consistency import check_description
from fmu_build.packaging.fmi3_xml import model_description_xml, terminals_and_icons_xml
from fmu_build.support.description import GeneratedModel, ModelDescription, Terminal, Variable
from fmu_build.support.errors import ModelicaError
from fmu_build.support.request import BuildRequest

_SCHEMAS = Path(fmpy.__file__).parent / "schema" / "fmi3"


def _root(description: ModelDescription) -> etree._Element:
    content = model_description_xml(
        description, guid="{token}", fmi_types=("me", "cs"), generation_tool="test", generation_time=None
    )
    root = etree.fromstring(content)
    etree.XMLSchema(etree.parse(_SCHEMAS / "fmi3ModelDescription.xsd")).assertValid(root)
    return root


def test_variables(description: ModelDescription) -> None:
    variables = {element.get("name"): element for element in _root(description).find("ModelVariables")}
    assert [variables[name].tag for name in ("x", "n", "flag", "mode")] == [
        "Float64",
        "Int32",
        "Boolean",
        "Enumeration",
    ]
    assert variables["der(v)"].get("derivative") == "2"
    assert variables["mode"].get("declaredType") == "Test.Mode"
    assert variables["mode"].get("start") == "2"
    assert variables["flag"].get("start") == "true"
    in_steps = [name for name, element in variables.items() if element.get("intermediateUpdate")]
    assert in_steps == ["x", "F", "E"]
    literals = [
        item.get("name") for item in _root(description).iterfind("TypeDefinitions/EnumerationType/Item")
    ]
    assert literals == ["Slow", "Fast"]


def test_structure_names_value_references(description: ModelDescription) -> None:
    structure = _root(description).find("ModelStructure")
    rows = [(row.tag, row.get("valueReference"), row.get("dependencies")) for row in structure]
    assert rows[:4] == [
        ("Output", "1", "1"),
        ("Output", "8", "1 2"),
        ("ContinuousStateDerivative", "3", "2"),
        ("ContinuousStateDerivative", "4", "1 7"),
    ]


def test_event_indicators_are_variables_of_their_own(description: ModelDescription) -> None:
    clash = Variable("eventIndicator[1]", "Real", "local", "continuous", "calculated", None)
    variables = (*description.variables, clash)
    root = _root(replace(description, variables=variables, event_indicators=("x - 1", "v")))
    indicators = root.findall("ModelStructure/EventIndicator")
    assert [row.get("valueReference") for row in indicators] == ["13", "14"]
    by_reference = {element.get("valueReference"): element for element in root.find("ModelVariables")}
    assert by_reference["13"].get("name") == "eventIndicator_[1]"
    assert by_reference["13"].get("description") == "Zero crossing of x - 1"


def test_terminals(description: ModelDescription) -> None:
    terminal = Terminal("rod", (("F", "f", "inflow"), ("x", "s", "signal")))
    root = etree.fromstring(terminals_and_icons_xml(replace(description, terminals=(terminal,))))
    etree.XMLSchema(etree.parse(_SCHEMAS / "fmi3TerminalsAndIcons.xsd")).assertValid(root)
    members = root.findall("Terminals/Terminal[@name='rod']/TerminalMemberVariable")
    assert [dict(member.attrib) for member in members] == [
        {"variableName": "F", "memberName": "f", "variableKind": "inflow"},
        {"variableName": "x", "memberName": "s", "variableKind": "signal"},
    ]
    without = etree.fromstring(terminals_and_icons_xml(description))
    assert without.find("Terminals") is None


@pytest.mark.parametrize("name", ["v", "missing"])
def test_what_cannot_be_connected_is_refused(description: ModelDescription, name: str) -> None:
    terminal = Terminal("rod", ((name, "f", "signal"),))
    with pytest.raises(ModelicaError, match=f"terminal 'rod': '{name}' is not an input, output or parameter"):
        check_description(replace(description, terminals=(terminal,)))


def test_every_type_is_set_and_read(
    generated: GeneratedModel, request_in: BuildRequest, tmp_path: Path
) -> None:
    path = package_fmu(generated, replace(request_in, fmi_version="3.0")).path
    description = read_model_description(str(path))
    references = {v.name: v.valueReference for v in description.modelVariables}
    fmu = FMU3Slave(
        guid=description.guid,
        modelIdentifier="Oscillator",
        unzipDirectory=extract(str(path), str(tmp_path / "unpacked")),
        instanceName="test",
    )
    fmu.instantiate()
    fmu.setFloat64([references["k"]], [9.0])
    fmu.setInt32([references["n"]], [7])
    fmu.setInt64([references["mode"]], [1])
    fmu.setBoolean([references["flag"]], [False])
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    fmu.doStep(0.0, 0.5)
    assert list(fmu.getFloat64([references["k"]])) == [9.0]
    assert list(fmu.getInt32([references["n"]])) == [7]
    assert list(fmu.getInt64([references["mode"]])) == [1]
    assert list(fmu.getBoolean([references["flag"]])) == [False]
    fmu.terminate()
    fmu.freeInstance()
