"""Files that appear whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pyjoystick.errors import OutputFileError


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


def write_text(path: Path, text: str) -> None:
    """Write a text file (UTF-8), whole or not at all; raises OutputFileError."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
