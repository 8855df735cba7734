"""Archives that are encrypted, compressed in unknown ways or damaged, and numbers out of range in them."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pytest

from pyjoystick.fmu import Fmu, FmuFileError, read_description
from pyjoystick.runs import read_ssp
from pyjoystick.support import InputFileError
from tests.pyjoystick.fmu.doctored import doctored


def _field_set(path: Path, target: Path, offset: int, value: int) -> Path:
    """A copy in which a field of 16 bits of every entry is another, at its place in the central directory."""
    content = bytearray(path.read_bytes())
    for mark, shift in ((b"PK\1\2", 0), (b"PK\3\4", -2)):
        at = content.find(mark)
        while at >= 0:
            content[at + offset + shift : at + offset + shift + 2] = value.to_bytes(2, "little")
            at = content.find(mark, at + 4)
    target.write_bytes(content)
    return target


def _packed_anew(path: Path, target: Path, way: int) -> Path:
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(target, "w", way) as file:
        for name in source.namelist():
            file.writestr(name, source.read(name))
    return target


def _spoiled(path: Path, target: Path) -> Path:
    """A copy whose compressed data are not what a compressor writes."""
    content = bytearray(path.read_bytes())
    with zipfile.ZipFile(path) as archive:
        for entry in archive.infolist():
            start = entry.header_offset + 30 + len(entry.filename)
            content[start : start + entry.compress_size] = b"\xff" * entry.compress_size
    target.write_bytes(content)
    return target


@pytest.mark.parametrize(
    ("offset", "value", "words"), [(8, 1, "encrypted"), (10, 99, "not supported"), (6, 255, "version 25.5")]
)
def test_an_archive_that_cannot_be_read(
    offset: int, value: int, words: str, joystick_path: Path, tmp_path: Path
) -> None:
    path = _field_set(joystick_path, tmp_path / "odd.fmu", offset, value)
    with pytest.raises(FmuFileError, match=rf"odd\.fmu: .*{words}"):
        read_description(path)
    with zipfile.ZipFile(tmp_path / "a.ssp", "w") as file:
        file.writestr("SystemStructure.ssd", "<a/>")
    path = _field_set(tmp_path / "a.ssp", tmp_path / "odd.ssp", offset, value)
    with pytest.raises(InputFileError, match=rf"odd\.ssp: not an SSP archive: .*{words}"):
        read_ssp(path, tmp_path)


@pytest.mark.parametrize("way", [zipfile.ZIP_STORED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_other_ways_to_compress_are_read(way: int, joystick_path: Path, tmp_path: Path) -> None:
    with Fmu(_packed_anew(joystick_path, tmp_path / "a.fmu", way)) as fmu:
        assert len(fmu.run([0.0, 0.1])) == 2


@pytest.mark.parametrize("way", [zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_compressed_data_that_are_damaged(way: int, tmp_path: Path, joystick_path: Path) -> None:
    fmu = _spoiled(_packed_anew(joystick_path, tmp_path / "a.fmu", way), tmp_path / "spoiled.fmu")
    with pytest.raises(FmuFileError, match=r"spoiled\.fmu: "):
        read_description(fmu)
    with zipfile.ZipFile(tmp_path / "a.ssp", "w", way) as file:
        file.writestr("SystemStructure.ssd", "<a/>" * 100)
    ssp = _spoiled(tmp_path / "a.ssp", tmp_path / "spoiled.ssp")
    with pytest.raises(InputFileError, match=r"spoiled\.ssp: not an SSP archive: "):
        read_ssp(ssp, tmp_path)


@pytest.mark.parametrize("reference", [-1, 2**32, 10**30])
def test_a_value_reference_out_of_range(reference: int, joystick_path: Path, tmp_path: Path) -> None:
    def change(text: str) -> str:
        return re.sub('valueReference="[0-9]+"', f'valueReference="{reference}"', text, count=1)

    path = doctored(joystick_path, tmp_path / "odd.fmu", description=change)
    expected = (
        rf"odd\.fmu: variable '.*': valueReference = {reference}: must be a whole number from 0 to 4294967295"
    )
    with pytest.raises(FmuFileError, match=expected):
        read_description(path)


@pytest.mark.parametrize("name", ["/tmp/evil", "..\\evil", "resources/../../evil", "C:evil"])
def test_a_path_that_leads_elsewhere(name: str, tmp_path: Path, joystick_path: Path) -> None:
    path = doctored(
        joystick_path, tmp_path / "odd.fmu", rename=lambda old: name if "resources" in old else old
    )
    with zipfile.ZipFile(path, "a") as file:
        file.writestr(zipfile.ZipInfo(name), "")
    with pytest.raises(
        FmuFileError, match=r"odd\.fmu: contains a file whose path may lead elsewhere: .*evil"
    ):
        Fmu(path)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('name="theta"', 'name="omega"', "two variables in its modelDescription.xml have the name 'omega'"),
        ('name="theta"', 'name=""', r"variable \d+ in its modelDescription.xml has no name"),
        ('name="theta" valueReference="[^"]*"', 'name="theta"', "variable 'theta' .* has no valueReference"),
    ],
)
def test_variables_that_cannot_be_told_apart(
    old: str, new: str, message: str, tmp_path: Path, joystick_path: Path
) -> None:
    path = doctored(
        joystick_path, tmp_path / "odd.fmu", description=lambda text: re.sub(old, new, text, count=1)
    )
    with pytest.raises(FmuFileError, match=rf"odd\.fmu: {message}"):
        read_description(path)
