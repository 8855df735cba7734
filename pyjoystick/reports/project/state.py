"""State of a project: doit's database of finished steps and contents of files, written atomically."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from doit.dependency import Dependency, DependencyStatus, FileChangedChecker, JsonDB
from doit.task import Task

from pyjoystick.reports.project.steps import RESULTS, digest
from pyjoystick.support import write_text

#: File of the state, relative to the project.
STATE: Final = ".pyjoystick/state.json"
#: Key under which doit stores the values of a task.
_VALUES: Final = "_values_:"
_NAMES: Final = "deps:"
_RESULT: Final = "result:"


#: Folder of outdated results, relative to the project; they keep their names relative to the results.
OUTDATED: Final = f"{RESULTS}/outdated"


def aside_of(root: Path, name: str) -> Path | None:
    """Return the place for a result that is outdated; None for a file that is not a result."""
    return root / OUTDATED / name.removeprefix(f"{RESULTS}/") if name.startswith(f"{RESULTS}/") else None


def standing(root: Path, name: str) -> Path:
    """Return where a file of the project is: in its place or, until it is put back, among outdated files."""
    place, aside = root / name, aside_of(root, name)
    return aside if aside is not None and not place.is_file() and aside.is_file() else place


class Contents(FileChangedChecker):  # type: ignore[misc]  # doit is not annotated
    """Detection of changed files by content, not by time; names are relative to the project.

    The content at the beginning of a step counts: if a file changes during a step, the next run repeats it.
    """

    def __init__(self, root: Path) -> None:
        self._root = root
        self._taken: dict[str, str] = {}

    def exists(self, file_path: str) -> bool:
        """Return True: `SameFiles` checks the files of a step, and a doubtful fit writes no joystick."""
        return True

    def info(self, file_path: str) -> object:
        """Return the status of a file; raises OSError if it does not exist."""
        return standing(self._root, file_path).stat()

    def take(self, names: set[str]) -> None:
        """Record the content of the files that a step is about to read."""
        self._taken = {name: digest(self._root / name) for name in names}

    def check_modified(self, file_path: str, file_stat: object, state: str) -> bool:
        """Return whether a file has changed."""
        return state != digest(standing(self._root, file_path))

    def get_state(self, dep: str, current_state: str | None) -> str:
        """Return the digest of a file, as recorded when the step began."""
        return self._taken[dep]


class MemoryFile(JsonDB):  # type: ignore[misc]  # doit is not annotated
    """JSON file of the state; if it cannot be read, no step counts as done."""

    def _load(self) -> dict[str, dict[str, Any]]:
        path = Path(self.name)
        try:
            found = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
        except (OSError, ValueError, RecursionError):
            return {}
        whole = isinstance(found, dict) and all(_is_remembered(one) for one in found.values())
        return found if whole else {}

    def dump(self) -> None:
        """Write the file."""
        write_text(Path(self.name), json.dumps(self._db, indent=1, sort_keys=True))


def _is_remembered(one: object) -> bool:
    """Return whether an object has the form of a recorded step: digests by file, and values."""
    if not isinstance(one, dict):
        return False
    values, names, digests = one.get(_VALUES, {}), one.get(_NAMES, []), dict(one)
    for key in (_VALUES, _NAMES, _RESULT):
        digests.pop(key, None)
    return (
        isinstance(values, dict)
        and isinstance(values.get("settings", {}), dict)
        and _are_texts(values.get("files", {}))
        and isinstance(names, list)
        and all(isinstance(name, str) for name in names)
        and _are_texts(digests)
    )


def _are_texts(by_name: object) -> bool:
    return isinstance(by_name, dict) and all(isinstance(one, str) for one in by_name.values())


class Memory(Dependency):  # type: ignore[misc]  # doit is not annotated
    """Memory of a project, which keeps the last successful execution of each step.

    A later failure does not erase it: a step that was done with the same files and settings counts as done as
    long as its results are as it left them.
    """

    def __init__(self, root: Path) -> None:
        super().__init__(MemoryFile, str(root / STATE), checker_cls=lambda: Contents(root))
        self._root = root

    def get_status(
        self, task: Task, tasks_dict: Mapping[str, Task] | None, get_log: bool = False
    ) -> DependencyStatus:
        """Return doit's status, but an error for a missing input even if something else has changed."""
        found = super().get_status(task, tasks_dict, get_log)
        missing = [name for name in sorted(task.file_dep) if not standing(self._root, name).is_file()]
        if missing:
            found.status, found.error_reason = "error", f"{', '.join(missing)} is not there"
        return found

    def remove_success(self, task: Task) -> None:
        """Keep the record of the last success."""

    def files(self) -> dict[str, dict[str, str]]:
        """Return the digests of the files that each step wrote, by task and name, including removed steps."""
        return {task: one.get(_VALUES, {}).get("files", {}) for task, one in self.backend._db.items()}

    def save(self) -> None:
        """Write the file."""
        self.backend.dump()
