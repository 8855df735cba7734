"""This project's FMUs against the standards' own checks and two independent checkers."""

from __future__ import annotations

import io
import logging
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from fmu_manipulation_toolbox.checker import OperationGenericCheck, OperationSemanticCheck
from fmu_manipulation_toolbox.operations import FMU
from lxml import etree

from pyjoystick.fmu import MODELS

_SCHEMAS = Path(fmpy.__file__).parent / "schema"
# File in the archive -> schema of the standard, by version.
_FILES = {
    "2": {"modelDescription.xml": "fmi2ModelDescription.xsd"},
    "3": {
        "modelDescription.xml": "fmi3ModelDescription.xsd",
        "terminalsAndIcons/terminalsAndIcons.xml": "fmi3TerminalsAndIcons.xsd",
        "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
    },
}


@pytest.fixture(scope="module", params=["2", "3"])
def version(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def folder(version: str, joystick_fmus: Path, request: pytest.FixtureRequest) -> Path:
    """The folder of that version's FMUs."""
    fmus: Path = joystick_fmus if version == "2" else request.getfixturevalue("joystick_fmus3")
    return fmus


@pytest.mark.parametrize("name", MODELS)
def test_the_standards_schemas(folder: Path, version: str, name: str) -> None:
    with zipfile.ZipFile(folder / f"{name}.fmu") as archive:
        for file, schema_name in _FILES[version].items():
            schema = etree.XMLSchema(etree.parse(_SCHEMAS / f"fmi{version}" / schema_name))
            document = etree.parse(io.BytesIO(archive.read(file)))
            schema.validate(document)
            assert [str(error) for error in schema.error_log] == []


@pytest.mark.parametrize("name", MODELS)
def test_fmpy_has_no_finding(folder: Path, name: str) -> None:
    assert validate_fmu(str(folder / f"{name}.fmu")) == []


@pytest.mark.parametrize("name", MODELS)
def test_fmutool_has_no_finding(
    folder: Path, version: str, name: str, caplog: pytest.LogCaptureFixture
) -> None:
    generic, semantic = OperationGenericCheck(), OperationSemanticCheck()
    with caplog.at_level(logging.WARNING):
        opened = FMU(str(folder / f"{name}.fmu"))
        opened.apply_operation(generic)
        opened.apply_operation(semantic)
    assert generic.compliant_with_version == f"{version}.0"
    assert semantic.errors == []
    assert caplog.records == []
