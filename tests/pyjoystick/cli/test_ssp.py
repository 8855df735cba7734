"""``pyjoystick ssp``."""

from __future__ import annotations

import zipfile
from pathlib import Path
from xml.etree import ElementTree

import pytest

from pyjoystick.runs import operator_and_joystick, read_ssp
from tests.pyjoystick.cli.conftest import Command


@pytest.mark.parametrize(
    ("options", "version"),
    [((), "1.0"), (("--ssp-version", "1.0"), "1.0"), (("--ssp-version", "2.0"), "2.0")],
)
def test_the_archive_has_the_system(
    options: tuple[str, ...], version: str, command: Command, tmp_path: Path
) -> None:
    outcome = command("ssp", "joystick.ssp", *options)
    assert (outcome.code, outcome.out, outcome.err) == (0, "", "wrote joystick.ssp\n")
    path = tmp_path / "joystick.ssp"
    assert read_ssp(path, tmp_path).connections == operator_and_joystick().connections
    with zipfile.ZipFile(path) as file:
        assert ElementTree.fromstring(file.read("SystemStructure.ssd")).get("version") == version


def test_what_cannot_be_written(command: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    outcome = command("ssp", "file/joystick.ssp")
    assert outcome.code == 1
    assert outcome.message.startswith("cannot write file/joystick.ssp: its folder cannot be created")
