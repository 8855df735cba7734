"""Outdated results: set aside after a run, and put back before the next run, which may need them.

Results of an earlier run remain if their step fails, cannot be executed or is no longer part of the project.
Next to the results of the current run, they would be mistaken for these.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Mapping
from pathlib import Path

from pyjoystick.reports.project.state import OUTDATED, Memory, aside_of, standing
from pyjoystick.reports.project.steps import RESULTS, digest
from pyjoystick.support import OutputFileError


def put_back(root: Path, memory: Memory) -> None:
    """Put back the outdated results that are as their step left them; raises OutputFileError."""
    for files in memory.files().values():
        for name, content in files.items():
            found = standing(root, name)
            if found != root / name and digest(found) == content:
                _move(root, found, root / name)


def set_aside(root: Path, memory: Memory, current: Iterable[str]) -> tuple[str, ...]:
    """Set aside the results of steps that are not current; files that were edited stay.

    Args:
        root: the project
        memory: record of the files that each step wrote
        current: names of the tasks whose results are up to date

    Returns:
        the moved files, relative to the project

    Raises:
        OutputFileError: a file cannot be moved
    """
    remembered = memory.files()
    names = set(current)
    held = {name for task in names for name in remembered.get(task, {})}
    moved: list[str] = []
    for task, files in remembered.items():
        for name, content in files.items() if task not in names else ():
            place, aside = root / name, aside_of(root, name)
            if name not in held and aside is not None and _is(place, content):
                _move(root, place, aside)
                moved.append(name)
    _remove_forgotten(root, remembered.values())
    return tuple(sorted(moved))


def remove_superseded(root: Path, before: Mapping[str, str], after: Iterable[str]) -> None:
    """Delete files that a step wrote the last time but not this time; files that were edited stay."""
    for name in set(before) - set(after):
        if _is(root / name, before[name]):
            (root / name).unlink(missing_ok=True)
            _remove_empty((root / name).parent, root / RESULTS)


def _is(path: Path, content: str) -> bool:
    return path.is_file() and digest(path) == content


def _move(root: Path, source: Path, target: Path) -> None:
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        source.replace(target)
    except OSError as error:
        raise OutputFileError(target, str(error.strerror)) from error
    _remove_empty(source.parent, root / RESULTS)


def _remove_forgotten(root: Path, remembered: Iterable[Mapping[str, str]]) -> None:
    """Delete outdated results that would never be put back."""
    files = (item for one in remembered for item in one.items())
    wanted = {(aside_of(root, name), content) for name, content in files if not (root / name).is_file()}
    for path in sorted((root / OUTDATED).rglob("*"), reverse=True):
        if path.is_file() and (path, digest(path)) not in wanted:
            path.unlink(missing_ok=True)
            _remove_empty(path.parent, root / RESULTS)


def _remove_empty(folder: Path, top: Path) -> None:
    """Remove a folder and its parents below `top` as long as they are empty."""
    with contextlib.suppress(OSError):
        while folder != top and folder.is_relative_to(top):
            folder.rmdir()
            folder = folder.parent
