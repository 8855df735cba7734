"""A model as rumoca lowers it: the Solve IR and what other stages know of the variables."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import rumoca

from fmu_build.errors import UnsupportedModelError

SOLVE_SCHEMA = 71
"""The version of rumoca's Solve IR that this generator was written for."""

_TARGET = Path(__file__).parent / "target"

# The template engine prints a mapping as JSON, but for its words for "nothing" and the non-finite numbers.
_TOKEN = re.compile(r'("(?:[^"\\]|\\.)*")|\b(none|undefined)\b|(-?)\b(inf|NaN|nan)\b')
_RUST_ESCAPE = re.compile(r"\\u\{([0-9a-fA-F]+)\}|\\'|\\0")


@dataclass(frozen=True)
class LoweredModel:
    """The stages of one compiled model, as plain JSON data.

    `solve` holds equations as register programs, `dae` variables and functions with their attributes,
    `flat` what only the flat stage keeps (display units, quantities, protected and final flags).
    """

    name: str
    solve: dict[str, Any]
    dae: dict[str, Any]
    flat: dict[str, Any]
    source_files: tuple[tuple[int, str, str], ...]

    @cached_property
    def _sources(self) -> dict[int, tuple[str, str]]:
        return {number: (path, text) for number, path, text in self.source_files}

    def location(self, span: dict[str, int] | None) -> str:
        """``file:line`` of a source span, or an empty string where the compiler gave none."""
        if span is None or span.get("source") not in self._sources:
            return ""
        path, text = self._sources[span["source"]]
        line = text.encode()[: span["start"]].count(b"\n") + 1
        return f"{Path(path).name}:{line}"

    def refuse(self, what: str, span: dict[str, int] | None = None) -> UnsupportedModelError:
        """The error for a construct that cannot be carried faithfully, with its place in the source."""
        place = self.location(span)
        return UnsupportedModelError(f"{self.name}: {what}" + (f" ({place})" if place else ""))


def lower(model: rumoca.Model) -> LoweredModel:
    """Take a compiled rumoca model apart.

    Raises `UnsupportedModelError` where rumoca cannot lower the model or its IR is of another version.
    """
    try:
        rendered = model.codegen(str(_TARGET))
    except RuntimeError as error:
        raise UnsupportedModelError(f"{model.name}: rumoca cannot lower this model: {error}") from error
    stages = _read_mapping(rendered.files[0].content)
    schema = stages["solve"]["schema_version"]
    if schema != SOLVE_SCHEMA:
        raise UnsupportedModelError(
            f"{model.name}: rumoca {rumoca.version()} writes version {schema} of its Solve IR; "
            f"this generator reads version {SOLVE_SCHEMA}"
        )
    files = model.to_dict("dae")["source_map"]["files"]
    return LoweredModel(
        name=model.name,
        solve=stages["solve"],
        dae=stages["dae"],
        flat=model.to_dict("flat"),
        source_files=tuple((number, path, text) for number, path, text in files),
    )


def _read_mapping(text: str) -> dict[str, Any]:
    def as_json(match: re.Match[str]) -> str:
        string, nothing, sign, number = match.groups()
        if string:
            return _RUST_ESCAPE.sub(_as_json_escape, string)
        if nothing:
            return "null"
        return "NaN" if number.lower() == "nan" else f"{sign}Infinity"

    mapping: dict[str, Any] = json.loads(_TOKEN.sub(as_json, text))
    return mapping


def _as_json_escape(match: re.Match[str]) -> str:
    if match.group(1):
        return json.dumps(chr(int(match.group(1), 16)))[1:-1]
    return "'" if match.group() == r"\'" else r"\u0000"
