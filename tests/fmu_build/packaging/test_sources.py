"""The sources/ folder: its files, the content GUID, the token header and buildDescription.xml."""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path

import pytest
from lxml import etree

from fmu_build.packaging import sources
from fmu_build.packaging.sources import (
    build_description_xml,
    c_files,
    collect_sources,
    content_guid,
    token_header,
)
from fmu_build.support.errors import BuildError

_FLAGS = ("-O2", "-s")
_FILES = {"a.c": b"int a;", "b.h": b""}
_GUID = content_guid(b"<xml/>", _FILES, _FLAGS)


def test_form_of_the_guid() -> None:
    assert re.fullmatch(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", _GUID)


def test_the_guid_does_not_depend_on_order() -> None:
    assert content_guid(b"<xml/>", dict(reversed(_FILES.items())), _FLAGS) == _GUID


@pytest.mark.parametrize(
    ("xml", "files", "flags"),
    [
        (b"<xml />", _FILES, _FLAGS),
        (b"<xml/>", _FILES | {"a.c": b"int b;"}, _FLAGS),
        (b"<xml/>", {"a2.c": b"int a;", "b.h": b""}, _FLAGS),
        (b"<xml/>", {"a.c": b"", "b.h": b"int a;"}, _FLAGS),
        (b"<xml/>", {"a.c": b"int a;"}, _FLAGS),
        (b"<xml/>", _FILES, ("-O2",)),
        (b"<xml/>", _FILES, ("-O2-s",)),
    ],
)
def test_other_content_has_another_guid(xml: bytes, files: dict[str, bytes], flags: tuple[str, ...]) -> None:
    assert content_guid(xml, files, flags) != _GUID


def test_token_header() -> None:
    assert f'#define MODEL_TOKEN "{_GUID}"\n' in token_header(_GUID).decode()


def test_sources_are_complete() -> None:
    files = collect_sources("int model;", "2.0")
    assert files["model.c"] == b"int model;"
    assert {"model.h", *sources.FMI_HEADERS["2.0"]} <= set(files)
    assert list(files) == sorted(files)
    assert "model.c" in c_files(files)
    assert all(name.endswith((".c", ".h")) for name in files)


def test_a_missing_header_says_where_it_comes_from(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sources, "FMI_HEADERS", {"2.0": ("fmi2Missing.h",)})
    with pytest.raises(BuildError, match=r"fmi2Missing\.h is missing.*pip install fmpy"):
        collect_sources("", "2.0")


def test_it_follows_the_schema_and_lists_every_c_file() -> None:
    files = c_files(collect_sources("int model;", "3.0"))
    root = etree.fromstring(build_description_xml("Oscillator", files))
    schema = Path(str(resources.files("fmpy") / "schema" / "fmi3" / "fmi3BuildDescription.xsd"))
    etree.XMLSchema(etree.parse(schema)).assertValid(root)
    assert [file.get("name") for file in root.iter("SourceFile")] == files
    assert "fmi3_cosimulation.c" in files
    assert not any(name.startswith("fmi2_") for name in files)
