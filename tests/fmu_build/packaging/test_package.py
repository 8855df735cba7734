"""Packaging a complete FMU from a hand-written model, and everything that can prevent it."""

from __future__ import annotations

import logging
import re
import tempfile
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu, supported_platforms
from fmpy.validation import validate_fmu
from fmu_manipulation_toolbox.checker import OperationGenericCheck, OperationSemanticCheck
from fmu_manipulation_toolbox.operations import FMU

from fmu_build.packaging import binaries, package_fmu, wasm_module
from fmu_build.packaging.binaries import compile_library
from fmu_build.packaging.platforms import PLATFORMS
from fmu_build.support.cache import Store
from fmu_build.support.description import GeneratedModel
from fmu_build.support.errors import BuildError, ModelicaError, ToolchainError
from fmu_build.support.request import BuildRequest

pytestmark = pytest.mark.filterwarnings("default::DeprecationWarning:xmlschema")


@pytest.fixture(scope="module")
def fmu(generated: GeneratedModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The oscillator's FMU; tests only read it."""
    return package_fmu(generated, BuildRequest("Test.Oscillator", tmp_path_factory.mktemp("fmu"))).path


def test_contents(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
        token = archive.read("sources/token.h").decode()
        xml = archive.read("modelDescription.xml").decode()
    assert fmu.name == "Oscillator.fmu"
    assert {
        "modelDescription.xml",
        "model.png",
        "documentation/index.html",
        "documentation/licenses/license.txt",
        "sources/model.c",
        "sources/model.h",
        "sources/token.h",
        "sources/fmi2Functions.h",
    } <= set(names)
    assert [name for name in names if name.startswith("binaries/")] == ["binaries/linux64/Oscillator.so"]
    guid = re.search(r'guid="([^"]+)"', xml)
    assert guid is not None
    assert f'"{guid[1]}"' in token


def test_no_tool_has_a_finding(fmu: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert validate_fmu(str(fmu)) == []
    assert supported_platforms(str(fmu)) == ["c-code", "linux64"]
    semantic = OperationSemanticCheck()
    with caplog.at_level(logging.WARNING):
        opened = FMU(str(fmu))
        generic = OperationGenericCheck()
        opened.apply_operation(generic)
        opened.apply_operation(semantic)
    assert generic.compliant_with_version == "2.0"
    assert semantic.errors == []
    assert caplog.records == []


def test_sources_alone_rebuild_the_library(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as archive:
        files = {
            n.removeprefix("sources/"): archive.read(n)
            for n in archive.namelist()
            if n.startswith("sources/")
        }
        library = archive.read("binaries/linux64/Oscillator.so")
    assert compile_library(files, "Oscillator", PLATFORMS["x86_64-linux"])[0] == library


@pytest.mark.parametrize("fmi_type", ["ModelExchange", "CoSimulation"])
def test_it_runs(fmu: Path, fmi_type: str) -> None:
    result = simulate_fmu(
        str(fmu),
        stop_time=3.0,
        output_interval=0.1,
        fmi_type=fmi_type,
        relative_tolerance=1e-8,
        output=["x", "E"],
    )
    assert len(result) == 31
    np.testing.assert_allclose(result["x"], 0.1 * np.cos(2.0 * result["time"]), rtol=0, atol=1e-6)
    np.testing.assert_allclose(result["E"], 0.02, rtol=1e-5)


def test_the_same_model_gives_the_same_bytes(
    generated: GeneratedModel, request_in: BuildRequest, fmu: Path
) -> None:
    assert package_fmu(generated, request_in).path.read_bytes() == fmu.read_bytes()


def test_the_date_changes_the_date_alone(
    generated: GeneratedModel, request_in: BuildRequest, fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    dated = package_fmu(generated, request_in).path
    with zipfile.ZipFile(fmu) as before, zipfile.ZipFile(dated) as after:
        assert before.namelist() == after.namelist()
        changed = [name for name in before.namelist() if before.read(name) != after.read(name)]
        xml = after.read("modelDescription.xml").decode()
    assert changed == ["modelDescription.xml"]
    assert 'generationDateAndTime="2023-11-14T22:13:20Z"' in xml


def test_another_description_has_another_guid(
    generated: GeneratedModel, request_in: BuildRequest, fmu: Path
) -> None:
    changed = replace(generated, description=replace(generated.description, description="Another"))
    with zipfile.ZipFile(fmu) as before, zipfile.ZipFile(package_fmu(changed, request_in).path) as after:
        assert before.read("sources/token.h") != after.read("sources/token.h")


def test_stages_are_told(generated: GeneratedModel, request_in: BuildRequest) -> None:
    stages: list[str] = []
    package_fmu(generated, replace(request_in, on_stage=stages.append))
    assert stages == [
        "compiling the C code for x86_64-linux",
        "running the default experiment",
        "packing and checking the FMU",
    ]


def test_an_fmu_for_another_machine_is_documented_by_a_run_on_this_one(
    generated: GeneratedModel, request_in: BuildRequest
) -> None:
    made = package_fmu(generated, replace(request_in, platforms=("win64",)))
    with zipfile.ZipFile(made.path) as archive:
        names = archive.namelist()
        licenses = archive.read("documentation/licenses/license.txt").decode()
    assert [name for name in names if name.startswith("binaries/")] == ["binaries/win64/Oscillator.dll"]
    assert "documentation/default_run.svg" in names
    assert "mingw-w64" in licenses
    assert "validated but not loaded" in made.log


def test_a_webassembly_module_lies_beside_the_library(
    fmu: Path, generated: GeneratedModel, request_in: BuildRequest
) -> None:
    made = package_fmu(generated, replace(request_in, platforms=("wasm32",))).path
    module = "extra/org.pyjoystick/wasm32/Oscillator.wasm"
    licenses = "documentation/licenses/license.txt"
    with zipfile.ZipFile(fmu) as plain, zipfile.ZipFile(made) as archive:
        assert set(archive.namelist()) - set(plain.namelist()) == {module}
        assert archive.read(module) == wasm_module(made) == wasm_module(fmu)
        assert {n for n in plain.namelist() if plain.read(n) != archive.read(n)} == {licenses}


def test_a_module_is_compiled_once_for_all_pages(
    fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Store, "folder", lambda store: tmp_path / store.name)
    module = wasm_module(fmu)
    monkeypatch.setattr(binaries, "_compiled", lambda *_: pytest.fail("compiled again"))
    assert wasm_module(fmu) == module


@pytest.mark.parametrize("identifier", ["../out", "/tmp/out", "a b", "-o"])
def test_a_stranger_s_identifier_becomes_no_path(fmu: Path, tmp_path: Path, identifier: str) -> None:
    other = tmp_path / "other.fmu"
    with zipfile.ZipFile(fmu) as plain, zipfile.ZipFile(other, "w") as archive:
        for name in plain.namelist():
            content = plain.read(name)
            if name == "modelDescription.xml":
                content = content.replace(
                    b'modelIdentifier="Oscillator"', f'modelIdentifier="{identifier}"'.encode()
                )
            archive.writestr(name, content)
    with pytest.raises(BuildError, match="is no identifier of C"):
        wasm_module(other)


def test_a_stranger_s_source_is_no_option_of_the_compiler(fmu: Path, tmp_path: Path) -> None:
    """Zig reads what follows an @ as a file of options, and a name that begins with - as one."""
    other = tmp_path / "other.fmu"
    with zipfile.ZipFile(fmu) as plain, zipfile.ZipFile(other, "w") as archive:
        for name in plain.namelist():
            archive.writestr(name, plain.read(name))
        archive.writestr("sources/@args.c", "#error compiled")
        archive.writestr("sources/-save-temps.c", "#error compiled")
    assert wasm_module(other) == wasm_module(fmu)


def test_a_default_experiment_that_fails_is_told_and_left_out(
    generated: GeneratedModel, request_in: BuildRequest
) -> None:
    made = package_fmu(_source_with(generated, "der[V] = (p[F]", "der[V] = 0.0 / 0.0 + (p[F]"), request_in)
    with zipfile.ZipFile(made.path) as archive:
        names = archive.namelist()
        page = archive.read("documentation/index.html").decode()
    assert [name for name in names if name.startswith("extra/") or name.endswith(".svg")] == []
    assert "There is no figure: " in page
    assert "default experiment: " in made.log


def _source_with(generated: GeneratedModel, old: str, new: str) -> GeneratedModel:
    assert old in generated.c_source
    return replace(generated, c_source=generated.c_source.replace(old, new))


def test_wrong_c_code_leaves_nothing(
    generated: GeneratedModel, request_in: BuildRequest, tmp_path: Path
) -> None:
    with pytest.raises(ToolchainError, match=r"model\.c:\d+:\d+: error: "):
        package_fmu(_source_with(generated, "return true;", "return nothing;"), request_in)
    assert list(tmp_path.iterdir()) == []


def test_a_library_that_kills_the_process_leaves_nothing(
    generated: GeneratedModel, request_in: BuildRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    deadly = replace(
        generated,
        c_source=generated.c_source
        + "\n#include <stdlib.h>\n__attribute__((constructor)) static void die(void) { abort(); }\n",
    )
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    with pytest.raises(BuildError, match="does not load on this machine: its process was killed by SIGABRT"):
        package_fmu(deadly, request_in)
    assert list(temporary.iterdir()) == []
    assert list(tmp_path.iterdir()) == [temporary]


def test_a_library_with_another_guid_leaves_nothing(
    generated: GeneratedModel, request_in: BuildRequest, tmp_path: Path
) -> None:
    with pytest.raises(BuildError, match="does not load on this machine: exit code 1"):
        package_fmu(_source_with(generated, ".token = MODEL_TOKEN", '.token = "{0}"'), request_in)
    assert list(tmp_path.iterdir()) == []


def test_a_description_that_breaks_the_standard_keeps_the_old_file(
    generated: GeneratedModel, request_in: BuildRequest
) -> None:
    request_in.output.mkdir()
    old = request_in.output / "Oscillator.fmu"
    old.write_bytes(b"old")
    description = replace(generated.description, outputs=generated.description.outputs[:1])
    with pytest.raises(BuildError, match=r"(?s)internal error: the FMU is not valid:.*Outputs"):
        package_fmu(replace(generated, description=description), request_in)
    assert [path.name for path in request_in.output.iterdir()] == ["Oscillator.fmu"]
    assert old.read_bytes() == b"old"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"fmi_version": "4.0"}, "unknown FMI version '4.0'; use '2.0' or '3.0'"),
        ({"fmi_types": ()}, "FMI types .*use 'me', 'cs' or both"),
        ({"fmi_types": ("me", "se")}, "FMI types .*use 'me', 'cs' or both"),
        ({"platforms": ("vax",)}, "unknown platform 'vax'"),
        ({"platforms": ("wasm32",), "fmi_version": "3.0"}, "platform 'wasm32' needs FMI 2.0, not 3.0"),
    ],
)
def test_requests_that_cannot_be_met(
    generated: GeneratedModel, request_in: BuildRequest, changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(BuildError, match=message):
        package_fmu(generated, replace(request_in, **changes))


def test_a_wrong_unit_is_told_before_anything_is_compiled(
    generated: GeneratedModel, request_in: BuildRequest
) -> None:
    stages: list[str] = []
    variables = tuple(replace(v, unit="lbf") if v.name == "F" else v for v in generated.description.variables)
    wrong = replace(generated, description=replace(generated.description, variables=variables))
    with pytest.raises(ModelicaError, match="variable 'F': 'lbf' is not a unit"):
        package_fmu(wrong, replace(request_in, on_stage=stages.append))
    assert stages == []
