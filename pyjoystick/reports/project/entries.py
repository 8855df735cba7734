"""Checked reading of entries of ``laboratory.toml``: files, quantities, angles, intervals, sides."""

from __future__ import annotations

import math
from typing import Any

from pyjoystick import model, motion
from pyjoystick.support import ParameterError, Table, finite, not_negative


def relative_of(table: Table, key: str) -> float | None:
    """Read a relative standard uncertainty; None if the key is absent."""
    value = quantity_of(table, key)
    if value is None:
        return None
    with table.at(key):
        return not_negative(key, value)


def file_of(table: Table) -> str:
    """Read the name of one file."""
    name = table.text("file")
    if not name:
        raise table.error("file", "must name a file")
    return name


def files_of(table: Table) -> tuple[str, ...]:
    """Read one name or pattern of files, or a list of them."""
    given = table.value("files")
    names = (given,) if isinstance(given, str) else tuple(table.words("files"))
    if not all(names):
        raise table.error("files", "must name files")
    return names


def choice_of(table: Table, key: str, allowed: tuple[str, ...]) -> str | None:
    """Read one of the allowed words; None if the key is absent."""
    return table.choice(key, allowed) if key in table else None


def side_of(table: Table, key: str) -> model.Side | None:
    """Read a side, forward or backward; None if the key is absent."""
    word = choice_of(table, key, model.SIDES)
    return next((side for side in model.SIDES if side == word), None)


def interval_of(table: Table, key: str) -> tuple[float, float] | None:
    """Read two instants (s), the first before the second; None if the key is absent."""
    if key not in table:
        return None
    entries = table.entries(key)
    with table.at(key):
        ends = tuple(finite(key, one, "s") for one in entries)
    if len(ends) != 2 or ends[0] >= ends[1]:
        raise table.error(key, "must be two instants (s), the first before the second")
    return ends[0], ends[1]


def angle_of(table: Table, key: str) -> float | None:
    """Read an angle (rad) between -90 and 90 degrees; None if the key is absent."""
    value = quantity_of(table, key, "angle")
    if value is not None and abs(value) >= math.pi / 2.0:
        hint = f'did you mean "{value:g} deg"?' if abs(value) < 90.0 else ""
        raise table.error(key, "must lie between -90 and 90 degrees; a bare number is in rad", hint)
    return value


def quantity_of(table: Table, key: str, kind: str = "") -> float | None:
    """Read a number in the SI unit, or text with a unit of this kind; None if the key is absent."""
    if key not in table:
        return None
    given: Any = table.value(key)
    units = motion.UNITS.get(kind, {})
    si = next(iter(units), "")
    with table.at(key):
        if isinstance(given, str) and units:
            try:
                return motion.amount(given, units)
            except (KeyError, ValueError):
                allowed = f"a number ({si}), or text with a unit: {', '.join(units)}"
                raise ParameterError(key, given, allowed) from None
        return finite(key, given, si)
