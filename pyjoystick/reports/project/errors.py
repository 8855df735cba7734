"""Errors of projects."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from pyjoystick.support import PyJoystickError


@dataclass(eq=False)
class ProjectFileError(PyJoystickError):
    """The folder is not a project.

    Attributes:
        folder: the folder
    """

    folder: Path
    _message = "{folder} has no laboratory.toml; `pyjoystick new {folder}` writes one"


@dataclass(eq=False)
class ProjectExistsError(PyJoystickError):
    """A new project would overwrite a file.

    Attributes:
        path: the file
    """

    path: Path
    _message = "{path} exists; a new project does not overwrite files"


@dataclass(eq=False)
class ProjectBusyError(PyJoystickError):
    """Another process is running the project.

    Attributes:
        folder: the project
    """

    folder: Path
    _message = "{folder} is being run by another process; wait until it has ended"
