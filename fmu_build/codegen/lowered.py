"""A model as lowered by rumoca: the Solve IR, and the variables as described by the earlier stages."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import rumoca

from fmu_build.codegen.compiled import CompiledModel
from fmu_build.codegen.expression import Slot
from fmu_build.codegen.modelica_source.reached import IN_MEMORY
from fmu_build.codegen.modelica_source.text import STRING
from fmu_build.codegen.not_lowered import not_lowered
from fmu_build.support.errors import UnsupportedModelError

SOLVE_SCHEMA = 71
"""The version of rumoca's Solve IR that this generator was written for."""

TARGET = Path(__file__).parent / "target"
"""Templates that print the stages of a model for `read_mapping`."""

# The template engine prints mappings as JSON, except for null and non-finite numbers.
_TOKEN = re.compile(r'("(?:[^"\\]|\\.)*")|\b(none|undefined)\b|(-?)\b(inf|NaN|nan)\b')
_STRING = re.compile(STRING)
_BARE = re.compile(r"(?<![\w.\"])(?:none|undefined|inf|NaN|nan)(?![\w.\"])")
_REPLACEMENTS = tuple(
    (re.compile(rf"(?<![\w.\"])(?:{words})(?![\w.\"])"), replacement)
    for words, replacement in (("none|undefined", "null"), ("inf", "Infinity"), ("-?nan|-?NaN", "NaN"))
)
_RUST_ESCAPE = re.compile(r"\\u\{([0-9a-fA-F]+)\}|\\'|\\0|\\\\")


@dataclass(frozen=True)
class LoweredModel(CompiledModel):
    """The stages of one compiled model as plain JSON data.

    `solve` holds equations as register programs; `dae` holds variables and functions with their attributes.
    """

    solve: dict[str, Any]
    dae: dict[str, Any]

    @cached_property
    def slots(self) -> dict[str, Slot]:
        """Slots of the scalar variables by name; variables that the compiler has removed have none."""
        return {name: slot_of(place) for name, place in self.solve["layout"]["bindings"].items()}

    @property
    def y_names(self) -> list[str]:
        """The names of the variables in y, in their order."""
        names: list[str] = self.solve["solve_layout"]["solver_maps"]["names"]
        return names

    def with_slots(self, slots: Mapping[str, Slot], y_names: Sequence[str]) -> LoweredModel:
        """Return the model with its variables moved to these slots; `y_names` are the new names in y."""
        layout, solve_layout = self.solve["layout"], self.solve["solve_layout"]
        bindings = {name: {store.upper(): {"index": place}} for name, (store, place) in slots.items()}
        maps = {**solve_layout["solver_maps"], "names": [*y_names]}
        solve = {
            **self.solve,
            "layout": {**layout, "bindings": bindings},
            "solve_layout": {**solve_layout, "solver_maps": maps},
        }
        return replace(self, solve=solve)

    @cached_property
    def computed_parameters(self) -> frozenset[str]:
        """The names of the parameters that the model computes from others at initialization."""
        computed = {slot_of(t) for t in self.solve["initialization"]["update_targets"] if "P" in t}
        return frozenset(
            variable["name"]
            for variable in self.dae["variables"]
            if all(self.slots.get(one) in computed for one in variable["scalar_names"])
        )


def slot_of(place: Mapping[str, Any]) -> Slot:
    """Return the slot that the Solve IR writes as ``{"Y": {"index": 0}}``."""
    return ("y", int(place["Y"]["index"])) if "Y" in place else ("p", int(place["P"]["index"]))


def lower(model: rumoca.Model) -> LoweredModel:
    """Lower a compiled rumoca model.

    Raises `UnsupportedModelError` if rumoca cannot lower the model or writes another version of its IR.
    """
    files = model.to_dict("dae")["source_map"]["files"]
    compiled = CompiledModel(
        name=model.name,
        flat=model.to_dict("flat"),
        source_files=tuple((number, path.removeprefix(IN_MEMORY), text) for number, path, text in files),
    )
    try:
        rendered = model.codegen(str(TARGET))
    except RuntimeError as error:
        raise not_lowered(compiled, str(error)) from error
    stages = read_mapping(rendered.files[0].content)
    schema = stages["solve"]["schema_version"]
    if schema != SOLVE_SCHEMA:
        raise UnsupportedModelError(
            f"{model.name}: rumoca {rumoca.version()} writes version {schema} of its Solve IR; "
            f"this generator reads version {SOLVE_SCHEMA}"
        )
    return LoweredModel(
        name=compiled.name,
        flat=compiled.flat,
        source_files=compiled.source_files,
        solve=stages["solve"],
        dae=stages["dae"],
    )


def read_mapping(text: str) -> dict[str, Any]:
    """Parse a mapping as printed by the template engine."""
    strings = "\n".join(_STRING.findall(text))
    if "\\" not in strings and not _BARE.search(strings):
        # If no string contains one of these words, as in nearly all mappings, one fast substitution per word
        # is enough.
        for word, replacement in _REPLACEMENTS:
            text = word.sub(replacement, text)
    else:
        text = _converted(text)
    mapping: dict[str, Any] = json.loads(text)
    return mapping


def _converted(text: str) -> str:
    def as_json(match: re.Match[str]) -> str:
        string, nothing, sign, number = match.groups()
        if string:
            return _RUST_ESCAPE.sub(_as_json_escape, string)
        if nothing:
            return "null"
        return "NaN" if number.lower() == "nan" else f"{sign}Infinity"

    return _TOKEN.sub(as_json, text)


def _as_json_escape(match: re.Match[str]) -> str:
    if match.group(1):
        return json.dumps(chr(int(match.group(1), 16)))[1:-1]
    return {r"\'": "'", r"\0": r"\u0000"}.get(match.group(), match.group())
