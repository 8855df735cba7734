"""Finished runs of an unfinished sweep, in a folder next to the target file."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import Any, Final

import numpy as np
from filelock import FileLock, Timeout

from pyjoystick.runs.errors import ChangedSweepError, SweepFileError
from pyjoystick.runs.sweeps.sweep import Document, Part
from pyjoystick.support import OutputFileError, replacing, write_text

_IDENTITY: Final = "sweep.json"
_LOCK: Final = "lock"
_ANEW: Final = "start over with --overwrite"
_PARTS: Final = "from-*.npz"


class Parts:
    """The folder of parts. Each is written atomically, so that a killed process loses only unfinished runs.

    Attributes:
        target: the file of the finished sweep
        folder: ``TARGET.parts``
    """

    def __init__(self, target: Path) -> None:
        self.target = target
        self.folder = target.with_name(f"{target.name}.parts")

    @property
    def begun(self) -> bool:
        """Whether there are parts of some sweep."""
        return (self.folder / _IDENTITY).exists()

    @contextmanager
    def opened(self, identity: Document, *, anew: bool = False) -> Iterator[None]:
        """Create or reopen the folder of a sweep, and lock it against other processes meanwhile.

        Args:
            identity: see `Sweep.identity`
            anew: discard existing parts

        Raises:
            ChangedSweepError: the parts belong to another sweep
            SweepFileError: another process is working on this sweep, or the folder cannot be read
            OutputFileError: the folder cannot be created
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            lock = self._lock()
        except Timeout:
            raise SweepFileError(self.folder, "another process is working on this sweep") from None
        except OSError as error:
            raise OutputFileError(self.target, f"its folder cannot be created: {error.strerror}") from error
        with lock:
            if anew:
                self._drop()
            if not self._require(identity):
                write_text(self.folder / _IDENTITY, json.dumps(identity, indent=2))
            yield

    def _lock(self) -> AbstractContextManager[FileLock]:
        """Lock the folder; the system releases the lock when this process ends for any reason."""
        return FileLock(self.folder / _LOCK).acquire(timeout=0)

    def _drop(self) -> None:
        """Delete the parts, including truncated ones, and then the identity of their sweep."""
        for file in (*self.folder.glob(f"*{_PARTS}"), self.folder / _IDENTITY):
            file.unlink(missing_ok=True)

    def _require(self, identity: Document) -> bool:
        """Whether the folder belongs to this sweep; False if new; raises as `opened` if it is of another."""
        file = self.folder / _IDENTITY
        if not file.exists():
            if any(self.folder.glob(_PARTS)):
                unknown = f"{self.folder} has runs but no {_IDENTITY}, which says whose they are"
                raise ChangedSweepError(self.target, (unknown,))
            return False
        try:
            kept = json.loads(file.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError) as error:
            raise SweepFileError(file, f"cannot be read: {error}; {_ANEW}") from error
        if not isinstance(kept, dict):
            raise SweepFileError(file, f"does not say whose runs these are; {_ANEW}")
        require_same(self.target, kept, identity)
        return True

    def save(self, part: Part) -> None:
        """Save finished runs; raises OutputFileError if they cannot be written."""
        if not part.runs.size:
            return
        said = np.array([message for message in part.messages if message], dtype=np.str_)
        with replacing(self.folder / f"from-{part.runs[0]:09d}.npz") as temporary:
            np.savez(temporary, runs=part.runs, values=part.values, failed=part.failed, said=said)

    def whole(self, runs: int, columns: int) -> tuple[Part, np.ndarray[Any, np.dtype[np.bool_]]]:
        """All `runs` runs with the saved results, and which of them are saved, shape (runs,).

        An unreadable part counts as not done.
        """
        done = np.zeros(runs, dtype=np.bool_)
        values = np.full((runs, columns), np.nan)
        failed = np.zeros(runs, dtype=np.bool_)
        messages = [""] * runs
        for part in self._load(runs, columns):
            done[part.runs] = True
            values[part.runs] = part.values
            failed[part.runs] = part.failed
            for run, message in zip(part.runs[part.failed], part.messages, strict=True):
                messages[run] = message
        return Part(np.arange(runs), values, failed, messages), done

    def _load(self, runs: int, columns: int) -> Iterator[Part]:
        """All parts, with messages of failed runs only; deletes files that are not valid parts."""
        for file in sorted(self.folder.glob(_PARTS)):
            try:
                with file.open("rb") as stream, np.load(stream) as kept:
                    part = Part(kept["runs"], kept["values"], kept["failed"], kept["said"].tolist())
                    _require_part(part, runs, columns)
            except Exception:  # NumPy raises many types
                file.unlink(missing_ok=True)
            else:
                yield part

    def remove(self, identity: Document | None = None) -> None:
        """Delete the folder, if it belongs to the given sweep; a folder in use by another process stays."""
        try:
            with self._lock():
                if identity is not None:
                    self._require(identity)
                self._drop()
        except (Timeout, OSError, ChangedSweepError, SweepFileError):
            return
        with suppress(OSError):
            # After unlocking, as not every system can delete an open file; and only if empty, since another
            # process may have started here.
            (self.folder / _LOCK).unlink(missing_ok=True)
            self.folder.rmdir()


def _require_part(part: Part, runs: int, columns: int) -> None:
    """Raise ValueError unless the arrays fit this number of runs and results."""
    count = len(part.runs)
    sound = (
        [one.dtype.kind for one in (part.runs, part.values, part.failed)] == ["i", "f", "b"]
        and (part.runs.shape, part.values.shape, part.failed.shape) == ((count,), (count, columns), (count,))
        and bool(((part.runs >= 0) & (part.runs < runs)).all())
        and len(part.messages) == np.count_nonzero(part.failed)
    )
    if not sound:
        raise ValueError("is not a part of this sweep")


def require_same(target: Path, kept: Mapping[str, Any], identity: Mapping[str, Any]) -> None:
    """Raise ChangedSweepError if `kept` differs from `identity` in one of the latter's keys."""
    differences = list(_differences({key: kept.get(key) for key in identity}, identity, ""))
    if any(one.startswith("settings ") for one in differences):
        # This implies that the runs differ.
        differences = [one for one in differences if not one.startswith("runs ")]
    if differences:
        raise ChangedSweepError(target, tuple(differences[:5]))


def _differences(old: Any, new: Any, place: str) -> Iterator[str]:
    if isinstance(old, Mapping) or isinstance(new, Mapping):
        old, new = (one if isinstance(one, Mapping) else {} for one in (old, new))
        for key in dict.fromkeys((*old, *new)):
            yield from _differences(old.get(key), new.get(key), f"{place} {key}".strip())
    elif old != new and place.endswith("sha256"):
        yield f"{place.removesuffix('_sha256').removesuffix(' sha256')} has other contents"
    elif old != new:
        yield f"{place} was {json.dumps(old)} and is {json.dumps(new)}"
