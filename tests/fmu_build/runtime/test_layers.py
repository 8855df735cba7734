"""The C runtime's folders include each other as listed in docs/architecture.md."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

from fmu_build.packaging.sources import FMI_HEADERS, RUNTIME

ARCHITECTURE = Path(__file__).parents[3] / "docs" / "architecture.md"
FILES = sorted(RUNTIME.rglob("*.[ch]"))


def _table() -> dict[str, set[str]]:
    """Folder -> the folders that it may include from, in the order of the rows."""
    section = ARCHITECTURE.read_text("utf-8").partition("## The C runtime")[2]
    rows = re.findall(r"^\| (`[^|]+) \|[^|]*\|([^|]*)\|$", section, re.MULTILINE)
    return {
        folder: set(re.findall(r"`(\w+)`", allowed))
        for names, allowed in rows
        for folder in re.findall(r"`(\w+)`", names)
    }


def test_the_table_names_every_folder_from_the_bottom_up() -> None:
    folders = list(_table())
    assert sorted(folders) == sorted({file.parent.name for file in FILES})
    for place, (folder, allowed) in enumerate(_table().items()):
        assert allowed <= set(folders[:place]), folder


def test_files_include_from_their_own_layer_and_those_of_the_table() -> None:
    home = {file.name: file.parent.name for file in FILES}
    standard = {header for headers in FMI_HEADERS.values() for header in headers}
    includes = [
        (file, header)
        for file in FILES
        for header in re.findall(r'^#include "(.+)"', file.read_text("utf-8"), re.MULTILINE)
        if header not in standard
    ]
    assert len(includes) > 50
    assert [
        f"{file.parent.name}/{file.name} includes {home[header]}/{header}"
        for file, header in includes
        if home[header] not in {file.parent.name, *_table()[file.parent.name]}
    ] == []


def test_file_names_differ_so_that_an_fmu_can_carry_them_side_by_side() -> None:
    assert [name for name, count in Counter(file.name for file in FILES).items() if count > 1] == []
