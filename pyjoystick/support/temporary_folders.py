"""Temporary folders that are cleaned up even if the process that made them is killed.

A process locks its folder ``pyjoystick-HOST-...``; the operating system releases the lock when the process
ends for any reason. A folder with a free lock can be deleted. Unlike a process number, which may be reused,
or a clock, a lock is reliable.
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from filelock import FileLock

_LOCK: Final = ".lock"


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """A new temporary folder, deleted on leaving.

    The first call in a process also deletes the folders that killed processes of this user left on this
    machine.
    """
    remove_abandoned()
    (folder, lock), owner = _locked_folder(), os.getpid()
    try:
        yield folder
    finally:
        if os.getpid() == owner:  # else in a forked process: the folder is its parent's
            lock.release()
            shutil.rmtree(folder, ignore_errors=True)


def _locked_folder() -> tuple[Path, FileLock]:
    from filelock import FileLock

    while True:
        folder = Path(tempfile.mkdtemp(prefix=_prefix()))
        lock = FileLock(folder / _LOCK)
        # Before it is locked, another process may take it for abandoned and remove it.
        with suppress(FileNotFoundError):
            lock.acquire()
            if (folder / _LOCK).exists():
                return folder, lock
        lock.release()


@cache
def remove_abandoned() -> None:
    """Delete the folders whose processes have ended, once per process.

    Folders of other users, of other machines that share the place, and those without a lock are kept.
    """
    base = tempfile.gettempdir()
    with suppress(OSError), os.scandir(base) as entries:
        found = [Path(entry.path) for entry in entries if entry.name.startswith(_prefix())]
        for folder in filter(_is_own, found):
            _remove_if_abandoned(folder)


def _is_own(folder: Path) -> bool:
    """A folder of this user, and no link to one."""
    with suppress(OSError):
        status = folder.lstat()
        return stat.S_ISDIR(status.st_mode) and status.st_uid == getattr(os, "getuid", int)()
    return False


def _remove_if_abandoned(folder: Path) -> None:
    from filelock import FileLock, Timeout

    # A folder that is being made has no lock yet.
    with suppress(OSError, Timeout):
        if (folder / _LOCK).exists():
            with FileLock(folder / _LOCK, timeout=0):
                shutil.rmtree(folder, ignore_errors=True)
            if os.name == "nt":  # where no open file can be deleted, so that this spares a lock that is held
                shutil.rmtree(folder)


@cache
def _prefix() -> str:
    """What the names of this machine's folders begin with."""
    return f"pyjoystick-{re.sub('[^A-Za-z0-9]', '_', platform.node())}-"
