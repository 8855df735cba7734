"""Settings from TOML files: every mistake is reported with its file, table and key.

A reader asks a `Table` for keys and tables, and checks values inside `Table.at`. At the end it calls `finish`
on the file, which rejects everything that was not read.
"""

from __future__ import annotations

import difflib
import logging
import re
import tomllib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import Any, Final

from pyjoystick.support.checks import finite, whole_number
from pyjoystick.support.errors import InputFileError, ParameterError, SettingsError, UnknownNameError

_LOG = logging.getLogger(__name__)

_BARE_KEY: Final = re.compile(r"[A-Za-z0-9_-]+")
_ABSENT: Final = object()
#: Most bytes of a file of settings.
_LARGEST: Final = 50_000_000


class Table:
    """A table of the file. `finish` rejects all keys that have not been read.

    Attributes:
        path: the file
        name: name of the table, as written between its brackets
        content: its keys and values
    """

    def __init__(self, path: Path, name: str, content: dict[str, Any]) -> None:
        self.path = path
        self.name = name
        self.content = content
        self._known: dict[str, None] = {}
        self._tables: dict[str, Table] = {}

    def error(self, key: str, allowed: str, hint: str = "") -> SettingsError:
        """Make the error with what is allowed for a key, or for the whole table if the key is empty."""
        return SettingsError(self.path, self.name, key, self.content.get(key), allowed, hint)

    def refused(self, key: str, error: ParameterError | UnknownNameError) -> SettingsError:
        """Convert an error about a value or a name to one about its place in the file."""
        if isinstance(error, ParameterError):
            given = self.content.get(key, error.value)
            return SettingsError(self.path, self.name, key, given, f"must be {error.allowed}", error.hint)
        return SettingsError(self.path, self.name, key, None, str(error))

    @contextmanager
    def at(self, key: str = "") -> Iterator[None]:
        """Context that reports errors raised inside at this key.

        Without a key, a `ParameterError` is reported at the key named by its field, if known, and
        any other error at the table.
        """
        try:
            yield
        except ParameterError as error:
            parts = error.field.split(".")  # names of keys may have points, too
            ends = (".".join(parts[i:]) for i in range(len(parts)))
            known = (end for end in ends if {end, end.partition("[")[0]} & self._known.keys())
            raise self.refused(key or next(known, ""), error) from None
        except UnknownNameError as error:
            raise self.refused(key, error) from None

    def __contains__(self, key: str) -> bool:
        self._known[key] = None
        return key in self.content

    def value(self, key: str) -> Any:
        """The value of a required key, as read from TOML."""
        if self.optional(key) is None:
            raise self.error(key, "is missing")
        return self.content[key]

    def optional(self, key: str) -> Any:
        """The value of a key as TOML has it, or None."""
        self._known[key] = None
        return self.content.get(key)

    def number(self, key: str, default: object = _ABSENT) -> float:
        """A finite number."""
        with self.at(key):
            return finite(key, self._given(key, default))

    def integer(self, key: str, least: int, default: object = _ABSENT) -> int:
        """A whole number, `least` or more."""
        with self.at(key):
            return whole_number(key, self._given(key, default), least)

    def text(self, key: str, default: object = _ABSENT) -> str:
        """Text."""
        value = self._given(key, default)
        if not isinstance(value, str):
            raise self.error(key, "must be text")
        return value

    def texts(self) -> dict[str, str]:
        """Every key with its value, which must be text."""
        return {key: self.text(key) for key in self.content}

    def flag(self, key: str, *, default: bool = False) -> bool:
        """True or false; the default where it is absent."""
        value = self._given(key, default=default)
        if not isinstance(value, bool):
            raise self.error(key, "must be true or false")
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

    def words(self, key: str) -> list[str]:
        """A list with one text or more."""
        words = self.entries(key)
        if not all(isinstance(word, str) for word in words):
            raise self.error(key, "must be a list of names")
        return words

    def table(self, key: str, *, required: bool = False) -> Table:
        """A table inside this one, always the same; empty where it may be absent and is."""
        if key in self._tables:
            return self._tables[key]
        value = self.value(key) if required else self._given(key, {})
        name = key if _BARE_KEY.fullmatch(key) else f'"{key}"'
        qualified = f"{self.name}.{name}" if self.name else name
        if not isinstance(value, dict):
            raise SettingsError(self.path, self.name, key, value, f"must be a table, [{qualified}]")
        self._tables[key] = Table(self.path, qualified, value)
        return self._tables[key]

    def tables(self, key: str) -> list[Table]:
        """The tables written [[key]], one or more."""
        value = self.value(key)
        if not isinstance(value, list) or not value or not all(isinstance(one, dict) for one in value):
            raise self.error(key, f"must be written as one or more tables [[{key}]]")
        tables = {f"{key} {i}": one for i, one in enumerate(value, start=1)}
        self._tables |= {name: Table(self.path, name, one) for name, one in tables.items()}
        return [self._tables[name] for name in tables]

    def subtables(self) -> Iterator[tuple[str, Table]]:
        """Every key with its value, which must be a table."""
        return ((key, self.table(key)) for key in self.content)

    def items(self) -> Iterator[tuple[str, Any]]:
        """Every key with its value; all of them are then known."""
        self._known |= dict.fromkeys(self.content)
        return iter(self.content.items())

    def finish(self) -> None:
        """Reject keys that were not read, here and in all tables that were read."""
        for key in self.content:
            if key not in self._known:
                near = difflib.get_close_matches(key, self._known, n=1)
                hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(self._known)}"
                raise SettingsError(self.path, self.name, key, None, "is not a known key", hint)
        for table in self._tables.values():
            table.finish()

    def _given(self, key: str, default: object) -> Any:
        if default is _ABSENT:
            return self.value(key)
        value = self.optional(key)
        return default if value is None else value


def read_toml(path: str | PathLike[str] | Table) -> Table:
    """The whole file as a table, which a reader may also be given.

    Raises:
        InputFileError: it cannot be read
        SettingsError: it is not TOML
    """
    if isinstance(path, Table):
        return path
    path = Path(path)
    try:
        with path.open("rb") as file:
            data = file.read(_LARGEST + 1)
        if len(data) > _LARGEST:  # a device such as /dev/full has no end
            raise InputFileError(path, f"is larger than {_LARGEST / 1e6:g} MB, which no settings are")
        text = data.decode("utf-8-sig")  # some editors begin with a byte order mark
    except OSError as error:
        raise InputFileError(path, f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputFileError(path, "is not text in UTF-8") from error
    try:
        content = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # of tomllib, and of numbers with thousands of digits
        raise SettingsError(path, "", "", None, f"is not TOML: {error}") from error
    _require_known_whole_numbers(path, "", content)
    _LOG.info("read %s", path)
    return Table(path, "", content)


def _require_known_whole_numbers(path: Path, table: str, content: dict[str, Any]) -> None:
    """Refuse whole numbers beyond those of FMI, Int64 and UInt64: they may be beyond all floats."""
    for key, value in content.items():
        inside = [value]
        for one in inside:
            if isinstance(one, dict):
                _require_known_whole_numbers(path, f"{table}.{key}" if table else key, one)
            elif isinstance(one, list):
                inside += one
            elif isinstance(one, int) and not -(2**63) <= one < 2**64:
                allowed = "a whole number must fit in 64 bits"
                raise SettingsError(path, table, key, value, allowed, "larger numbers have an exponent: 1e30")
