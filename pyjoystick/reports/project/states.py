"""States of a project's steps, and plans for them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

State = Literal["missing", "waiting", "working", "done", "unchanged", "failed", "not done"]


@dataclass(frozen=True, slots=True)
class StepState:
    """State of a step.

    Attributes:
        name: name of the step
        state: ``missing`` if laboratory.toml does not ask for it; ``unchanged`` if nothing has changed since
            it was done; ``not done`` if a file that laboratory.toml names does not exist, a step that it
            needs failed, or the run was stopped
        remark: its result, what it is doing, or why it is not done
        notes: doubts about the result, one sentence each
        seconds: how long it took (s)
    """

    name: str
    state: State
    remark: str = ""
    notes: tuple[str, ...] = ()
    seconds: float = 0.0


@dataclass(frozen=True, slots=True)
class ProjectRun:
    """Result of a run of a project.

    Attributes:
        steps: all steps, in order
        notes: notes on the project as a whole, one sentence each
        interrupted: whether Ctrl-C stopped it
    """

    steps: tuple[StepState, ...]
    notes: tuple[str, ...]
    interrupted: bool = False

    def count(self, *states: State) -> int:
        """Count the steps that are in one of these states."""
        return sum(one.state in states for one in self.steps)


@dataclass(frozen=True, slots=True)
class PlannedStep:
    """Plan for a step in the next run.

    Attributes:
        name: name of the step
        plan: ``do``; ``perhaps``: only if its inputs change; ``nothing``; ``missing``: it lacks files, which
            may be outputs of an earlier step
        why: reasons for the plan
    """

    name: str
    plan: Literal["do", "perhaps", "nothing", "missing"]
    why: str


#: Called with all steps whenever one of them has changed.
OnChange = Callable[[tuple[StepState, ...]], None]
