"""Reading and rejecting modelDescription.xml."""

from __future__ import annotations

import math
import re
import zipfile
from pathlib import Path

import fmpy
import pytest

from pyjoystick.fmu import Fmu, FmuFileError, UnsupportedFmuError, read_description
from pyjoystick.model import NOMINAL
from pyjoystick.motion import DisplayUnit
from pyjoystick.runs import value_of
from pyjoystick.support import ParameterError
from tests.pyjoystick.fmu.doctored import FMI_3, doctored, without_co_simulation


def test_the_joystick_describes_itself(joystick_path: Path) -> None:
    description = read_description(joystick_path)
    assert description.model_name == "PreloadedSprings.Joystick.Joystick"
    assert description.fmi_version == "2.0"
    assert description.interfaces == {"CoSimulation": "Joystick", "ModelExchange": "Joystick"}
    assert fmpy.platform in description.platforms
    assert description.has_sources
    assert description.experiment.tolerance == 1e-8
    assert description.names("input") == ("T",)
    assert description.names("output") == (
        *("theta", "omega", "alpha", "x", "f_x", "M_s", "M_d", "M_g", "C", "E"),
    )
    assert set(NOMINAL.to_names()) < set(description.settable_names())


def test_a_variable_has_unit_range_and_start(joystick_path: Path) -> None:
    theta = read_description(joystick_path).variables["theta_start"]
    assert (theta.unit, theta.causality, theta.type) == ("rad", "parameter", "Real")
    assert theta.display_unit == DisplayUnit("deg", pytest.approx(math.degrees(1.0)))
    mass = read_description(joystick_path).variables["m"]
    assert (mass.unit, mass.minimum, mass.maximum) == ("kg", 1e-60, None)
    assert mass.must_be_positive
    assert not read_description(joystick_path).variables["h"].must_be_positive
    assert float(mass.start or "nan") == NOMINAL.m


def test_attributes_of_the_declared_type_count_where_the_variable_has_none(
    joystick_path: Path, tmp_path: Path
) -> None:
    types = '<SimpleType name="Load"><Real unit="kg" min="0.5" max="2"/></SimpleType>'

    def with_type(text: str) -> str:
        text, changed = re.subn(
            r"<Real [^>]*start=\"0\.87\"[^>]*/>", '<Real declaredType="Load" start="0.87"/>', text
        )
        assert changed == 1
        assert "<TypeDefinitions>" not in text
        return text.replace(
            "</UnitDefinitions>", f"</UnitDefinitions><TypeDefinitions>{types}</TypeDefinitions>"
        )

    path = doctored(joystick_path, tmp_path / "typed.fmu", description=with_type)
    mass = read_description(path).variables["m"]
    assert (mass.unit, mass.minimum, mass.maximum) == ("kg", 0.5, 2.0)


def test_model_exchange_only_and_fmi_3_can_be_read(joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(joystick_path, tmp_path / "me.fmu", description=without_co_simulation)
    assert set(read_description(path).interfaces) == {"ModelExchange"}
    path = doctored(joystick_path, tmp_path / "3.fmu", description=lambda text: FMI_3)
    assert read_description(path).fmi_version == "3.0"


#: What the annotation of a tool may contain: names that mean something elsewhere.
_OF_A_TOOL = (
    '<CoSimulation providesAdjointDerivatives="true" modelIdentifier="no"/>'
    '<ModelVariables><Float64 name="a" valueReference="0"/><ScalarVariable/></ModelVariables>'
    '<curve name="a" valueReference="0"/><curve name="a" valueReference="0"/>'
    '<curve name="" valueReference="1"/>'
)


def _annotated(version: str, text: str) -> str:
    """The description with annotations at all places of its version of the standard."""
    if version == "3.0":
        note = f'<Annotations><Annotation type="t">{_OF_A_TOOL}</Annotation></Annotations>'
        text = text.replace('causality="independent"/>', f'causality="independent">{note}</Float64>')
        return text.replace('modelIdentifier="M"/>', f'modelIdentifier="M">{note}</CoSimulation>{note}')
    tool = f'<Tool name="t">{_OF_A_TOOL}</Tool>'
    text = text.replace("</ScalarVariable>", f"<Annotations>{tool}</Annotations></ScalarVariable>", 1)
    return text.replace(
        "<ModelVariables>", f"<VendorAnnotations>{tool}</VendorAnnotations><ModelVariables>", 1
    )


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_annotations_declare_nothing(version: str, joystick_path: Path, tmp_path: Path) -> None:
    plain = (
        FMI_3 if version == "3.0" else zipfile.ZipFile(joystick_path).read("modelDescription.xml").decode()
    )
    text = _annotated(version, plain)
    assert text.count(_OF_A_TOOL) == (3 if version == "3.0" else 2)
    found = [
        read_description(
            doctored(joystick_path, tmp_path / f"{name}.fmu", description=lambda _, text=text: text)
        )
        for name, text in (("plain", plain), ("annotated", text))
    ]
    assert found[0].variables == found[1].variables
    assert found[0].interfaces == found[1].interfaces
    assert [one.directional_derivatives for one in found] == [version == "2.0"] * 2
    assert not any(one.adjoint_derivatives for one in found)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ('<Float64 name="time" valueReference="1"/>', "two variables .* have the name 'time'"),
        (
            '<Float64 name="y" valueReference="1"><Alias name="time"/></Float64>',
            "two variables .* have the name 'time'",
        ),
        ('<Float64 valueReference="1"/>', "variable 2 in its modelDescription.xml has no name"),
        ('<Float64 name="x"/>', "variable 'x' .* has no valueReference"),
    ],
)
def test_variables_of_fmi_3_that_cannot_be_told_apart(
    more: str, message: str, joystick_path: Path, tmp_path: Path
) -> None:
    text = FMI_3.replace("</ModelVariables>", f"{more}</ModelVariables>")
    path = doctored(joystick_path, tmp_path / "odd.fmu", description=lambda _: text)
    with pytest.raises(FmuFileError, match=rf"odd\.fmu: {message}"):
        read_description(path)


@pytest.mark.parametrize(
    "attributes", ['inverse="true"', 'factor="2" inverse="1"', 'factor="0"', 'factor="INF"']
)
def test_display_units_that_no_factor_and_offset_convert(
    attributes: str, joystick_path: Path, tmp_path: Path
) -> None:
    shown = f'<DisplayUnit name="s" {attributes}/><DisplayUnit name="1/min" factor="60" inverse="false"/>'
    units = f'<UnitDefinitions><Unit name="1/s"><BaseUnit s="-1"/>{shown}</Unit></UnitDefinitions>'
    rates = "".join(
        f'<Float64 name="{name}" valueReference="{i}" causality="parameter" variability="fixed" start="1" '
        f'unit="1/s" displayUnit="{unit}"/>'
        for i, (name, unit) in enumerate({"k": "s", "n": "1/min"}.items(), start=1)
    )
    text = FMI_3.replace("<ModelVariables>", f"{units}<ModelVariables>{rates}")
    path = doctored(joystick_path, tmp_path / "3.fmu", description=lambda _: text)
    variables = read_description(path).variables
    assert variables["n"].display_unit == DisplayUnit("1/min", 60.0)
    assert variables["k"].display_unit is None
    with pytest.raises(
        ParameterError, match=r"k = \"0.25s\": must be a number in 1/s, or text with the unit 1/s"
    ):
        value_of(variables["k"], "0.25s")


def test_an_index_that_belongs_to_no_variable(joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(
        joystick_path,
        tmp_path / "wrong.fmu",
        description=lambda text: re.sub(r'<Unknown index="\d+"', '<Unknown index="9999"', text),
    )
    with pytest.raises(FmuFileError, match=r"wrong\.fmu: .*an index belongs to no variable"):
        read_description(path)


def test_a_file_that_is_no_archive(tmp_path: Path) -> None:
    path = tmp_path / "notes.fmu"
    path.write_text("not an FMU")
    with pytest.raises(FmuFileError, match=r"notes\.fmu: not an FMU: not a ZIP archive"):
        read_description(path)


def test_an_archive_without_a_model_description(tmp_path: Path) -> None:
    path = tmp_path / "archive.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "hello")
    with pytest.raises(FmuFileError, match=r"archive\.fmu: not an FMU: there is no modelDescription\.xml"):
        read_description(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<fmiModelDescription", r"its modelDescription\.xml cannot be read: \w+: ."),
        ("<html/>", r"its modelDescription\.xml names no FMI version in its element html"),
        ('<fmiModelDescription fmiVersion="2.0"><ModelVariables/>', "cannot be read: ExpatError: ."),
    ],
)
def test_a_broken_model_description(text: str, message: str, joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(joystick_path, tmp_path / "broken.fmu", description=lambda _: text)
    with pytest.raises(FmuFileError, match=rf"broken\.fmu: .*{message}"):
        read_description(path)


@pytest.mark.parametrize("version", ["1.0", "9.1", "2.1", "3.1", "3.1.2", "3.x"])
def test_another_fmi_version_is_named(version: str, joystick_path: Path, tmp_path: Path) -> None:
    text = f'<fmiModelDescription fmiVersion="{version}" modelName="M" modelIdentifier="M" guid="g"/>'
    path = doctored(joystick_path, tmp_path / "other.fmu", description=lambda _: text)
    message = rf"other\.fmu: is an FMU of FMI {version}; FMI 2\.0 and 3\.0 are supported"
    for read in (read_description, Fmu):
        with pytest.raises(UnsupportedFmuError, match=message):
            read(path)


def test_a_truncated_archive(joystick_path: Path, tmp_path: Path) -> None:
    path = tmp_path / "half.fmu"
    content = joystick_path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(FmuFileError, match=r"half\.fmu: not an FMU: not a ZIP archive"):
        read_description(path)


@pytest.mark.parametrize("start", ["abc", "0,011", "1_0"])
def test_a_start_value_that_is_no_number(start: str, joystick_path: Path, tmp_path: Path) -> None:
    def change(text: str) -> str:
        return re.sub(r'(name="damping.C".*?start=")[^"]*', rf"\g<1>{start}", text, count=1, flags=re.DOTALL)

    path = doctored(joystick_path, tmp_path / "bad.fmu", description=change)
    with pytest.raises(FmuFileError, match=rf"variable 'damping.C': start = '{start}': must be a number"):
        read_description(path)
