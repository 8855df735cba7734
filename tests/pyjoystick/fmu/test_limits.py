"""Archives that are too large, and errors that a wrong model identifier causes."""

from __future__ import annotations

import time
import zipfile
from pathlib import Path

import fmpy
import pytest

from pyjoystick.fmu import Fmu, FmuFileError, limits, read_description
from pyjoystick.support import ParameterError
from tests.pyjoystick.fmu.doctored import FMI_3, doctored


def test_a_bomb_is_not_unpacked(
    joystick_path: Path, tmp_path: Path, unpacking_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "LARGEST_UNPACKED", 2**25)
    path = doctored(joystick_path, tmp_path / "bomb.fmu")
    with (
        zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED, compresslevel=1) as archive,
        archive.open("resources/zeros", "w", force_zip64=True) as file,
    ):
        for _ in range(2):
            file.write(bytes(2**24))
    with pytest.raises(FmuFileError, match=r"bomb\.fmu: would take \d+ bytes unpacked: at most 33554432 are"):
        Fmu(path)
    assert not list(unpacking_folder.iterdir())


def test_too_many_files(joystick_path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MOST_FILES", 3)
    path = doctored(joystick_path, tmp_path / "many.fmu")
    with pytest.raises(FmuFileError, match=r"contains \d+ files: at most 3 are allowed \(PYJOYSTICK_FMU"):
        read_description(path)
    monkeypatch.setenv("PYJOYSTICK_FMU_LIMITS", "100")
    assert read_description(path).variables
    monkeypatch.setenv("PYJOYSTICK_FMU_LIMITS", "no")
    with pytest.raises(ParameterError, match="PYJOYSTICK_FMU_LIMITS = no: must be a number above 0"):
        read_description(path)


@pytest.mark.parametrize("version", [2, 3])
def test_too_many_variables(version: int, joystick_path: Path, tmp_path: Path) -> None:
    """They are refused before anything takes time over them."""

    def many(text: str) -> str:
        last = '<Float64 name="time"' if version == 3 else "</ModelVariables>"
        before, after = (FMI_3 if version == 3 else text).split(last)
        line = (
            '<Float64 name="x{0}" valueReference="{0}"/>\n'
            if version == 3
            else '<ScalarVariable name="x{0}" valueReference="{0}"><Real/></ScalarVariable>\n'
        )
        return before + "".join(line.format(i) for i in range(300_000)) + last + after

    path = doctored(joystick_path, tmp_path / "huge.fmu", description=many)
    begin = time.monotonic()
    with pytest.raises(FmuFileError, match=r"huge\.fmu: declares 100001 variables or more: at most 100000"):
        read_description(path)
    assert time.monotonic() - begin < 10.0


def test_a_description_that_is_too_large(joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(joystick_path, tmp_path / "large.fmu", description=lambda text: text + " " * 2**26)
    with pytest.raises(FmuFileError, match=r"has a modelDescription\.xml of \d+ bytes: at most 67108864"):
        read_description(path)


def test_a_wrong_model_identifier(joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(
        joystick_path,
        tmp_path / "wrong.fmu",
        description=lambda text: text.replace('modelIdentifier="Joystick"', 'modelIdentifier="Stick"'),
    )
    wanted = (
        rf"wrong\.fmu: its modelIdentifier 'Stick' asks for Stick.* in binaries/{fmpy.platform}, "
        r"which has only Joystick"
    )
    with pytest.raises(FmuFileError, match=wanted):
        Fmu(path)


def test_a_damaged_archive_is_not_repeated_in_the_message(tmp_path: Path) -> None:
    """Python's error quotes the file name in the header of an entry, whose length may be damaged."""
    path = tmp_path / "damaged.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", "x" * 40_000)
    content = bytearray(path.read_bytes())
    content[26:28] = (30_000).to_bytes(2, "little")
    path.write_bytes(content)
    with pytest.raises(FmuFileError, match="cannot be read") as caught:
        read_description(path)
    assert len(str(caught.value)) < 1000
