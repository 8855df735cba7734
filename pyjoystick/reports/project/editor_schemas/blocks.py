"""Building blocks for schemas: types, tables, lists and quantities with a unit."""

from __future__ import annotations

from typing import Any, Final

from pyjoystick import motion

Schema = dict[str, Any]

TEXT: Final[Schema] = {"type": "string"}
NUMBER: Final[Schema] = {"type": "number"}
FLAG: Final[Schema] = {"type": "boolean"}
COUNT: Final[Schema] = {"type": "integer", "minimum": 1}
#: A number, or text with a unit.
AMOUNT: Final[Schema] = {"type": ["number", "string"]}
#: A value of a parameter or input.
VALUE: Final[Schema] = {"type": ["number", "string", "boolean"]}


def table(required: tuple[str, ...] = (), /, **keys: Schema) -> Schema:
    """Return the schema of a table with these keys and no others."""
    found: Schema = {"type": "object", "properties": keys, "additionalProperties": False}
    return found | ({"required": list(required)} if required else {})


def mapping(values: Schema) -> Schema:
    """Return the schema of a table with any keys, and with values of one kind."""
    return {"type": "object", "additionalProperties": values}


def array(of: Schema, least: int = 1, most: int | None = None) -> Schema:
    """Return the schema of a list of `least` to `most` entries of one kind; None means no upper limit."""
    return {"type": "array", "items": of, "minItems": least} | ({} if most is None else {"maxItems": most})


def about(schema: Schema, text: str) -> Schema:
    """Add a description, which editors show, to a schema."""
    return schema | {"description": text}


def quantity(kind: str, text: str = "") -> Schema:
    """Return the schema of a number in the SI unit, or of text with a unit of this kind."""
    si, *others = motion.UNITS[kind]
    unit = f"{si}, or text with a unit: {', '.join(others)}" if others else si
    return about(AMOUNT, f"{text} ({unit})".strip())
