"""JSON schemas of all TOML files, with which editors complete keys and mark errors, and of documents.

A schema covers names, types and choices. Errors that depend on an FMU or on several values together are left
to the reader of the file, see `pyjoystick check`. No schema refuses a file that its reader accepts.
"""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path

from pyjoystick.reports.project.document_schemas.document import document_schema
from pyjoystick.reports.project.editor_schemas.blocks import Schema
from pyjoystick.reports.project.editor_schemas.laboratory import laboratory_schema
from pyjoystick.reports.project.editor_schemas.settings import (
    explore_schema,
    fit_schema,
    parameter_schema,
    sweep_schema,
)
from pyjoystick.support import write_text


def schemas() -> dict[str, Schema]:
    """Return the schemas by file name: ``laboratory.schema.json`` and so on."""
    titled = {
        "laboratory": ("A project of pyjoystick: what a laboratory's files are", laboratory_schema()),
        "joystick": ("The parameters of a joystick, in SI units", parameter_schema()),
        "sweep": ("The settings of a sweep", sweep_schema()),
        "fit": ("The settings of a fit", fit_schema()),
        "explore": ("What the live page of a model shows, in SI units", explore_schema()),
        "document": ("What commands write with --json, in SI units", document_schema()),
    }
    draft = {"$schema": "http://json-schema.org/draft-07/schema#"}
    return {f"{name}.schema.json": draft | {"title": title} | one for name, (title, one) in titled.items()}


def write_schemas(folder: str | PathLike[str]) -> list[Path]:
    """Write all schemas to a folder and return their files; raises OutputFileError."""
    paths = []
    for name, schema in schemas().items():
        paths.append(Path(folder) / name)
        write_text(paths[-1], json.dumps(schema, indent=1, ensure_ascii=False) + "\n")
    return paths
