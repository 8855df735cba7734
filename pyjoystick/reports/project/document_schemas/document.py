"""Schema of all documents: their common keys, and the content specific to each command."""

from __future__ import annotations

from typing import Final

from pyjoystick.reports.project.document_schemas import identification, measurements, models, motions
from pyjoystick.reports.project.document_schemas.blocks import TEXTS, entry
from pyjoystick.reports.project.editor_schemas.blocks import TEXT, Schema, about, mapping

#: Content of each command's document, and the names of its optional keys.
_CONTENTS: Final[dict[str, tuple[dict[str, Schema], tuple[str, ...]]]] = {
    "info": (models.INFO, ()),
    "parameters": (models.PARAMETERS, ()),
    "import record": (measurements.RECORD, ()),
    "import markers": (measurements.MARKERS, ()),
    "import accelerometer": (measurements.ACCELEROMETER, ()),
    "import load-curve": (measurements.LOAD_CURVE, ()),
    "import swing": (measurements.SWING, ()),
    "import parts": (measurements.PARTS, ()),
    "peaks": (identification.PEAKS, ()),
    "fit": (identification.FIT, ()),
    "design": (identification.DESIGN, ()),
    "budget": (identification.BUDGET, ()),
    "free-oscillation": (motions.FREE_OSCILLATION, motions.FREE_OSCILLATION_OPTIONAL),
    "torque": (motions.TORQUE, ()),
    "response": (motions.RESPONSE, motions.RESPONSE_OPTIONAL),
    "vibration": (motions.VIBRATION, ()),
    "compare": (models.COMPARE, models.COMPARE_OPTIONAL),
}


def document_schema() -> Schema:
    """Return the schema of the documents of all commands."""
    envelope: dict[str, Schema] = {
        "notes": about(TEXTS, "what the command noted on its input and result"),
        "made_with": about(mapping(TEXT), "versions by package"),
    }
    definitions = {
        _key(command): entry(*optional, command={"const": command}, **content, **envelope)
        for command, (content, optional) in _CONTENTS.items()
    }
    return {
        "type": "object",
        "required": ["command", *envelope],
        "properties": {"command": {"enum": list(_CONTENTS)}},
        "allOf": [
            {
                "if": {"properties": {"command": {"const": command}}},
                "then": {"$ref": f"#/definitions/{_key(command)}"},
            }
            for command in _CONTENTS
        ],
        "definitions": definitions,
    }


def _key(command: str) -> str:
    """Return the name of a command's definition, in a form that is valid in a URI reference."""
    return command.replace(" ", "-")
