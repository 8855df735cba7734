"""modelDescription.xml as read by FMPy, with the standard's schema, and by a plain XML parser."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_build.packaging.elements import generation_time
from fmu_build.packaging.fmi2_xml import model_description_xml
from fmu_build.support.description import EnumerationType, ModelDescription, Variable
from fmu_build.support.errors import BuildError, ModelicaError


def _xml(description: ModelDescription, **changes: Any) -> bytes:
    arguments: dict[str, Any] = {
        "guid": "{1-2}",
        "fmi_types": ("me", "cs"),
        "source_files": ["fmi2.c", "model.c"],
        "generation_tool": "tool 1.0",
        "generation_time": None,
    }
    return model_description_xml(description, **(arguments | changes))


def _root(description: ModelDescription, **changes: Any) -> Any:
    return etree.parse(BytesIO(_xml(description, **changes))).getroot()


def _replaced(description: ModelDescription, name: str, **changes: Any) -> ModelDescription:
    variables = tuple(replace(v, **changes) if v.name == name else v for v in description.variables)
    return replace(description, variables=variables)


def _problems(description: ModelDescription, folder: Path) -> list[str]:
    (folder / "modelDescription.xml").write_bytes(_xml(description))
    problems: list[str] = validate_fmu(str(folder))
    return problems


def test_schema_and_rules_of_the_standard(description: ModelDescription, tmp_path: Path) -> None:
    assert _problems(description, tmp_path) == []


def test_fmpy_finds_a_missing_initial_unknown(description: ModelDescription, tmp_path: Path) -> None:
    short = replace(description, initial_unknowns=description.initial_unknowns[:-1])
    assert any("InitialUnknowns" in problem for problem in _problems(short, tmp_path))


def test_fmpy_reads_what_was_written(description: ModelDescription, tmp_path: Path) -> None:
    (tmp_path / "modelDescription.xml").write_bytes(_xml(description))
    read = read_model_description(str(tmp_path))
    assert (read.guid, read.modelName, read.generationTool) == ("{1-2}", "Test.Oscillator", "tool 1.0")
    assert read.variableNamingConvention == "structured"
    assert [v.name for v in read.modelVariables] == [v.name for v in description.variables]
    assert [int(v.valueReference) for v in read.modelVariables] == list(range(12))
    by_name = {v.name: v for v in read.modelVariables}
    assert by_name["der(v)"].derivative is by_name["v"]
    assert by_name["k"].description == "Stiffness <&>"
    assert (by_name["x"].unit, by_name["x"].displayUnit, float(by_name["x"].nominal)) == ("m", "mm", 0.1)
    assert (by_name["mode"].start, by_name["flag"].start) == ("2", "true")
    assert [u.variable.name for u in read.outputs] == ["x", "E"]
    assert [u.variable.name for u in read.derivatives] == ["der(x)", "der(v)"]
    assert [d.name for d in read.initialUnknowns[1].dependencies] == ["x", "k", "m", "F"]
    assert read.derivatives[1].dependenciesKind == ["tunable", "tunable"]


def test_capabilities_of_both_interfaces(description: ModelDescription) -> None:
    root = _root(description)
    for tag in ("ModelExchange", "CoSimulation"):
        interface = root.find(tag)
        assert interface.get("modelIdentifier") == "Oscillator"
        assert interface.get("canGetAndSetFMUstate") == interface.get("canSerializeFMUstate") == "true"
        assert interface.get("needsExecutionTool") == "false"
        assert [f.get("name") for f in interface.iterfind("SourceFiles/File")] == ["fmi2.c", "model.c"]
    assert root.find("CoSimulation").get("canHandleVariableCommunicationStepSize") == "true"
    assert root.find("CoSimulation").get("canInterpolateInputs") == "true"


@pytest.mark.parametrize(("fmi_type", "absent"), [("me", "CoSimulation"), ("cs", "ModelExchange")])
def test_one_interface_alone(description: ModelDescription, fmi_type: str, absent: str) -> None:
    root = _root(description, fmi_types=(fmi_type,))
    assert root.find(absent) is None
    assert len(root.findall("ModelExchange")) + len(root.findall("CoSimulation")) == 1


def test_every_unit_has_its_base_unit(description: ModelDescription) -> None:
    root = _root(description)
    units = {unit.get("name"): unit for unit in root.iterfind("UnitDefinitions/Unit")}
    assert set(units) == {v.unit for v in description.variables if v.unit}
    assert list(units) == sorted(units)
    assert dict(units["N"].find("BaseUnit").attrib) == {"kg": "1", "m": "1", "s": "-2"}
    millimetre = units["m"].find("DisplayUnit[@name='mm']")
    assert float(millimetre.get("factor")) == 1000.0


def test_a_display_unit_with_an_offset(description: ModelDescription) -> None:
    root = _root(_replaced(description, "E", unit="K", display_unit="degC"))
    display = root.find("UnitDefinitions/Unit[@name='K']/DisplayUnit[@name='degC']")
    assert (float(display.get("factor")), float(display.get("offset"))) == (1.0, -273.15)


def test_a_display_unit_equal_to_the_unit_says_nothing(description: ModelDescription) -> None:
    root = _root(_replaced(description, "F", display_unit="N"))
    assert root.find("ModelVariables/ScalarVariable[@name='F']/Real").get("displayUnit") is None


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"unit": "furlong"}, "variable 'E': 'furlong' is not a unit"),
        ({"display_unit": "furlong"}, "variable 'E': 'furlong' is not a unit"),
        ({"display_unit": "N"}, "variable 'E': 'N' cannot display values in 'J'"),
        ({"unit": "", "display_unit": "mJ"}, "variable 'E' has displayUnit 'mJ' but no unit"),
    ],
)
def test_a_wrong_unit_names_the_variable(
    description: ModelDescription, changes: dict[str, str], message: str
) -> None:
    with pytest.raises(ModelicaError, match=message):
        _xml(_replaced(description, "E", **changes))


def test_enumeration_type(description: ModelDescription) -> None:
    items = _root(description).findall("TypeDefinitions/SimpleType[@name='Test.Mode']/Enumeration/Item")
    assert [(i.get("name"), i.get("value"), i.get("description")) for i in items] == [
        ("Slow", "1", "Takes its time"),
        ("Fast", "2", None),
    ]


def test_two_enumerations_of_one_name_are_refused(description: ModelDescription) -> None:
    other = EnumerationType("Test.Mode", (("Other", ""),))
    variable = Variable("other", "Enumeration", "parameter", "fixed", "exact", 1, enumeration=other)
    with pytest.raises(BuildError, match=r"Test\.Mode"):
        _xml(replace(description, variables=(*description.variables, variable)))


def test_characters_that_xml_cannot_hold_become_spaces(description: ModelDescription) -> None:
    root = _root(replace(description, description="a\x07b\u00e4"))
    assert root.get("description") == "a b\u00e4"


def test_a_model_without_units_types_and_outputs(tmp_path: Path) -> None:
    variable = Variable("p", "Real", "parameter", "fixed", "exact", 1.0)
    description = ModelDescription("Test.Plain", "", (variable,), (), (), (), ())
    assert _problems(description, tmp_path) == []
    root = _root(description)
    assert root.find("UnitDefinitions") is None
    assert root.find("TypeDefinitions") is None
    assert len(root.find("ModelStructure")) == 0


def test_date_only_where_the_environment_sets_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    assert generation_time() is None
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    assert generation_time() == "1970-01-02T00:00:00Z"


@pytest.mark.parametrize("value", ["yesterday", "1e99", "9" * 30])
def test_a_malformed_date(monkeypatch: pytest.MonkeyPatch, value: str) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", value)
    with pytest.raises(BuildError, match=f"SOURCE_DATE_EPOCH is '{value}'"):
        generation_time()


def test_date_is_written_in_full(description: ModelDescription) -> None:
    root = _root(description, generation_time="2020-01-01T00:00:00Z")
    assert root.get("generationDateAndTime") == "2020-01-01T00:00:00Z"
    assert _root(description).get("generationDateAndTime") is None
