"""Atomic writing of result files, and versions of the software that made them."""

from __future__ import annotations

import json
import logging
import math
import os
import platform
import re
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from importlib import metadata
from os import PathLike
from pathlib import Path
from typing import Any, Final

from pyjoystick.support.errors import OutputFileError

_LOG = logging.getLogger(__name__)

#: Formats of figures.
FIGURE_SUFFIXES: Final = (".png", ".pdf", ".svg")
#: Names of files that `replacing` is writing.
_UNFINISHED: Final = re.compile(r"\..+-\d+-[0-9a-f]{8}(\.\w+)?")
#: Characters of the name of a file that its temporary name keeps.
_KEPT: Final = 40
#: Packages that results depend on.
_PACKAGES: Final = ("pyjoystick", "fmpy", "numpy", "scipy", "pandas")


@contextmanager
def replacing(path: str | PathLike[str]) -> Iterator[Path]:
    """Path next to `path` to write to, with the same suffix; on leaving, it replaces `path`.

    Missing folders are created. Of a symbolic link, the file that it leads to is replaced. If the body raises
    an error, `path` is left unchanged.

    Raises:
        OutputFileError: the file cannot be written there
    """
    named = Path(path)
    path = _resolved(named) if named.is_symlink() else named
    _require_no_device(path)
    # Shortened, so that it is no longer than the longest name that a file may have.
    temporary = path.with_name(f".{named.stem[:_KEPT]}-{os.getpid()}-{os.urandom(4).hex()}{named.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputFileError(path, f"its folder cannot be created: {error.strerror}") from error
    try:
        yield temporary
        temporary.replace(path)
        _LOG.info("wrote %s", path)
    except OSError as error:
        raise OutputFileError(path, error.strerror or str(error)) from error
    finally:
        temporary.unlink(missing_ok=True)


def remove_unfinished(folder: Path) -> None:
    """Delete files that killed processes left while `replacing` was writing them.

    Use only if no other process writes.
    """
    for path in folder.rglob(".*"):
        if _UNFINISHED.fullmatch(path.name) and path.is_file():
            path.unlink(missing_ok=True)


def check_outputs(*paths: Path | None) -> None:
    """Check before a run that its results can be written; None for a result that was not requested.

    Nothing is created. Problems that arise later, such as a full disk, are reported by `replacing`.

    Raises:
        OutputFileError: a path is a folder, its folder cannot be written to or created, or two paths are the
            same file
    """
    wanted = [path for path in paths if path is not None]
    for i, path in enumerate(wanted):
        if _resolved(path) in map(_resolved, wanted[:i]):
            raise OutputFileError(path, "another result is written there too")
        try:
            is_folder = path.is_dir()
            folder = next(parent for parent in path.absolute().parents if parent.exists())
        except OSError as error:  # the name is too long
            raise OutputFileError(path, error.strerror or str(error)) from error
        if is_folder:
            raise OutputFileError(path, "it is a folder")
        _require_no_device(path)
        try:
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError as error:
            raise OutputFileError(path, f"{folder}: {error.strerror or error}") from error


def _require_no_device(path: Path) -> None:
    """Raise OutputFileError for a device or pipe, in the place of which a file would be put."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise OutputFileError(path, "it is no regular file")


def _resolved(path: Path) -> Path:
    try:
        return path.resolve()
    except RuntimeError as error:
        raise OutputFileError(path, "it is a symbolic link that leads in a circle") from error


def check_suffix(path: str | PathLike[str], *suffixes: str) -> None:
    """Raise OutputFileError unless the name ends in one of the suffixes, in small or capital letters."""
    path = Path(path)
    if path.suffix.lower() not in suffixes:
        raise OutputFileError(path, f"the name must end in {', '.join(suffixes)}")


def write_text(path: str | PathLike[str], text: str) -> None:
    """Write a text file (UTF-8), whole or not at all; raises OutputFileError."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def document_text(command: str, content: Mapping[str, Any], notes: Iterable[str] = ()) -> str:
    """The document of a command as JSON text; docs/json.md has the convention that all of them keep.

    Args:
        command: ``fit``, ``import swing``; `pyjoystick run` and functions write the same documents
        content: what is found, by name
        notes: what was noted on it
    """
    return json_text({"command": command, **content, "notes": list(notes)})


def json_text(content: Mapping[str, Any]) -> str:
    """A result as JSON text, with the versions as ``made_with``.

    Numbers are written in full, arrays as lists; NaN and infinities, which JSON lacks, are null.
    """
    document = _plain({**content, "made_with": versions()})
    return json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items()}
    if hasattr(value, "tolist"):  # an array or a number of NumPy
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def version_of(package: str) -> str:
    """The version of an installed package, or ``not installed``, as in a bare checkout."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def versions() -> dict[str, str]:
    """Versions of Python and of the packages that results depend on, by name."""
    return {"Python": platform.python_version()} | {package: version_of(package) for package in _PACKAGES}
