"""The .fmu file: a ZIP archive whose bytes depend only on its content, written atomically."""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from fmu_build.support.errors import BuildError

_EARLIEST = (1980, 1, 1, 0, 0, 0)  # the earliest date that a ZIP entry can have
_PLAIN_FILE = 0o100644


def archive_bytes(entries: Mapping[str, bytes]) -> bytes:
    """Return the archive of the given files; names are relative paths with "/".

    Raises `BuildError` for a name that is not plain ASCII.
    """
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name in sorted(entries):
            if not name.isascii() or "\\" in name or name.startswith("/"):
                raise BuildError(f"internal error: {name!r} cannot be a file name in an FMU")
            info = zipfile.ZipInfo(name, _EARLIEST)
            info.create_system = 3  # Unix, on every platform
            info.external_attr = _PLAIN_FILE << 16
            archive.writestr(info, entries[name], zipfile.ZIP_DEFLATED, compresslevel=9)
    return buffer.getvalue()


@contextmanager
def replacing(target: Path, content: bytes) -> Iterator[Path]:
    """Write `content` to a file next to `target` and yield its path; rename it to `target` on exit.

    If the body raises, the new file is removed and `target` stays as it was. Missing folders are created.
    Raises `BuildError`, which names the path that cannot be written.
    """
    temporary = target.with_name(f".{target.stem}-{os.getpid()}-{os.urandom(4).hex()}.tmp")
    made = _make_folder(target.parent)
    try:
        with _path_errors(temporary.parent):
            temporary.write_bytes(content)
        yield temporary
        with _path_errors(target):
            temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        for folder in made:
            folder.rmdir()
        raise


def check_output_folder(folder: Path) -> None:
    """Raise `BuildError` if the folder cannot be written to; do not create it."""
    existing = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    if not existing.is_dir():
        raise BuildError(f"cannot write to {folder}: {existing} is not a folder")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise BuildError(f"cannot write to {folder}: no permission to write in {existing}")


def _make_folder(folder: Path) -> list[Path]:
    """Create the folder and its parents; return those that it created, innermost first."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    with _path_errors(folder):
        folder.mkdir(parents=True, exist_ok=True)
    return missing


@contextmanager
def _path_errors(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise BuildError(f"cannot write to {path}: {error.strerror or error}") from error
