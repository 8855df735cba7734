"""The ``[explore]`` table of a TOML file: what a page shows, and the ranges of its sliders."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fmu_build.explore.ranges import Range, Scale
from fmu_build.support.errors import BuildError


class SettingsError(BuildError):
    """A TOML file cannot be read, or a value in its ``[explore]`` table is not allowed."""


@dataclass(frozen=True, slots=True)
class Preset:
    """A named set of values (SI units); all other variables have their start values."""

    name: str
    values: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class PlotChoice:
    """Variables of one plot, over time or over the variable `x`."""

    y: tuple[str, ...]
    x: str | None = None


@dataclass(frozen=True, slots=True)
class Settings:
    """What a page shows; empty fields are derived from the model."""

    title: str = ""
    stop_time: float | None = None
    step: float | None = None
    first: tuple[str, ...] = ()
    """The variables that the page shows first, before the groups."""
    ranges: Mapping[str, Range] = field(default_factory=dict)
    values: Mapping[str, float] = field(default_factory=dict)
    """Initial values of the page (SI units), which its reset button restores."""
    input_tables: bool = True
    """False: the inputs of the default experiment keep their start values."""
    plots: tuple[PlotChoice, ...] = ()
    presets: tuple[Preset, ...] = ()


def read_settings(file: Path) -> Settings:
    """Read the table; without one, return the defaults.

    Raises `SettingsError`, which names file, key, value and what is allowed.
    """
    try:
        content = tomllib.loads(file.read_text("utf-8"))
    except OSError as error:
        raise SettingsError(f"cannot read {file}: {error.strerror or error}") from error
    except (ValueError, RecursionError) as error:  # not UTF-8, not TOML, or nested too deeply
        raise SettingsError(f"{file} is no TOML file: {error}") from error
    return _Table(file, "explore", content.get("explore", {})).settings()


class _Table:
    """A table of the file that knows its position, for messages."""

    def __init__(self, file: Path, place: str, content: Any) -> None:
        self.file, self.place, self.content = file, place, content
        if not isinstance(content, dict):
            raise self._error("", content, "a table")

    def settings(self) -> Settings:
        self._only(
            "title", "stop_time", "step", "first", "ranges", "values", "input_tables", "plots", "presets"
        )
        ranges = self._table("ranges")
        return Settings(
            title=self._get("title", str, "", "a text"),
            stop_time=self._positive("stop_time"),
            step=self._positive("step"),
            first=self._names("first"),
            ranges={name: ranges._table(name)._range() for name in ranges.content},
            values=self._table("values")._values(),
            input_tables=self._get("input_tables", bool, True, "true or false"),
            plots=tuple(table._plot() for table in self._tables("plots")),
            presets=tuple(table._preset() for table in self._tables("presets")),
        )

    def _range(self) -> Range:
        self._only("min", "max", "scale")
        low, high = (self._required(key, _number, "a number") for key in ("min", "max"))
        scale: Scale = self._get("scale", _scale, "linear", '"linear" or "log"')
        if not low < high:
            raise self._error("max", high, f"above min, {low!r}")
        if scale == "log" and low * high <= 0.0:
            raise self._error("scale", scale, "min and max of the same sign")
        return Range(low, high, scale)

    def _preset(self) -> Preset:
        self._only("name", "values")
        return Preset(self._required("name", str, "a text"), self._table("values")._values())

    def _plot(self) -> PlotChoice:
        self._only("x", "y")
        if not (y := self._names("y")):
            raise self._error("y", [], "a list of names")
        return PlotChoice(y, self._get("x", str, "", "a name") or None)

    def _values(self) -> dict[str, float]:
        return {name: self._required(name, _number, "a number") for name in self.content}

    def _names(self, key: str) -> tuple[str, ...]:
        names: list[str] = self._get(key, _list_of(str), [], "a list of names")
        return tuple(names)

    def _positive(self, key: str) -> float | None:
        value: float | None = self._get(key, _number, None, "a number")
        if value is not None and not value > 0.0:
            raise self._error(key, value, "above 0")
        return value

    def _table(self, key: str) -> _Table:
        return _Table(self.file, f"{self.place}.{key}", self.content.get(key, {}))

    def _tables(self, key: str) -> list[_Table]:
        items = self._get(key, _list_of(dict), [], "a list of tables")
        return [_Table(self.file, f"{self.place}.{key}[{i}]", item) for i, item in enumerate(items)]

    def _only(self, *known: str) -> None:
        for key, value in self.content.items():
            if key not in known:
                raise self._error(key, value, f"one of the keys {', '.join(known)}")

    def _required(self, key: str, kind: Any, allowed: str) -> Any:
        if key not in self.content:
            raise SettingsError(f"{self.file}: {self.place}.{key} is missing; it must be {allowed}")
        return self._get(key, kind, None, allowed)

    def _get(self, key: str, kind: Callable[[Any], Any] | type, default: Any, allowed: str) -> Any:
        if key not in self.content:
            return default
        value = self.content[key]
        try:
            read = value if isinstance(kind, type) and isinstance(value, kind) else None
            read = read if isinstance(kind, type) else kind(value)
        except (TypeError, ValueError):
            read = None
        if read is None:
            raise self._error(key, value, allowed)
        return read

    def _error(self, key: str, value: Any, allowed: str) -> SettingsError:
        place = f"{self.place}.{key}" if key else self.place
        return SettingsError(f"{self.file}: {place} = {value!r} must be {allowed}")


def _number(value: Any) -> float | None:
    try:
        number = float(value) if isinstance(value, int | float) and not isinstance(value, bool) else math.nan
    except OverflowError:  # an integer too large for a float
        return None
    return number if math.isfinite(number) else None


def _scale(value: Any) -> str | None:
    return value if value in ("linear", "log") else None


def _list_of(kind: type) -> Callable[[Any], list[Any] | None]:
    def read(value: Any) -> list[Any] | None:
        whole = isinstance(value, list) and all(isinstance(item, kind) for item in value)
        return value if whole else None

    return read
