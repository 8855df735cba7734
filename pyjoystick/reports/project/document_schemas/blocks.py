"""Building blocks for the schemas of documents: numbers with units, rows, named parameters."""

from __future__ import annotations

from typing import Final

from pyjoystick.reports.project.editor_schemas.blocks import TEXT, Schema, about, array, table

#: A number, or null if it is not finite or not known.
NUMBER: Final[Schema] = {"type": ["number", "null"]}
COUNT: Final[Schema] = {"type": "integer", "minimum": 0}
NUMBERS: Final = array(NUMBER, 0)
TEXTS: Final = array(TEXT, 0)
INTERVAL: Final = about(array(NUMBER, 2, 2), "lower and upper end")


def si(unit: str, text: str = "") -> Schema:
    """Return the schema of a number in this unit."""
    return about(NUMBER, f"{text}, in {unit}" if text else unit)


def entry(*optional: str, **keys: Schema) -> Schema:
    """Return the schema of an object with these keys and no others; all but the optional ones are required.

    Args:
        optional: names of keys that may be missing
        keys: their schemas by name
    """
    return table(tuple(name for name in keys if name not in optional), **keys)


def rows(*optional: str, **columns: Schema) -> Schema:
    """Return the schema of a table: a list of objects with these keys."""
    return array(entry(*optional, **columns), 0)


def or_null(schema: Schema) -> Schema:
    """Extend a schema to allow null, for a value that does not exist."""
    return {"anyOf": [schema, {"type": "null"}]}


def parameters(**columns: Schema) -> Schema:
    """Return the schema of a table of parameters: name in the FMU, value, and these columns."""
    name = about(TEXT, "as in the FMU")
    return rows(name=name, value=about(NUMBER, "in the unit of the FMU"), **columns)


#: Parameters of the simulated joystick.
JOYSTICK: Final = parameters(unit=TEXT)
#: Identity of the FMU that was run.
FMU: Final = entry(path=TEXT, model=TEXT, made_by=TEXT, made_at=TEXT, guid=TEXT)
