"""buildDescription.xml of FMI 3.0."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from lxml import etree

from fmu_build.packaging.build_description import build_description_xml
from fmu_build.packaging.sources import c_files, collect_sources


def test_it_follows_the_schema_and_lists_every_c_file() -> None:
    files = c_files(collect_sources("int model;", "3.0"))
    root = etree.fromstring(build_description_xml("Oscillator", files))
    schema = Path(str(resources.files("fmpy") / "schema" / "fmi3" / "fmi3BuildDescription.xsd"))
    etree.XMLSchema(etree.parse(schema)).assertValid(root)
    assert [file.get("name") for file in root.iter("SourceFile")] == files
    assert "fmi3_cosimulation.c" in files
    assert not any(name.startswith("fmi2_") for name in files)
