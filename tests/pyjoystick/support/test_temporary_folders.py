from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from filelock import FileLock

from pyjoystick.support import remove_abandoned, temporary_folder

_HOLDER = """
from pyjoystick.support import temporary_folder
with temporary_folder() as folder:
    (folder / "inside").mkdir()
    (folder / "inside" / "file").write_text("")
    print(folder, flush=True)
    input()
"""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of temporary files, here and in processes that are started."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    remove_abandoned.cache_clear()
    return tmp_path


@contextmanager
def _held() -> Iterator[tuple[subprocess.Popen[str], Path]]:
    """A process of its own with a temporary folder."""
    command = [sys.executable, "-c", _HOLDER]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield process, Path(process.stdout.readline().strip())
        finally:
            process.kill()


def test_a_folder_is_there_and_gone(place: Path) -> None:
    with temporary_folder() as folder:
        assert folder.is_dir()
        assert [folder] == list(place.iterdir())
        (folder / "file").write_text("")
    assert list(place.iterdir()) == []


@pytest.mark.parametrize("is_open", [False, True])
def test_a_folder_that_is_removed_before_it_is_locked_is_replaced(
    is_open: bool, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    acquire, removed = FileLock.acquire, list[Path]()

    def removed_at_first(lock: FileLock) -> None:
        if is_open or removed:
            acquire(lock)
        if not removed:
            removed.append(Path(lock.lock_file).parent)
            shutil.rmtree(removed[0])
            if not is_open:
                raise FileNotFoundError(lock.lock_file)

    monkeypatch.setattr(FileLock, "acquire", removed_at_first)
    with temporary_folder() as folder:
        assert folder.is_dir()
        assert removed not in ([], [folder])
        monkeypatch.undo()
    assert not folder.exists()


def test_the_folder_of_a_killed_process_goes_at_the_next_start(place: Path) -> None:
    with _held() as (process, left):
        process.kill()
        process.wait()
        assert (left / "inside" / "file").exists()
        with temporary_folder() as folder:
            assert [folder] == list(place.iterdir())


def test_the_folder_of_a_living_process_stays_though_it_sleeps(place: Path) -> None:
    with _held() as (process, folder):
        if hasattr(signal, "SIGSTOP"):
            process.send_signal(signal.SIGSTOP)
        os.utime(folder, (0, 0))
        os.utime(folder / ".lock", (0, 0))
        remove_abandoned()
        assert (folder / "inside" / "file").exists()


def test_what_may_be_of_others_stays(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with temporary_folder() as folder:
        prefix = folder.name.rpartition("-")[0]
    for name in ("pyjoystick-elsewhere-1", "fmu_build-1", f"{prefix}-nolock"):
        (place / name).mkdir()
    (place / "pyjoystick-elsewhere-1" / ".lock").write_text("")
    (place / f"{prefix}-file").write_text("")
    target = place / "target"
    target.mkdir()
    (target / ".lock").write_text("")
    if hasattr(os, "symlink"):
        (place / f"{prefix}-link").symlink_to(target)
    before = sorted(place.iterdir())
    remove_abandoned.cache_clear()
    remove_abandoned()
    assert sorted(place.iterdir()) == before
    assert (target / ".lock").exists()
    abandoned = place / f"{prefix}-abandoned"
    abandoned.mkdir()
    (abandoned / ".lock").write_text("")
    monkeypatch.setattr(os, "getuid", lambda: -2, raising=False)
    remove_abandoned.cache_clear()
    remove_abandoned()
    assert abandoned.exists(), "it belongs to another user"


def test_a_place_that_cannot_be_read_does_no_harm(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(place / "missing"))
    remove_abandoned()
