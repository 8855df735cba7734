"""Files appear whole or not at all; JSON contains the versions."""

from __future__ import annotations

import json
import math
import os
import platform
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.support import (
    OutputFileError,
    check_outputs,
    document_text,
    json_text,
    replacing,
    version_of,
    versions,
    write_text,
)


def test_folders_are_made_and_files_replaced(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder" / "file.txt"
    write_text(path, "one\n")
    write_text(path, "zwölf\n")
    assert path.read_bytes() == "zwölf\n".encode()
    assert list(path.parent.iterdir()) == [path]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_what_was_there_stays_where_writing_fails(tmp_path: Path, error: type[BaseException]) -> None:
    path = tmp_path / "file.csv"
    path.write_text("old")

    def fails_in_the_middle() -> None:
        with replacing(path) as temporary:
            temporary.write_text("half of it")
            raise error

    with pytest.raises(error):
        fails_in_the_middle()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_the_suffix_is_kept_for_those_who_go_by_it(tmp_path: Path) -> None:
    with replacing(tmp_path / "a.b.png") as temporary:
        assert temporary.suffix == ".png"
        assert temporary.parent == tmp_path
        temporary.touch()


def test_a_path_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    with pytest.raises(OutputFileError, match=r"cannot write .*file/x\.txt: its folder cannot be created"):
        write_text(tmp_path / "file" / "x.txt", "text")
    with pytest.raises(OutputFileError, match=r"cannot write .*folder: "):
        write_text(tmp_path / "folder", "text")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "folder"]


def test_outputs_that_can_be_written_are_not_made(tmp_path: Path) -> None:
    (tmp_path / "old.csv").write_text("old")
    check_outputs(None, tmp_path / "old.csv", tmp_path / "new" / "folder" / "new.csv", None)
    assert [path.name for path in tmp_path.iterdir()] == ["old.csv"]
    assert (tmp_path / "old.csv").read_text() == "old"


def test_outputs_that_cannot_be_written_are_found_before(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    for name, reason in (("file/a/x.csv", "file: "), ("folder", "it is a folder")):
        with pytest.raises(OutputFileError, match=rf"cannot write .*{name}: .*{reason}"):
            check_outputs(tmp_path / name)


def test_names_of_every_length(tmp_path: Path) -> None:
    for name in ("x" * 251 + ".csv", "\N{GREEK SMALL LETTER THETA}" * 125 + ".json"):
        check_outputs(tmp_path / name)
        write_text(tmp_path / name, "text")
        assert (tmp_path / name).read_text() == "text"
    for name in ("x" * 252 + ".csv", "x" * 256 + "/x.csv"):
        with pytest.raises(OutputFileError, match="File name too long"):
            check_outputs(tmp_path / name)


def test_a_folder_that_is_locked_is_found_before(tmp_path: Path) -> None:
    folder = tmp_path / "locked"
    folder.mkdir(mode=0o500)
    if os.access(folder, os.W_OK):
        pytest.skip("whoever runs this may write everywhere, as root does")
    with pytest.raises(OutputFileError, match=r"locked/x\.csv: .*locked: Permission denied"):
        check_outputs(folder / "x.csv")


def test_two_outputs_in_one_file_are_refused(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "folder")
    path = tmp_path / "folder" / "x.png"
    for other in (path, tmp_path / "folder" / ".." / "folder" / "x.png", tmp_path / "link" / "x.png"):
        with pytest.raises(OutputFileError, match=r"x\.png: another result is written there too"):
            check_outputs(path, None, other)


def test_json_has_every_number_in_full_and_the_versions() -> None:
    content = {
        "x": np.array([[0.1, math.nan]]),
        "y": (np.float64(1 / 3), -math.inf, np.int64(2)),
        "z": {1: "ä"},
    }
    found = json.loads(json_text(content), parse_constant=lambda name: pytest.fail(name))
    assert found.pop("made_with") == versions()
    assert found == {"x": [[0.1, None]], "y": [1 / 3, None, 2], "z": {"1": "ä"}}


def test_a_document_names_its_command_and_repeats_the_notes() -> None:
    found = json.loads(document_text("fit", {"x": math.inf}, iter(["doubtful"])))
    assert found == {"command": "fit", "x": None, "notes": ["doubtful"], "made_with": versions()}
    assert json.loads(document_text("fit", {}))["notes"] == []


def test_versions_are_those_of_the_packages() -> None:
    assert versions()["Python"] == platform.python_version()
    assert versions()["numpy"] == np.__version__
    assert version_of("no-such-package") == "not installed"


def test_a_symbolic_link_stays_one(tmp_path: Path) -> None:
    (tmp_path / "results").mkdir()
    link = tmp_path / "link.csv"
    link.symlink_to("results/target.csv")
    write_text(link, "new\n")
    assert link.is_symlink()
    assert (tmp_path / "results" / "target.csv").read_text() == "new\n"


def test_a_circle_of_symbolic_links_is_refused(tmp_path: Path) -> None:
    link = tmp_path / "link.csv"
    link.symlink_to("link.csv")
    for write in (lambda: check_outputs(link), lambda: write_text(link, "new")):
        with pytest.raises(OutputFileError, match=r"link\.csv"):
            write()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_or_device_is_not_replaced(tmp_path: Path) -> None:
    pipe, link = tmp_path / "pipe", tmp_path / "link.csv"
    os.mkfifo(pipe)
    link.symlink_to(pipe)
    for path in (pipe, link):
        for write in (lambda path=path: check_outputs(path), lambda path=path: write_text(path, "new")):
            with pytest.raises(OutputFileError, match="it is no regular file"):
                write()
    assert pipe.is_fifo()


def test_a_link_to_a_file_of_another_suffix_keeps_the_format(tmp_path: Path) -> None:
    link = tmp_path / "figure.png"
    link.symlink_to("blob")
    with replacing(link) as temporary:
        assert temporary.suffix == ".png"
        temporary.write_bytes(b"picture")
    assert link.is_symlink()
    assert (tmp_path / "blob").read_bytes() == b"picture"
