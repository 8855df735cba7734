"""All mistakes in a settings file at once.

A reader stops at the first mistake. Its place is therefore replaced by the value of an example, or removed,
and the file is read again until there are no more errors. Errors caused by the replacement are not reported.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Final

from pyjoystick.support.errors import PyJoystickError, SettingsError
from pyjoystick.support.toml_table import Table, read_toml

_PART: Final = re.compile(r'"([^"]*)"|([^.]+)')
_NUMBERED: Final = re.compile(r"(.+) (\d+)")
#: Limit of repeated readings.
_MOST: Final = 1000

Place = tuple[str | int, ...]


def mistakes(
    path: Path, read: Callable[[Table], object], example: Mapping[str, Any]
) -> list[PyJoystickError]:
    """List the mistakes in a settings file in the order of reading; empty if it can be used.

    Args:
        path: the file
        read: reads it; its first error is one of those that are returned
        example: allowed values, in the structure of the file
    """
    try:
        content = read_toml(path).content
    except PyJoystickError as error:
        return [error]
    found: list[PyJoystickError] = []
    mended: list[Place] = []
    for _ in range(_MOST):
        try:
            read(Table(path, "", copy.deepcopy(content)))
        except SettingsError as error:
            place = _place(error)
            follows = any(_inside(place, other) or _inside(other, place) for other in mended)
            if not follows:
                found.append(error)
            while place and (place in mended or not _mend(content, place, example)):
                mended.append(place)
                place = place[:-1]
            if not place:
                return found
            mended.append(place)
        except PyJoystickError as error:
            return [*found, error]
        else:
            return found
    return found


def _place(error: SettingsError) -> Place:
    """Where an error is: tables and key, without the place in a list of numbers."""
    parts: list[str | int] = []
    for quoted, bare in _PART.findall(error.table):
        numbered = _NUMBERED.fullmatch(bare)
        parts += [numbered[1], int(numbered[2]) - 1] if numbered else [quoted or bare]
    return (*parts, error.key.partition("[")[0]) if error.key else tuple(parts)


def _inside(place: Place, other: Place) -> bool:
    return place[: len(other)] == other


def _mend(content: Any, place: Place, example: Any) -> bool:
    """Put the value of the example at a place, or leave the place out; false where that cannot be."""
    *tables, last = place
    for part in tables:
        try:
            content = content[part]
        except (KeyError, IndexError, TypeError):
            return False
        example = example.get(part, {}) if isinstance(example, Mapping) else {}
    if isinstance(example, Mapping) and last in example:
        content[last] = copy.deepcopy(example[last])
        return True
    try:
        del content[last]
    except (KeyError, IndexError, TypeError):
        return False
    return True
