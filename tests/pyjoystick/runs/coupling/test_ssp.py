from __future__ import annotations

import re
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd, validate_tree
from lxml import etree

from pyjoystick.runs import (
    Component,
    CoupledSystem,
    CouplingError,
    operator_and_joystick,
    read_ssp,
    run_coupled,
    write_ssp,
)
from pyjoystick.runs.coupling.parameter_sets import ParameterNote
from pyjoystick.runs.coupling.ssp import SspVersion, structure_xml
from pyjoystick.support import InputFileError, OutputFileError, ParameterError
from tests.pyjoystick.runs.coupling.conftest import Ecos

pytestmark = pytest.mark.usefixtures("fmus_by_name")

STEP = 5e-3
FMUS = ["resources/Joystick.fmu", "resources/Operator.fmu"]
PARAMETERS = {"operator": {"handArm.K": 30.0, "move.pause": 0.1}, "joystick": {"J": 0.012, "damping.C": 0.06}}


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    path = tmp_path / "joystick.ssp"
    write_ssp(operator_and_joystick(**PARAMETERS), path)
    return path


def test_what_is_written_is_read_back(archive: Path, tmp_path: Path) -> None:
    system = operator_and_joystick(**PARAMETERS)
    found = read_ssp(archive, tmp_path / "unpacked")
    assert (found.name, found.description, found.stop_time) == (
        system.name,
        system.description,
        system.stop_time,
    )
    assert found.connections == system.connections
    for mine, its in zip(system.components, found.components, strict=True):
        assert (its.name, dict(its.parameters)) == (mine.name, dict(mine.parameters))
        assert Path(its.fmu).is_file()
    run, again = (run_coupled(one, step=STEP) for one in (system, found))
    pd.testing.assert_frame_equal(run, again, check_exact=True)


def test_two_archives_of_one_system_are_the_same_bytes(archive: Path, tmp_path: Path) -> None:
    write_ssp(operator_and_joystick(**PARAMETERS), tmp_path / "again.ssp")
    assert (tmp_path / "again.ssp").read_bytes() == archive.read_bytes()


def test_version_and_units(archive: Path) -> None:
    with zipfile.ZipFile(archive) as file:
        root = ElementTree.fromstring(file.read("SystemStructure.ssd"))
        assert sorted(file.namelist()) == [
            "SystemStructure.ssd",
            "resources/Joystick.fmu",
            "resources/Operator.fmu",
        ]
    assert root.get("version") == "1.0"
    common = "{http://ssp-standard.org/SSP1/SystemStructureCommon}"
    units = {unit.get("name"): unit.find(f"{common}BaseUnit") for unit in root.iter(f"{common}Unit")}
    assert units["N.m"] is not None
    assert units["N.m"].attrib == {"kg": "1", "m": "2", "s": "-2"}
    used = {element.get("unit") for element in root.iter(f"{common}Real")}
    assert used <= set(units)


def test_fmus_of_fmi_3_in_an_archive(joystick_fmus3: Path, tmp_path: Path) -> None:
    system = operator_and_joystick(**PARAMETERS)
    components = tuple(replace(one, fmu=joystick_fmus3 / f"{one.fmu}.fmu") for one in system.components)
    new = replace(system, components=components)
    path = tmp_path / "joystick.ssp"
    write_ssp(new, path)
    assert read_ssd(str(path), validate=True).version == "1.0"
    found = read_ssp(path, tmp_path / "unpacked")
    runs = [run_coupled(one, step=STEP) for one in (system, new, found)]
    pd.testing.assert_frame_equal(runs[0], runs[1], check_exact=True)
    pd.testing.assert_frame_equal(runs[0], runs[2], check_exact=True)


def test_two_fmus_of_one_file_name_are_refused(joystick_fmus3: Path, tmp_path: Path) -> None:
    system = operator_and_joystick()
    mixed = replace(
        system, components=(*system.components, Component("new", joystick_fmus3 / "Joystick.fmu"))
    )
    with pytest.raises(CouplingError, match=r"new: another FMU of the system is called Joystick\.fmu too"):
        write_ssp(mixed, tmp_path / "joystick.ssp")


def test_fmpy_finds_the_structure_valid_and_gets_the_same_motion(tmp_path: Path) -> None:
    """FMPy's loop copies outputs once, after each step."""
    path = tmp_path / "joystick.ssp"
    write_ssp(operator_and_joystick(), path)
    assert read_ssd(str(path), validate=True).version == "1.0"
    rows = simulate_ssp(str(path), stop_time=1.2 - STEP / 2, step_size=STEP)
    run = run_coupled(operator_and_joystick(), step=STEP, scheme="delay", outputs=["joystick.theta"])
    np.testing.assert_allclose(rows["joystick.theta"], run["joystick.theta"].iloc[1:], rtol=0, atol=1e-12)


@pytest.mark.parametrize("step", [1e-3, 5e-3])
def test_ecos_gets_the_same_motion(step: float, tmp_path: Path, ecos: Ecos) -> None:
    path = tmp_path / "joystick.ssp"
    system = operator_and_joystick(**PARAMETERS)
    write_ssp(system, path)
    run = run_coupled(system, step=step, scheme="delay", outputs=["joystick.theta"])
    theta = ecos(path, step, len(run) - 1, "joystick::theta")
    np.testing.assert_allclose(theta, run["joystick.theta"], rtol=0, atol=1e-12)


@pytest.fixture
def released(tmp_path: Path, joystick_fmus: Path) -> Path:
    """One component, and nothing to connect it to."""
    joystick = Component("joystick", joystick_fmus / "Joystick.fmu", {"theta_start": 0.3})
    write_ssp(CoupledSystem("released", (joystick,), (), 0.1), tmp_path / "released.ssp")
    return tmp_path / "released.ssp"


def test_a_system_without_connections_runs_in_every_master(released: Path, ecos: Ecos) -> None:
    """FMPy is handed the values of the archive, which it leaves aside."""
    top = read_ssd(str(released), validate=True).system
    ((values,),) = [binding.parameterValues for binding in top.elements[0].parameterBindings]
    for parameter in values.parameters:
        parameter.name = f"joystick.{parameter.name}"
    system = read_ssp(released, released.parent / "unpacked")
    run = run_coupled(system, step=STEP, outputs=["joystick.theta"])["joystick.theta"]
    assert run.iloc[-1] < run.iloc[0] == 0.3
    rows = simulate_ssp(str(released), stop_time=0.1 - STEP / 2, step_size=STEP, parameter_set=values)
    np.testing.assert_allclose(rows["joystick.theta"], run.iloc[1:], rtol=0, atol=1e-12)
    theta = ecos(released, STEP, len(run) - 1, "joystick::theta")
    np.testing.assert_allclose(theta, run, rtol=0, atol=1e-12)


@pytest.mark.parametrize("components", [0, 1])
@pytest.mark.parametrize("version", ["1.0", "2.0"])
def test_the_schema_holds_whatever_a_system_lacks(version: SspVersion, components: int, empty: Path) -> None:
    """FMPy's schema is that of 1.0, from which 2.0 differs here by its number alone."""
    system = CoupledSystem("poor", (Component("one", empty),) * components, (), 1.0)
    root = etree.fromstring(structure_xml(system, version))
    assert root.get("version") == version
    root.set("version", "1.0")
    validate_tree(root, "SystemStructureDescription.xsd")


@pytest.fixture
def empty(tmp_path: Path) -> Path:
    """An FMU without inputs, outputs and units."""
    description = """<fmiModelDescription fmiVersion="2.0" modelName="Empty" guid="{0}">
      <CoSimulation modelIdentifier="Empty"/><ModelVariables/><ModelStructure/></fmiModelDescription>"""
    with zipfile.ZipFile(tmp_path / "Empty.fmu", "w") as file:
        file.writestr("modelDescription.xml", description)
    return tmp_path / "Empty.fmu"


def test_omsimulator_is_told_how_to_run_the_system(archive: Path) -> None:
    """It compares names with these prefixes, and aborts where it does not find the master."""
    with zipfile.ZipFile(archive) as file:
        text = file.read("SystemStructure.ssd").decode()
    expected = (
        r'<ssd:Annotations>\s*<ssc:Annotation type="org\.openmodelica">\s*<oms:Annotations>'
        r"\s*<oms:SimulationInformation>"
        r'\s*<oms:FixedStepMaster description="oms-ma" stepSize="0\.001" absoluteTolerance="1e-08"'
    )
    assert re.search(expected, text)


def test_a_file_that_is_no_archive(tmp_path: Path) -> None:
    path = tmp_path / "joystick.ssp"
    path.write_text("no archive")
    with pytest.raises(InputFileError, match="not an SSP archive"):
        read_ssp(path, tmp_path)
    with pytest.raises(InputFileError, match="not an SSP archive"):
        read_ssp(tmp_path / "missing.ssp", tmp_path)
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("other.txt", "")
    with pytest.raises(InputFileError, match=r"not a whole SSP archive: .*SystemStructure\.ssd"):
        read_ssp(path, tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<ssd:Connections>", "<ssd:Connections", "SystemStructure.ssd cannot be read"),
        ("resources/Joystick.fmu", "../Joystick.fmu", "is not an FMU in the archive"),
        ("resources/Joystick.fmu", "https://example.org/Joystick.fmu", "is not an FMU in the archive"),
        ("resources/Joystick.fmu", "resources/Stick.fmu", r"not a whole SSP archive: .*Stick\.fmu"),
        ('type="application/x-fmu-sharedlibrary"', 'type="application/x-ssp-package"', "is not an FMU"),
        ('startElement="joystick"', "", "only those between components"),
        ("<ssd:ParameterBinding>", '<ssd:ParameterBinding prefix="a.">', "parameters with a prefix"),
        (
            "<ssd:ParameterBinding>",
            "<ssd:ParameterBinding /><ssd:ParameterBinding>",
            "a ParameterBinding has neither a source nor values",
        ),
        ("<ssd:ParameterBinding>", '<ssd:ParameterBinding source="../a.ssv">', "no .ssv file of the archive"),
        (
            "<ssd:ParameterBinding>",
            '<ssd:ParameterBinding source="resources/a.ssv">',
            r"not a whole SSP archive: .*a\.ssv",
        ),
        ('value="0.012"', 'value="heavy"', "parameter 'J': a value of Real 'heavy' is not supported"),
        ('value="0.012"', 'value="0_012"', "parameter 'J': a value of Real '0_012' is not supported"),
        (
            '<ssv:Parameter name="J">',
            '<ssv:Parameter name="J"><ssv:Real value="1.0" /></ssv:Parameter><ssv:Parameter name="J">',
            "component 'joystick': has two values for parameter 'J'",
        ),
        (
            '<ssv:Parameter name="J">',
            '<ssv:Parameter name="J"><ssv:Real value="1.0" />',
            "ssv:Parameter 'J': has 2 of ssv:Real, may have one",
        ),
        (
            "SystemStructureParameterValues",
            "SystemStructureParameterValuez",
            "ssd:ParameterValues: an element 'ParameterSet' of the unknown namespace 'http.*Valuez'",
        ),
        ("<ssd:Connection ", "<ssd:Conneation ", "Connections: an element ssd:Conneation does not belong"),
        (
            "<ssd:Connection ",
            "<ssc:Connection ",
            "Connections: an element ssc:Connection does not belong",
        ),
        (
            '<ssd:Connection startElement="joystick"',
            '<ssd:Connection><ssc:LinearTransform factor="57.3" /></ssd:Connection><ssd:Connection '
            'startElement="joystick"',
            "ssd:Connection: an element ssc:LinearTransform does not belong there",
        ),
        (
            '<ssv:Parameter name="J">',
            '<ssv:Parameter name="m"><ssv:Real value="1.0" /><ssv:Parameter name="h"><ssv:Real value="5.0" />'
            '</ssv:Parameter></ssv:Parameter><ssv:Parameter name="J">',
            "ssv:Parameter 'm': an element ssv:Parameter does not belong there",
        ),
        (
            "<ssd:Elements>",
            '<ssd:DefaultExperiment stopTime="1.2" /><ssd:Elements>',
            "ssd:System '.*': an element ssd:DefaultExperiment does not belong there",
        ),
        (
            '<ssv:Parameter name="J">',
            '<ssv:Parameter name="J"><ssc:Dimension size="3" />',
            "parameter 'J': an array is not supported",
        ),
        (
            "<ssd:DefaultExperiment",
            ">ssd:DefaultExperiment",
            "has the text '>ssd:DefaultExperiment .* may have no",
        ),
        (
            "<ssd:DefaultExperiment",
            '<ssd:DefaultExperiment stopTime="1.3" /><ssd:DefaultExperiment',
            "has 2 of ssd:DefaultExperiment, may have one",
        ),
        ("<ssd:DefaultExperiment", "<ssd:DefaultExperimelt", "an element ssd:DefaultExperimelt does not"),
        ('stopTime="1.2"', 'svopTime="1.2"', "DefaultExperiment: 'svopTime' is not one of its attributes"),
        ("ssv:Real", "ssv:Binary", "a value of Binary is not supported"),
        ("ssd:System>", "ssd:Nothing>", "cannot be read"),
        ('startTime="0.0"', 'startTime="0.5"', r"DefaultExperiment: startTime = '0\.5': must be 0 s"),
        ('startTime="0.0"', 'startTime="now"', r"DefaultExperiment: startTime = 'now': must be 0 s"),
        (
            'unit="kg.m2" value="0.012"',
            'unit="g.m2" value="12"',
            r"component 'joystick': J is in 'g\.m2'; must be in 'kg\.m2', as in Joystick\.fmu",
        ),
        (
            '<ssd:Connector name="theta" kind="output">\n            <ssc:Real unit="rad"',
            '<ssd:Connector name="theta" kind="output">\n            <ssc:Real unit="deg"',
            r"component 'joystick': theta is in 'deg'; must be in 'rad', as in Joystick\.fmu",
        ),
        (
            'stopTime="1.2"',
            'stopTime="soon"',
            r"DefaultExperiment: stopTime = 'soon': must be a finite number above",
        ),
        (
            'stopTime="1.2"',
            'stopTime="1_0"',
            r"DefaultExperiment: stopTime = '1_0': must be a finite number above",
        ),
        (
            'stopTime="1.2"',
            'stopTime="-1"',
            r"DefaultExperiment: stopTime = '-1': must be a finite number above",
        ),
        ("encoding='UTF-8'", "encoding='none'", "cannot be read: unknown encoding"),
    ],
)
def test_what_is_not_understood_is_named(
    archive: Path, tmp_path: Path, old: str, new: str, message: str
) -> None:
    changed = with_change(archive, "SystemStructure.ssd", old, new)
    with pytest.raises(InputFileError, match=message):
        read_ssp(changed, tmp_path / "unpacked")


def with_change(archive: Path, file: str, old: str, new: str) -> Path:
    """A copy of an archive with another text in one of its files."""
    changed = archive.with_name("changed.ssp")
    with zipfile.ZipFile(archive) as source, zipfile.ZipFile(changed, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name == file:
                assert old.encode() in content
                content = content.replace(old.encode(), new.encode())
            target.writestr(name, content)
    return changed


def test_another_unit_in_a_file_of_values_is_named(tmp_path: Path) -> None:
    path = tmp_path / "joystick.ssp"
    notes = {"joystick": {"J": ParameterNote(None, "swing")}}
    write_ssp(operator_and_joystick(**PARAMETERS), path, notes=notes)
    changed = with_change(path, "resources/joystick.ssv", 'unit="kg.m2" value', 'unit="g.m2" value')
    with pytest.raises(InputFileError, match=r"J is in 'g\.m2'; must be in 'kg\.m2'"):
        read_ssp(changed, tmp_path / "unpacked")
    without = with_change(path, "resources/joystick.ssv", ' unit="kg.m2" value', " value")
    assert (
        read_ssp(without, tmp_path / "unpacked").components
        == read_ssp(path, tmp_path / "unpacked").components
    )


def test_a_bomb_is_refused_before_it_is_unpacked(archive: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pyjoystick.runs.coupling.ssp._LARGEST", 100_000)
    with pytest.raises(InputFileError, match=r"declares \S+ GB; at most 0\.0001 GB are unpacked"):
        read_ssp(archive, archive.parent / "unpacked")


def test_a_run_without_end_is_refused() -> None:
    with pytest.raises(
        ParameterError, match=r"step = 0\.001: must be 1e\+301 s or more for a run of 1e\+308 s"
    ):
        run_coupled(operator_and_joystick(), step=1e-3, duration=1e308)


def test_nothing_is_left_where_it_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputFileError):
        write_ssp(operator_and_joystick(), tmp_path / "file" / "joystick.ssp")
