"""What the schemas of documents are made of: numbers with units, rows, things with a name."""

from __future__ import annotations

from typing import Final

from pyjoystick.project.editor_schemas.blocks import TEXT, Schema, about, array, table

#: A number, or null for one that is not finite or not known.
NUMBER: Final[Schema] = {"type": ["number", "null"]}
COUNT: Final[Schema] = {"type": "integer", "minimum": 0}
NUMBERS: Final = array(NUMBER, 0)
TEXTS: Final = array(TEXT, 0)
INTERVAL: Final = about(array(NUMBER, 2, 2), "lower and upper end")


def si(unit: str, text: str = "") -> Schema:
    """A number in this unit."""
    return about(NUMBER, f"{text}, in {unit}" if text else unit)


def entry(*optional: str, **keys: Schema) -> Schema:
    """An object with these keys and no others, all of them but the optional ones.

    Args:
        optional: names of keys that may be missing
        keys: their schemas by name
    """
    return table(tuple(name for name in keys if name not in optional), **keys)


def rows(*optional: str, **columns: Schema) -> Schema:
    """A table: a list of objects with these keys."""
    return array(entry(*optional, **columns), 0)


def or_null(schema: Schema) -> Schema:
    """The same, or null where there is none."""
    return {"anyOf": [schema, {"type": "null"}]}


def parameters(**columns: Schema) -> Schema:
    """Parameters by their names in the FMU, with a value each and these columns."""
    name = about(TEXT, "as in the FMU")
    return rows(name=name, value=about(NUMBER, "in the unit of the FMU"), **columns)


#: The joystick that was run.
JOYSTICK: Final = parameters(unit=TEXT)
#: Which FMU was run.
FMU: Final = entry(path=TEXT, model=TEXT, made_by=TEXT, made_at=TEXT, guid=TEXT)
