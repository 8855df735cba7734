"""sources/buildDescription.xml of FMI 3.0: how an importer compiles the FMU's sources."""

from __future__ import annotations

from collections.abc import Sequence

from lxml import etree

BUILD_DESCRIPTION = "buildDescription.xml"


def build_description_xml(identifier: str, c_files: Sequence[str]) -> bytes:
    """The file's content: one library from all C files, and the mathematical functions of the C library."""
    root = etree.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = etree.SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = etree.SubElement(configuration, "SourceFileSet", language="C11")
    for name in c_files:
        etree.SubElement(files, "SourceFile", name=name)
    etree.SubElement(configuration, "Library", name="m", external="true", description="C library, libm")
    content: bytes = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    return content
