"""Files that builds keep for later builds, in zig's cache folder for this user."""

from __future__ import annotations

import contextlib
import hashlib
import os
from dataclasses import dataclass
from pathlib import Path

# Where zig looks for its cache folder, in this order: an environment variable and a subfolder of its value.
PLACES = {
    "ZIG_GLOBAL_CACHE_DIR": "",
    "XDG_CACHE_HOME": "zig",
    "HOME": ".cache/zig",
    "LOCALAPPDATA": "zig",
}


def cache_folder() -> Path | None:
    """Return zig's cache folder for this user; None if it is not writable, as in many containers."""
    for name, place in PLACES.items():
        if os.environ.get(name):
            folder = Path(os.environ[name], place).absolute()
            existing = next(path for path in (folder, *folder.parents) if path.exists())
            return folder if os.access(existing, os.W_OK) else None
    return None


@dataclass(frozen=True, slots=True)
class Store:
    """Files in a folder of the cache, each under a key that identifies its inputs.

    Attributes:
        name: name of the folder
        most: number of files to keep; the least recently used are deleted
    """

    name: str
    most: int

    def folder(self) -> Path | None:
        """Return the folder, which may not exist yet; None if there is no writable cache."""
        folder = cache_folder()
        return None if folder is None else folder / "fmu_build" / self.name

    def read(self, key: str) -> bytes | None:
        """Return the content stored under a key and mark it as used; None if it is missing or damaged."""
        folder = self.folder()
        if folder is None:
            return None
        try:
            stored = (folder / key).read_bytes()
        except OSError:
            return None
        with contextlib.suppress(OSError):
            os.utime(folder / key)
        digest, content = stored[:32], stored[32:]
        return content if hashlib.sha256(content).digest() == digest else None

    def write(self, key: str, content: bytes) -> None:
        """Store the content, atomically with respect to other writers and to being killed.

        A failure to write is ignored. Surplus files, and remains of killed processes, are deleted.
        """
        folder = self.folder()
        if folder is None:
            return
        with contextlib.suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            new = folder / f"{key}-{os.getpid()}-{os.urandom(4).hex()}"
            try:
                new.write_bytes(hashlib.sha256(content).digest() + content)
                new.replace(folder / key)
            finally:
                new.unlink(missing_ok=True)
            used = sorted(folder.iterdir(), key=lambda one: one.stat().st_mtime_ns)
            for oldest in used[: -self.most]:
                oldest.unlink(missing_ok=True)
