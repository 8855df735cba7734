"""FMUs packaged by other tools: what is checked, and what is added."""

from __future__ import annotations

import io
import re
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_build.packaging import package_fmu
from fmu_build.packaging.fmi2_units import add_unit_definitions
from fmu_build.packaging.foreign import check_request, place
from fmu_build.support.description import GeneratedModel
from fmu_build.support.errors import BuildError
from fmu_build.support.request import BuildRequest

pytestmark = pytest.mark.filterwarnings("default::DeprecationWarning:xmlschema")


@pytest.fixture(scope="module")
def made(generated: GeneratedModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU for Model Exchange alone, as another tool might leave it."""
    folder = tmp_path_factory.mktemp("made")
    return package_fmu(generated, BuildRequest("Test.Oscillator", folder, fmi_types=("me",))).path


@pytest.fixture
def request_(tmp_path: Path) -> BuildRequest:
    """A request for Model Exchange, with an old FMU in its place."""
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "Oscillator.fmu").write_bytes(b"old")
    return BuildRequest("Test.Oscillator", tmp_path / "out", fmi_types=("me",))


def _edited(fmu: Path, new: Path, pattern: str, replacement: str) -> Path:
    """A copy of an FMU with another modelDescription.xml."""
    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(new, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name == "modelDescription.xml":
                text, count = re.subn(pattern, replacement, content.decode(), flags=re.DOTALL)
                assert count > 0
                content = text.encode()
            target.writestr(name, content)
    return new


def test_a_sound_fmu_is_placed_as_it_is(made: Path, request_: BuildRequest) -> None:
    path, log = place(made, request_)
    assert path == request_.output / "Oscillator.fmu"
    assert path.read_bytes() == made.read_bytes()
    assert log == ""


def test_units_without_a_definition_get_one(made: Path, request_: BuildRequest, tmp_path: Path) -> None:
    bare = _edited(made, tmp_path / "Oscillator.fmu", "<UnitDefinitions>.*</UnitDefinitions>", "")
    path, log = place(bare, request_)
    assert log.startswith("unit definitions added to the FMU: J, N, N/m, kg, m, m/s, m/s2, s")
    with zipfile.ZipFile(path) as archive, zipfile.ZipFile(made) as original:
        assert sorted(archive.namelist()) == sorted(original.namelist())
        root = etree.fromstring(archive.read("modelDescription.xml"))
    tags = [child.tag for child in root]
    assert tags.index("UnitDefinitions") == tags.index("ModelExchange") + 1
    energy = root.find("UnitDefinitions/Unit[@name='J']/BaseUnit")
    assert energy is not None
    assert dict(energy.attrib) == {"kg": "1", "m": "2", "s": "-2"}


def test_a_unit_that_is_no_modelica_unit_is_defined_by_its_name() -> None:
    xml = (
        '<fmiModelDescription fmiVersion="2.0"><CoSimulation/>'
        '<UnitDefinitions><Unit name="m"/></UnitDefinitions>'
        '<ModelVariables><ScalarVariable><Real unit="m"/></ScalarVariable>'
        '<ScalarVariable><Real unit="furlong!"/></ScalarVariable></ModelVariables></fmiModelDescription>'
    )
    changed, added = add_unit_definitions(xml.encode())
    assert added == ["furlong!"]
    units = etree.fromstring(changed).findall("UnitDefinitions/Unit")
    assert [(unit.get("name"), len(unit)) for unit in units] == [("m", 0), ("furlong!", 0)]


@pytest.mark.parametrize("version", ["1.0", "3.0"])
def test_other_versions_stay_as_they_are(version: str) -> None:
    xml = f'<fmiModelDescription fmiVersion="{version}"/>'.encode()
    assert add_unit_definitions(xml) == (xml, [])


def test_a_type_that_is_missing(made: Path, request_: BuildRequest) -> None:
    _refused(made, replace(request_, fmi_types=("me", "cs")), "the FMU lacks the FMI type 'cs'")


def test_an_archive_that_was_not_finished(made: Path, request_: BuildRequest, tmp_path: Path) -> None:
    broken = tmp_path / "Oscillator.fmu"
    broken.write_bytes(made.read_bytes()[:-100])
    _refused(broken, request_, "is not a complete ZIP archive")


def test_a_damaged_archive(made: Path, request_: BuildRequest, tmp_path: Path) -> None:
    content = io.BytesIO()
    with zipfile.ZipFile(made) as source, zipfile.ZipFile(content, "w", zipfile.ZIP_STORED) as target:
        for name in source.namelist():
            target.writestr(name, source.read(name))
    damaged = tmp_path / "Oscillator.fmu"
    damaged.write_bytes(content.getvalue().replace(b"A mass on a spring", b"a mass on a spring", 1))
    _refused(damaged, request_, "the archive was damaged while it was written: .* has a wrong checksum")


@pytest.mark.parametrize("content", [None, "<fmiModelDescription"])
def test_no_description(request_: BuildRequest, tmp_path: Path, content: str | None) -> None:
    with zipfile.ZipFile(tmp_path / "Oscillator.fmu", "w") as archive:
        archive.writestr("other.txt", "")
        if content is not None:
            archive.writestr("modelDescription.xml", content)
    _refused(tmp_path / "Oscillator.fmu", request_, r"has no readable modelDescription\.xml")


def test_an_fmu_that_does_not_load(made: Path, request_: BuildRequest, tmp_path: Path) -> None:
    other = _edited(made, tmp_path / "Oscillator.fmu", 'guid="[^"]*"', 'guid="{another}"')
    _refused(other, request_, "the FMU does not load on this machine")


def test_what_the_validation_finds_is_told_only(made: Path, request_: BuildRequest, tmp_path: Path) -> None:
    faulty = _edited(made, tmp_path / "Oscillator.fmu", "<InitialUnknowns>.*</InitialUnknowns>", "")
    assert validate_fmu(str(faulty))
    path, log = place(faulty, request_)
    assert "FMPy's validation: ModelStructure/InitialUnknowns" in log
    assert read_model_description(str(path), validate=False).modelName == "Test.Oscillator"


def _refused(fmu: Path, request: BuildRequest, message: str) -> None:
    with pytest.raises(BuildError, match=message):
        place(fmu, request)
    folder = request.output
    assert [(file.name, file.read_bytes()) for file in folder.iterdir()] == [("Oscillator.fmu", b"old")]


def test_a_tool_that_builds_no_webassembly_module_is_not_asked_for_one(tmp_path: Path) -> None:
    request = BuildRequest("Test.Oscillator", tmp_path, platforms=("wasm32",))
    with pytest.raises(BuildError, match=r"Other builds only for this machine.*, not for wasm32"):
        check_request(request, "Other")
