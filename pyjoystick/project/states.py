"""States of a project's steps, and plans for them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

State = Literal["missing", "waiting", "working", "done", "unchanged", "failed", "not done"]


@dataclass(frozen=True, slots=True)
class StepState:
    """A step and how far it is.

    Attributes:
        name: of the step
        state: ``missing`` as laboratory.toml does not ask for it; ``unchanged`` since it was done;
            ``not done`` as a file that laboratory.toml names is not there, as a step before it failed, or as
            the run was stopped
        remark: its result, what it is doing, or why it is not done
        notes: what is doubtful, a sentence each
        seconds: how long it took
    """

    name: str
    state: State
    remark: str = ""
    notes: tuple[str, ...] = ()
    seconds: float = 0.0


@dataclass(frozen=True, slots=True)
class ProjectRun:
    """What a run of a project did.

    Attributes:
        steps: all steps, in their order
        notes: on the project as a whole, a sentence each
        interrupted: whether Ctrl-C stopped it
    """

    steps: tuple[StepState, ...]
    notes: tuple[str, ...]
    interrupted: bool = False

    def count(self, *states: State) -> int:
        """How many steps are in one of some states."""
        return sum(one.state in states for one in self.steps)


@dataclass(frozen=True, slots=True)
class PlannedStep:
    """What a run would do with a step.

    Attributes:
        name: of the step
        plan: ``do``; ``perhaps``, if its inputs change; ``nothing``; ``missing`` if it lacks files, which may
            be those of an earlier step
        why: the reasons
    """

    name: str
    plan: Literal["do", "perhaps", "nothing", "missing"]
    why: str


#: Called with all steps whenever one of them has changed.
OnChange = Callable[[tuple[StepState, ...]], None]
