"""JSON schemas of all TOML files, with which editors complete keys and mark mistakes, and of documents.

A schema knows names, types and choices. Mistakes that depend on an FMU or on several values together are
left to the reader of the file, `pyjoystick check`. No schema refuses what its reader takes.
"""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path

from pyjoystick.project.document_schemas.document import document_schema
from pyjoystick.project.editor_schemas.blocks import Schema
from pyjoystick.project.editor_schemas.laboratory import laboratory_schema
from pyjoystick.project.editor_schemas.settings import (
    explore_schema,
    fit_schema,
    parameter_schema,
    sweep_schema,
)
from pyjoystick.support import write_text


def schemas() -> dict[str, Schema]:
    """The schemas by file name: ``laboratory.schema.json`` and so on."""
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
    """Write all schemas into a folder; returns the files, and raises OutputFileError."""
    paths = []
    for name, schema in schemas().items():
        paths.append(Path(folder) / name)
        write_text(paths[-1], json.dumps(schema, indent=1, ensure_ascii=False) + "\n")
    return paths
