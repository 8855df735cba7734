"""Steps as doit tasks: which of them to execute and why, and their execution."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote

from doit.exceptions import TaskFailed
from doit.task import Task

from pyjoystick import identification
from pyjoystick.reports.project.state import standing
from pyjoystick.reports.project.steps import Step, digest
from pyjoystick.support import OutputFileError, PyJoystickError, version_of, write_text

_VERSION: Final = "pyjoystick"
#: Folder of tracebacks, relative to the project.
FAULTS: Final = ".pyjoystick/faults"


class SameSettings:
    """Check that a step's settings and the version of pyjoystick are unchanged since it was done."""

    def __init__(self, step: Step) -> None:
        self._now = {**_flat(step.settings), _VERSION: version_of("pyjoystick")}

    def configure_task(self, task: Task) -> None:
        """Make doit record the settings when the step is done."""
        task.value_savers.append(lambda: {"settings": self._now})

    def __call__(self, task: Task, values: Mapping[str, Any]) -> bool:
        """Return whether nothing has changed; called by doit."""
        return values.get("settings") == self._now

    def why(self, values: Mapping[str, Any]) -> list[str]:
        """Return what has changed, one phrase per setting."""
        before = values.get("settings", {})
        names = dict.fromkeys((*before, *self._now))
        return [
            f"{name} was {_shown(before.get(name))} and is {_shown(self._now.get(name))}"
            for name in names
            if before.get(name) != self._now.get(name)
        ]


class SameFiles:
    """Check that the files that a step wrote are as it left them."""

    def __init__(self, root: Path) -> None:
        self._root = root

    def __call__(self, task: Task, values: Mapping[str, Any]) -> bool:
        """Return whether all files are unchanged; called by doit."""
        return not self.why(values)

    def why(self, values: Mapping[str, Any]) -> list[str]:
        """Return which files are missing or changed, one phrase per file."""
        found = []
        for name, content in values.get("files", {}).items():
            path = standing(self._root, name)
            if not path.is_file():
                found.append(f"{name} is missing")
            elif digest(path) != content:
                found.append(f"{name} was changed")
        return found


def task_name(step: Step | str) -> str:
    """Return the name of a step in a form that doit allows."""
    return quote(step if isinstance(step, str) else step.name, safe=" ")


def task(step: Step, root: Path, tell: Callable[[Step, str], None]) -> Task:
    """Convert a step to a task."""

    def act() -> dict[str, Any] | TaskFailed:
        try:
            done = step.work(lambda text: tell(step, text))
            files = {name: digest(root / name) for name in done.files}
        except identification.FitInterruptedError:
            raise KeyboardInterrupt from None
        except PyJoystickError as error:
            return TaskFailed(str(error), report=False)
        except Exception as error:  # an internal error of one step must not stop the others
            return TaskFailed(_fault(step, root, error), error)
        return {"remark": done.remark, "notes": list(done.notes), "files": files}

    return Task(
        task_name(step),
        [act],
        file_dep=list(step.inputs),
        targets=list(step.outputs),
        uptodate=[SameSettings(step), SameFiles(root)],
        io={"capture": False},
    )


def _fault(step: Step, root: Path, error: Exception) -> str:
    """Describe an internal error; its traceback is written to a file for the developers."""
    name = f"{FAULTS}/{quote(step.name, safe=' ').replace(' ', '_')}.txt"
    what = f"internal error: {type(error).__name__}: {error}"
    try:
        write_text(root / name, "".join(traceback.format_exception(error)))
    except OutputFileError:
        return what
    return f"{what} (traceback in {name})"


def _flat(settings: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Flatten nested settings to dotted names."""
    found: dict[str, Any] = {}
    for name, value in settings.items():
        found |= (
            _flat(value, f"{prefix}{name}.") if isinstance(value, Mapping) else {f"{prefix}{name}": value}
        )
    return found


def _shown(value: Any) -> str:
    text = "not given" if value is None else str(value)
    return f"{text[:12]}..." if len(text) > 40 else text
