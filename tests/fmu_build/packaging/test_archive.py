"""The archive's bytes, and the files on disk after success and failure."""

from __future__ import annotations

import hashlib
import zipfile
from io import BytesIO
from pathlib import Path

import pytest

from fmu_build.packaging.archive import archive_bytes, check_output_folder, replacing
from fmu_build.support.errors import BuildError

_ENTRIES = {"modelDescription.xml": b"<x/>", "binaries/linux64/M.so": b"\x7fELF" * 1000}


def test_bytes_follow_from_the_content_alone() -> None:
    first = archive_bytes(_ENTRIES)
    assert archive_bytes(dict(reversed(_ENTRIES.items()))) == first
    assert archive_bytes(_ENTRIES | {"modelDescription.xml": b"<y/>"}) != first


def test_entries_are_sorted_deflated_and_dated_alike() -> None:
    with zipfile.ZipFile(BytesIO(archive_bytes(_ENTRIES))) as archive:
        entries = archive.infolist()
        assert archive.testzip() is None
        assert {entry.filename: archive.read(entry) for entry in entries} == _ENTRIES
    assert [entry.filename for entry in entries] == sorted(_ENTRIES)
    assert {entry.compress_type for entry in entries} == {zipfile.ZIP_DEFLATED}
    assert {entry.date_time for entry in entries} == {(1980, 1, 1, 0, 0, 0)}
    assert {entry.external_attr >> 16 for entry in entries} == {0o100644}


@pytest.mark.parametrize("name", ["sources/ä.c", "a\\b.c", "/etc/x"])
def test_a_name_that_not_every_tool_can_unpack(name: str) -> None:
    with pytest.raises(BuildError, match="cannot be a file name"):
        archive_bytes({name: b""})


def test_the_file_appears_at_the_end(tmp_path: Path) -> None:
    target = tmp_path / "new" / "folder" / "M.fmu"
    with replacing(target, b"content") as temporary:
        assert temporary.parent == target.parent
        assert temporary.read_bytes() == b"content"
        assert not target.exists()
    assert target.read_bytes() == b"content"
    assert list(target.parent.iterdir()) == [target]


def test_a_failure_leaves_nothing_behind(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="no good"), replacing(tmp_path / "a" / "b" / "M.fmu", b"content"):
        raise BuildError("no good")
    assert list(tmp_path.iterdir()) == []


def test_a_failure_keeps_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "M.fmu"
    target.write_bytes(b"old")
    before = hashlib.sha256(target.read_bytes()).digest()
    with pytest.raises(KeyboardInterrupt), replacing(target, b"new"):
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == [target]
    assert hashlib.sha256(target.read_bytes()).digest() == before


def test_a_target_that_cannot_be_replaced(tmp_path: Path) -> None:
    target = tmp_path / "M.fmu"
    (target / "inside").mkdir(parents=True)
    with pytest.raises(BuildError, match=r"cannot write to .*M\.fmu"), replacing(target, b"new"):
        pass
    assert list(tmp_path.iterdir()) == [target]


def test_a_folder_below_a_file(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(BuildError, match=r"file is not a folder"):
        check_output_folder(tmp_path / "file" / "below")
    with pytest.raises(BuildError, match="cannot write to"), replacing(tmp_path / "file" / "M.fmu", b""):
        pass
    check_output_folder(tmp_path / "not" / "yet" / "there")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
