from __future__ import annotations

import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd

from pyjoystick.runs import Component, CouplingError, operator_and_joystick, read_ssp, run_coupled, write_ssp
from pyjoystick.support import InputFileError, OutputFileError

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
    assert root.get("version") == "2.0"
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
    write_ssp(new, path, version="1.0")
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
    """FMPy's schema and loop know SSP 1.0; its loop copies outputs once, after each step."""
    path = tmp_path / "joystick.ssp"
    write_ssp(operator_and_joystick(), path, version="1.0")
    assert read_ssd(str(path), validate=True).version == "1.0"
    rows = simulate_ssp(str(path), stop_time=1.2 - STEP / 2, step_size=STEP)
    run = run_coupled(operator_and_joystick(), step=STEP, scheme="delay", outputs=["joystick.theta"])
    np.testing.assert_allclose(rows["joystick.theta"], run["joystick.theta"].iloc[1:], rtol=0, atol=1e-12)


@pytest.mark.parametrize("step", [1e-3, 5e-3])
def test_ecos_gets_the_same_motion(step: float, tmp_path: Path, ecos: Callable[..., list[float]]) -> None:
    path = tmp_path / "joystick.ssp"
    write_ssp(operator_and_joystick(), path, version="1.0")
    run = run_coupled(operator_and_joystick(), step=step, scheme="delay", outputs=["joystick.theta"])
    theta = ecos(path, step, len(run) - 1, "joystick::theta")
    np.testing.assert_allclose(theta, run["joystick.theta"], rtol=0, atol=1e-12)


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
        (
            "<ssd:ParameterBinding>",
            '<ssd:ParameterBinding prefix="a.">',
            "parameters from a file, with a prefix",
        ),
        ('value="0.012"', 'value="heavy"', "parameter 'J': a value of Real 'heavy' is not supported"),
        ("ssv:Real", "ssv:Binary", "a value of Binary is not supported"),
        ("ssd:System>", "ssd:Nothing>", "cannot be read"),
    ],
)
def test_what_is_not_understood_is_named(
    archive: Path, tmp_path: Path, old: str, new: str, message: str
) -> None:
    changed = tmp_path / "changed.ssp"
    with zipfile.ZipFile(archive) as source, zipfile.ZipFile(changed, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name.endswith(".ssd"):
                assert old.encode() in content
                content = content.replace(old.encode(), new.encode())
            target.writestr(name, content)
    with pytest.raises(InputFileError, match=message):
        read_ssp(changed, tmp_path / "unpacked")


def test_nothing_is_left_where_it_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputFileError):
        write_ssp(operator_and_joystick(), tmp_path / "file" / "joystick.ssp")
