"""Files that appear whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pyjoystick.support.errors import OutputFileError


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path beside `path` to write to, with the same suffix; on leaving it takes the place of `path`.

    Missing folders are made. Where the body raises, what was written is removed and `path` stays as it was.

    Raises:
        OutputFileError: the file cannot be written there
    """
    temporary = path.with_name(f".{path.stem}-{os.getpid()}-{os.urandom(4).hex()}{path.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputFileError(path, f"its folder cannot be made: {error.strerror}") from error
    try:
        yield temporary
        temporary.replace(path)
    except OSError as error:
        raise OutputFileError(path, error.strerror or str(error)) from error
    finally:
        temporary.unlink(missing_ok=True)


def check_outputs(*paths: Path | None) -> None:
    """Find out before a run whether its results can be written; None stands for a result that is not wanted.

    Nothing is made. What can still go wrong later, such as a full disk, is said by `replacing`.

    Raises:
        OutputFileError: a path is a folder, its folder can neither be written to nor made, or two paths are
            the same file
    """
    wanted = [path for path in paths if path is not None]
    for i, path in enumerate(wanted):
        if path.resolve() in [other.resolve() for other in wanted[:i]]:
            raise OutputFileError(path, "another result is written there too")
        if path.is_dir():
            raise OutputFileError(path, "it is a folder")
        folder = next(parent for parent in path.absolute().parents if parent.exists())
        try:
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError as error:
            raise OutputFileError(path, f"{folder}: {error.strerror or error}") from error


def write_text(path: Path, text: str) -> None:
    """Write a text file (UTF-8), whole or not at all; raises OutputFileError."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
