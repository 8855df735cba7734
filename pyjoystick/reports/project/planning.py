"""Plans: what a run of a project would do, and why."""

from __future__ import annotations

from collections.abc import Container, Mapping
from os import PathLike
from pathlib import Path

from doit.task import Task

from pyjoystick import fmu
from pyjoystick.reports.project.assembling import Assembly, assemble
from pyjoystick.reports.project.running import laboratory_of
from pyjoystick.reports.project.state import Memory, standing
from pyjoystick.reports.project.states import PlannedStep
from pyjoystick.reports.project.steps import Find, Step
from pyjoystick.reports.project.tasks import task, task_name


def plan_project(folder: str | PathLike[str] = ".", *, find: Find = fmu.find_fmu) -> tuple[PlannedStep, ...]:
    """Determine what `run_project` would do, and why, without writing anything.

    Raises:
        ProjectFileError, InputFileError, SettingsError: as `run_project`
    """
    lab = laboratory_of(Path(folder))
    return plan_assembly(lab.root, assemble(lab, find))


def plan_assembly(root: Path, assembly: Assembly) -> tuple[PlannedStep, ...]:
    """Determine which steps of a project a run would execute, and why."""
    memory = Memory(root)
    tasks = {step.name: task(step, root, lambda step, text: None) for step in assembly.steps}
    makers = {output: step.name for step in assembly.steps for output in step.outputs}
    planned: dict[str, PlannedStep] = {}
    for step in assembly.steps:
        before = {one: planned[makers[one]] for one in step.inputs if one in makers}
        uncertain = dict.fromkeys(one.name for one in before.values() if one.plan in ("do", "perhaps"))
        perhaps = [one.name for one in before.values() if one.plan == "perhaps"]
        reasons = _reasons(step, tasks[step.name], memory, makers, perhaps)
        lacking = dict.fromkeys(one for file, one in before.items() if _is_not_made(root, file, one))
        if lacking:
            why = "; ".join(_needed(one, memory) for one in lacking)
            planned[step.name] = PlannedStep(step.name, "missing", why)
        elif reasons:
            planned[step.name] = PlannedStep(step.name, "do", "; ".join(reasons))
        elif uncertain:
            why = f"if the result of {' or '.join(uncertain)} changes"
            planned[step.name] = PlannedStep(step.name, "perhaps", why)
        else:
            planned[step.name] = PlannedStep(step.name, "nothing", "nothing has changed")
    missing = (PlannedStep(one.name, "missing", one.reason) for one in assembly.missing)
    return (*missing, *planned.values())


def _is_not_made(root: Path, name: str, maker: PlannedStep) -> bool:
    """Return whether a step leaves this output missing, like a doubtful fit, which writes no joystick."""
    return maker.plan == "missing" or (maker.plan == "nothing" and not standing(root, name).is_file())


def _needed(maker: PlannedStep, memory: Memory) -> str:
    remark = memory.get_values(task_name(maker.name)).get("remark") if maker.plan == "nothing" else ""
    return f"needs the {maker.name}, which {remark}" if remark else f"needs the {maker.name}"


def _reasons(
    step: Step, one: Task, memory: Memory, makers: Mapping[str, str], uncertain: Container[str]
) -> list[str]:
    """Return the reasons for executing a step; empty if it is up to date, or if that is still uncertain."""
    values = memory.get_values(task_name(step))
    status = memory.get_status(one, None, get_log=True)
    if status.status == "up-to-date":
        return []
    if not values:
        return ["it has not been done yet"]
    found: list[str] = []
    for kind, what in status.reasons.items():
        if kind == "changed_file_dep":
            found += [f"{name} has changed" for name in sorted(what)]
        elif kind == "missing_file_dep":
            by = {name: makers.get(name, "nothing") for name in sorted(what)}
            found += [f"{name} will be written by {by[name]}" for name in by if by[name] not in uncertain]
        elif kind == "added_file_dep":
            found += [f"it now reads {name}" for name in what]
        elif kind == "removed_file_dep":
            found += [f"it no longer reads {name}" for name in what]
        elif kind == "uptodate_false":
            found += [why for check, *_ in what for why in check.why(values)]
    return found
