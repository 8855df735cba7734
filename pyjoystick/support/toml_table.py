"""Reading TOML files, with errors that name the place of a mistake."""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final

from pyjoystick.support.checks import finite, whole_number
from pyjoystick.support.errors import InputFileError, ParameterError, PyJoystickError, SettingsError

_BARE_KEY: Final = re.compile(r"[A-Za-z0-9_-]+")
_ABSENT: Final = object()


class Table:
    """A table of the file. Keys that were read are known; `finish` rejects all others.

    Attributes:
        path: the file
        name: name of the table, as written between its brackets
        content: its keys and values
    """

    def __init__(self, path: Path, name: str, content: dict[str, Any]) -> None:
        self.path = path
        self.name = name
        self.content = content
        self._known: list[str] = []

    def error(self, key: str, allowed: str, hint: str = "") -> SettingsError:
        """The error for the value of a key."""
        return SettingsError(self.path, self.name, key, self.content.get(key), allowed, hint)

    def refused(self, key: str, error: PyJoystickError) -> SettingsError:
        """The error of a check, with the place in the file."""
        if isinstance(error, ParameterError):
            given = self.content.get(key, error.value)
            return SettingsError(self.path, self.name, key, given, f"must be {error.allowed}", error.hint)
        return SettingsError(self.path, self.name, key, None, str(error))

    def __contains__(self, key: str) -> bool:
        return key in self.content

    def value(self, key: str) -> Any:
        """The value of a required key, as read from TOML."""
        if self.optional(key) is None:
            raise self.error(key, "is missing")
        return self.content[key]

    def optional(self, key: str) -> Any:
        """The value of a key as read from TOML, or None."""
        self._known.append(key)
        return self.content.get(key)

    def number(self, key: str, default: object = _ABSENT) -> float:
        """A finite number."""
        try:
            return finite(key, self._given(key, default))
        except ParameterError as error:
            raise self.refused(key, error) from None

    def integer(self, key: str, least: int, default: object = _ABSENT) -> int:
        """A whole number, `least` or more."""
        try:
            return whole_number(key, self._given(key, default), least)
        except ParameterError as error:
            raise self.refused(key, error) from None

    def text(self, key: str, default: object = _ABSENT) -> str:
        """Text."""
        value = self._given(key, default)
        if not isinstance(value, str):
            raise self.error(key, "must be text")
        return value

    def choice(self, key: str, allowed: Sequence[str], default: object = _ABSENT) -> str:
        """One of the words in `allowed`."""
        value = self._given(key, default)
        if not isinstance(value, str) or value not in allowed:
            near = difflib.get_close_matches(str(value), allowed, n=1)
            hint = f"did you mean {near[0]}?" if near else ""
            raise self.error(key, f"must be one of {', '.join(allowed)}", hint)
        return value

    def entries(self, key: str) -> list[Any]:
        """A list of one or more entries."""
        value = self.value(key)
        if not isinstance(value, list) or not value:
            raise self.error(key, "must be a list with one entry or more")
        return value

    def table(self, key: str, *, required: bool = False) -> Table:
        """A table inside this one; an optional table that is missing is empty."""
        value = self.value(key) if required else self._given(key, {})
        name = key if _BARE_KEY.fullmatch(key) else f'"{key}"'
        qualified = f"{self.name}.{name}" if self.name else name
        if not isinstance(value, dict):
            raise SettingsError(self.path, self.name, key, value, f"must be a table, [{qualified}]")
        return Table(self.path, qualified, value)

    def tables(self, key: str) -> list[Table]:
        """The tables written [[key]], one or more."""
        value = self.value(key)
        if not isinstance(value, list) or not value or not all(isinstance(one, dict) for one in value):
            raise self.error(key, f"must be written as one or more tables [[{key}]]")
        return [Table(self.path, f"{key} {i}", one) for i, one in enumerate(value, start=1)]

    def items(self) -> Iterator[tuple[str, Any]]:
        """All keys with their values, which makes them known."""
        self._known.extend(self.content)
        return iter(self.content.items())

    def finish(self) -> None:
        """Reject keys that were not read."""
        for key in self.content:
            if key not in self._known:
                near = difflib.get_close_matches(key, self._known, n=1)
                hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(self._known)}"
                raise SettingsError(self.path, self.name, key, None, "is not a known key", hint)

    def _given(self, key: str, default: object) -> Any:
        if default is _ABSENT:
            return self.value(key)
        value = self.optional(key)
        return default if value is None else value


def read_toml(path: Path) -> Table:
    """The whole file as a table.

    Raises:
        InputFileError: it cannot be read
        SettingsError: it is not TOML
    """
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputFileError(path, f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputFileError(path, "is not text in UTF-8") from error
    try:
        return Table(path, "", tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise SettingsError(path, "", "", None, f"is not TOML: {error}") from error
