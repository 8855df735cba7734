"""Record of what was done in a project, and from what: doit's database, by content, written atomically."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from doit.dependency import Dependency, DependencyStatus, FileChangedChecker, JsonDB
from doit.task import Task

from pyjoystick.project.steps import RESULTS, digest
from pyjoystick.support import write_text

#: Relative to the project.
STATE: Final = ".pyjoystick/state.json"
#: Where doit has the values of a task.
_VALUES: Final = "_values_:"


#: Where outdated results are, relative to the project, under their names relative to the results.
OUTDATED: Final = f"{RESULTS}/outdated"


def aside_of(root: Path, name: str) -> Path | None:
    """Where a result is when it is outdated; None for what is no result."""
    return root / OUTDATED / name.removeprefix(f"{RESULTS}/") if name.startswith(f"{RESULTS}/") else None


def standing(root: Path, name: str) -> Path:
    """Where a file of the project is: in its place or, until it is put back, among outdated ones."""
    place, aside = root / name, aside_of(root, name)
    return aside if aside is not None and not place.is_file() and aside.is_file() else place


class Contents(FileChangedChecker):  # type: ignore[misc]  # doit is not annotated
    """Files by their content, not by their times; names are relative to the project.

    What counts is the content when a step began: one that changes under it is done again the next time.
    """

    def __init__(self, root: Path) -> None:
        self._root = root
        self._taken: dict[str, str] = {}

    def exists(self, file_path: str) -> bool:
        """Whether a step has what it makes for others: `Kept` knows, and a doubtful fit makes no joystick."""
        return True

    def info(self, file_path: str) -> object:
        """Raises OSError where there is none."""
        return standing(self._root, file_path).stat()

    def take(self, names: set[str]) -> None:
        """Note the content of the files that a step is about to read."""
        self._taken = {name: digest(self._root / name) for name in names}

    def check_modified(self, file_path: str, file_stat: object, state: str) -> bool:
        """Whether a file has changed."""
        return state != digest(standing(self._root, file_path))

    def get_state(self, dep: str, current_state: str | None) -> str:
        """What is remembered of a file."""
        return self._taken[dep]


class MemoryFile(JsonDB):  # type: ignore[misc]  # doit is not annotated
    """A JSON file; what cannot be read of it counts as not done."""

    def _load(self) -> dict[str, dict[str, Any]]:
        try:
            found = json.loads(Path(self.name).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        whole = isinstance(found, dict) and all(_is_remembered(one) for one in found.values())
        return found if whole else {}

    def dump(self) -> None:
        """Write the file."""
        write_text(Path(self.name), json.dumps(self._db, indent=1, sort_keys=True))


def _is_remembered(one: object) -> bool:
    """Whether it can be what is remembered of a step."""
    values = one.get(_VALUES, {}) if isinstance(one, dict) else None
    files = values.get("files", {}) if isinstance(values, dict) else None
    return isinstance(files, dict) and all(isinstance(content, str) for content in files.values())


class Memory(Dependency):  # type: ignore[misc]  # doit is not annotated
    """The memory of a project, which holds from when a step was last done.

    A later failure takes nothing back: what was done from the same files, with the same settings, is done as
    long as its results are as it left them.
    """

    def __init__(self, root: Path) -> None:
        super().__init__(MemoryFile, str(root / STATE), checker_cls=lambda: Contents(root))
        self._root = root

    def get_status(
        self, task: Task, tasks_dict: Mapping[str, Task] | None, get_log: bool = False
    ) -> DependencyStatus:
        """As doit has it, but a file that is missing counts also where something else has changed."""
        found = super().get_status(task, tasks_dict, get_log)
        missing = [name for name in sorted(task.file_dep) if not standing(self._root, name).is_file()]
        if missing:
            found.status, found.error_reason = "error", f"{', '.join(missing)} is not there"
        return found

    def remove_success(self, task: Task) -> None:
        """Remember all the same."""

    def files(self) -> dict[str, dict[str, str]]:
        """The digests of what every step has left, by task and name, also of steps that are no more."""
        return {task: one.get(_VALUES, {}).get("files", {}) for task, one in self.backend._db.items()}

    def save(self) -> None:
        """Write the file."""
        self.backend.dump()
