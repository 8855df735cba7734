"""Creation of projects."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Final

from pyjoystick import laboratory
from pyjoystick.reports.project.editor_schemas.files import write_schemas
from pyjoystick.reports.project.errors import ProjectExistsError
from pyjoystick.reports.project.laboratory import LABORATORY_FILE
from pyjoystick.support import OutputFileError, check_outputs, write_text

_README: Final = "README.md"
#: Folder in which editors find the schemas, relative to the project.
SCHEMAS: Final = ".pyjoystick/schemas"
_TEMPLATE: Final = Path(__file__).with_name("template")
#: The ``laboratory.toml`` of the synthetic laboratory.
EXAMPLE_LABORATORY: Final = _TEMPLATE / "example.toml"


def new_project(folder: str | PathLike[str], *, example: bool = False) -> None:
    """Create a project: a commented ``laboratory.toml``, a README and folders for data.

    Args:
        folder: folder of the project, created if it does not exist; its files are not overwritten
        example: whether to add the files of a synthetic laboratory, so that the project can be run as it is

    Raises:
        ProjectExistsError: the folder already has a ``laboratory.toml`` or, for an example, data or truth
        OutputFileError: a file cannot be written
    """
    root = Path(folder)
    for name in (LABORATORY_FILE, "data", "truth") if example else (LABORATORY_FILE,):
        if (root / name).exists():
            raise ProjectExistsError(root / name)
    check_outputs(root / LABORATORY_FILE)
    if example:
        laboratory.write_synthetic_laboratory(root / "data", root / "truth")
    for name in () if example else ("markers", "records"):
        _make_folder(root / "data" / name)
    write_schemas(root / SCHEMAS)
    if not (root / _README).exists():
        write_text(root / _README, (_TEMPLATE / _README).read_text(encoding="utf-8"))
    source = EXAMPLE_LABORATORY if example else _TEMPLATE / LABORATORY_FILE
    write_text(root / LABORATORY_FILE, source.read_text(encoding="utf-8"))


def _make_folder(path: Path) -> None:
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputFileError(path, f"the folder cannot be created: {error.strerror}") from error
