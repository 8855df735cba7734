"""Temporary folders of builds."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

_PREFIX = "fmu_build-"
#: Longer than any build (s): an older folder belongs to a process that was killed.
_OLD = 86400.0


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """Create a temporary folder, which is deleted on exit.

    The first call in a process also deletes folders that killed builds left more than a day ago.
    """
    _remove_old()
    with tempfile.TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True) as name:
        yield Path(name).resolve()


@cache
def _remove_old() -> None:
    """Delete old folders, once per process; those of other users cannot be deleted and stay."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        with suppress(OSError):
            if not folder.is_symlink() and folder.stat().st_mtime < time.time() - _OLD:
                shutil.rmtree(folder, ignore_errors=True)
