"""Progress of a run: doit's reports on its tasks, saved immediately and passed on."""

from __future__ import annotations

import logging
import time
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from doit.exceptions import BaseFail
from doit.reporter import ZeroReporter
from doit.task import Task

from pyjoystick.reports.project.assembling import Assembly
from pyjoystick.reports.project.outdated import remove_superseded
from pyjoystick.reports.project.state import Memory
from pyjoystick.reports.project.states import OnChange, StepState
from pyjoystick.reports.project.steps import Step
from pyjoystick.reports.project.tasks import task_name

_LOG = logging.getLogger(__name__)
_HOLDS: Final = ("done", "unchanged")


class Reporter(ZeroReporter):  # type: ignore[misc]  # doit is not annotated
    """Reporter for doit that tracks the states of all steps.

    A step is recorded as soon as it is done, also in the state file: a run that is killed loses only the step
    that it was executing. Files that this step had already written then differ from those recorded.
    """

    def __init__(self, root: Path, memory: Memory, assembly: Assembly, on_change: OnChange) -> None:
        self._root, self._memory, self._on_change = root, memory, on_change
        self._steps = {task_name(step): step for step in assembly.steps}
        self._makers = {output: step.name for step in assembly.steps for output in step.outputs}
        self._missing = tuple(
            StepState(one.name, "not done" if one.named else "missing", one.reason)
            for one in assembly.missing
        )
        self._states = {step.name: StepState(step.name, "waiting") for step in assembly.steps}
        self._begun = 0.0
        self._before: dict[str, str] = {}
        on_change(self.states)

    @property
    def states(self) -> tuple[StepState, ...]:
        """States of all steps, in order."""
        return (*self._missing, *self._states.values())

    @property
    def current(self) -> list[str]:
        """Names of the tasks whose results are up to date."""
        return [task for task, step in self._steps.items() if self._states[step.name].state in _HOLDS]

    def tell(self, step: Step, text: str) -> None:
        """Report what a step is doing."""
        self._set(step.name, StepState(step.name, "working", text))

    def stop(self) -> None:
        """Report all unfinished steps as not done."""
        for name, one in self._states.items():
            if one.state in ("waiting", "working"):
                self._states[name] = replace(one, state="not done", remark="stopped")
        self._on_change(self.states)

    def execute_task(self, task: Task) -> None:
        """Record the content of a step's inputs, and report that it begins."""
        self._memory.checker.take(task.file_dep)
        self._before = self._memory.get_values(task.name).get("files", {})
        self._begun = time.monotonic()
        _LOG.info("step %s, from %s", self._steps[task.name].name, ", ".join(sorted(task.file_dep)))
        self.tell(self._steps[task.name], "")

    def add_success(self, task: Task) -> None:
        """Save that a step is done, delete the files that it no longer writes, and report it."""
        self._memory.save()
        remove_superseded(self._root, self._before, task.values["files"])
        self._finish(task, "done", task.values, time.monotonic() - self._begun)

    def skip_uptodate(self, task: Task) -> None:
        """Report that a step is unchanged."""
        self._finish(task, "unchanged", self._memory.get_values(task.name), 0.0)

    def add_failure(self, task: Task, fail: BaseFail) -> None:
        """Report that a step failed, or that it cannot be executed and why."""
        step = self._steps[task.name]
        if task.executed:
            self._set(step.name, StepState(step.name, "failed", fail.message))
            return
        bad = {
            self._makers[one]: None
            for one in step.inputs
            if one in self._makers and self._states[self._makers[one]].state in ("failed", "not done")
        }
        wanting = [one for one in step.inputs if not (self._root / one).is_file()]
        makers = [self._makers[one] for one in wanting if one in self._makers]
        if bad:
            reason = f"needs {' and '.join(bad)}"
        elif makers:
            reason = "; ".join(f"needs the {one}, which {self._states[one].remark}" for one in makers)
        else:
            reason = f"{', '.join(wanting)} no longer exists" if wanting else fail.message
        self._set(step.name, StepState(step.name, "not done", reason))

    def runtime_error(self, msg: str) -> None:
        """Raise RuntimeError: doit cannot continue, because the tasks contradict each other."""
        raise RuntimeError(msg)

    def _finish(self, task: Task, state: Any, values: dict[str, Any], seconds: float) -> None:
        name = self._steps[task.name].name
        notes = tuple(values.get("notes", ()))
        self._set(name, StepState(name, state, values.get("remark", ""), notes, seconds))

    def _set(self, name: str, state: StepState) -> None:
        self._states[name] = state
        self._on_change(self.states)
