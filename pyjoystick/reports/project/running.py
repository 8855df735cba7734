"""Execution of projects: steps with changes since the last run, and steps that depend on them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import Final

from doit.control import TaskControl
from doit.runner import Runner
from doit.task import Stream
from filelock import FileLock, Timeout

from pyjoystick import fmu
from pyjoystick.reports.project.assembling import Assembly, assemble
from pyjoystick.reports.project.errors import ProjectBusyError, ProjectFileError
from pyjoystick.reports.project.laboratory import LABORATORY_FILE, Laboratory
from pyjoystick.reports.project.laboratory_file import read_laboratory
from pyjoystick.reports.project.outdated import put_back, set_aside
from pyjoystick.reports.project.reporting import Reporter
from pyjoystick.reports.project.state import OUTDATED, Memory
from pyjoystick.reports.project.states import OnChange, ProjectRun
from pyjoystick.reports.project.steps import RESULTS, Find
from pyjoystick.reports.project.tasks import task
from pyjoystick.support import OutputFileError, remove_unfinished

_LOCK: Final = ".pyjoystick/lock"


def run_project(
    folder: str | PathLike[str] = ".", *, find: Find = fmu.find_fmu, on_change: OnChange = lambda steps: None
) -> ProjectRun:
    """Execute the steps of a project that have changed since the last run, and those that depend on them.

    A step is executed if the content of a file that it reads, a setting or the version of pyjoystick has
    changed since its last execution, or if a file that it wrote was modified. A failing step does not stop
    others; its earlier results and those of the steps that depend on it are moved to results/outdated. Files
    are written atomically, and the next run continues an interrupted one.

    Args:
        folder: the project
        find: function that returns the file for the name of an FMU
        on_change: called with the states of all steps whenever one changes

    Raises:
        ProjectFileError: the folder has no laboratory.toml
        InputFileError, SettingsError: laboratory.toml cannot be used
        ProjectBusyError: another process is running the project
        OutputFileError: the state of the project cannot be written, or an outdated result cannot be moved
    """
    lab = laboratory_of(Path(folder))
    with _locked(lab.root):
        return run_assembly(lab.root, assemble(lab, find), on_change)


def run_assembly(root: Path, assembly: Assembly, on_change: OnChange) -> ProjectRun:
    """Execute the steps of a project that need it; the caller must have locked the project."""
    remove_unfinished(root / RESULTS)
    memory = Memory(root)
    put_back(root, memory)
    reporter = Reporter(root, memory, assembly, on_change)
    control = TaskControl([task(step, root, reporter.tell) for step in assembly.steps])
    control.process(None)
    interrupted = False
    try:
        Runner(memory, reporter, continue_=True, stream=Stream(0)).run_all(control.task_dispatcher())
    except KeyboardInterrupt:
        interrupted = True
        reporter.stop()
    notes = assembly.notes
    if not interrupted:
        outdated = set_aside(root, memory, reporter.current)
        notes += (
            (f"results that no longer hold are now in {OUTDATED}: {_named(outdated)}",) if outdated else ()
        )
    return ProjectRun(reporter.states, notes, interrupted)


def _named(files: tuple[str, ...]) -> str:
    names = [name.removeprefix(f"{RESULTS}/") for name in files]
    return ", ".join(names if len(names) < 6 else [*names[:4], f"{len(names) - 4} more"])


def laboratory_of(folder: Path) -> Laboratory:
    """Read the ``laboratory.toml`` of a project; raises as `run_project`."""
    path = folder / LABORATORY_FILE
    if not path.is_file():
        raise ProjectFileError(folder)
    return read_laboratory(path)


@contextmanager
def _locked(root: Path) -> Iterator[None]:
    """Lock the project against runs by other processes."""
    path = root / _LOCK
    lock = FileLock(path, timeout=0)
    try:
        path.parent.mkdir(exist_ok=True)
        lock.acquire()
    except Timeout:
        raise ProjectBusyError(root) from None
    except OSError as error:
        raise OutputFileError(path, str(error.strerror)) from error
    try:
        yield
    finally:
        lock.release()
