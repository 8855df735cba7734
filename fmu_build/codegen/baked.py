"""Find baked parameters: the compiler has put their values into the equations, so setting them has no effect.

Array sizes, the arguments of ``sample()``, conditions of conditional components and the like are evaluated
when the model is compiled, and rumoca's output does not say which parameters they depend on. Trial
compilations with other values show this: a parameter is free if its value does not change the equations and
if every parameter that depends on it is computed from it when the FMU is initialized. `probes` says how
choices are found.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import rumoca

from fmu_build.codegen.functions.definitions import bodies
from fmu_build.codegen.lowered import LoweredModel, read_mapping
from fmu_build.codegen.probes import probe_values, thresholds
from fmu_build.codegen.source import SETTING_PREFIX, ModelSource, Setting
from fmu_build.codegen.start_values import StartValues

_SUBSCRIPTS = re.compile(r"\[[\d,]+\]")
_TARGET = Path(__file__).parent / "target" / "variant"


def baked_parameters(source: ModelSource, model: LoweredModel, starts: StartValues) -> frozenset[str]:
    """Return the names of the parameters (arrays as a whole) that cannot be set after compilation."""
    compared = thresholds(model.name, {Path(path): content for _, path, content in model.source_files})
    candidates = list(_candidates(model, starts, compared))
    return frozenset(_search(source, _computed(model), candidates)) if candidates else frozenset()


@dataclass(frozen=True, slots=True)
class _Candidate:
    """Names of parameters that are set together, with their present value and a different one."""

    names: tuple[str, ...]
    present: Setting
    other: Setting
    probes: tuple[Setting, ...]
    """More values, by which other branches of the equations may be chosen; as many for each candidate."""
    fallback: _Candidate | None = None
    """Another way to set them, tried if they do not prove free in this way."""


def _computed(model: LoweredModel) -> frozenset[str]:
    """Return the parameters that the model computes from others at initialization."""
    bindings = model.solve["layout"]["bindings"]
    slots = {t["P"]["index"] for t in model.solve["initialization"]["update_targets"] if "P" in t}
    return frozenset(
        variable["name"]
        for variable in model.dae["variables"]
        if all(
            bindings.get(scalar, {}).get("P", {}).get("index") in slots for scalar in variable["scalar_names"]
        )
    )


def _search(source: ModelSource, computed: frozenset[str], group: Sequence[_Candidate]) -> Iterator[str]:
    """Yield the baked parameters of a group: bisect it until a part is free or holds a single candidate."""
    if _is_free(source, computed, group):
        return
    if len(group) == 1:
        fallback = group[0].fallback
        yield from _search(source, computed, [fallback]) if fallback else group[0].names
        return
    middle = len(group) // 2
    yield from _search(source, computed, group[:middle])
    yield from _search(source, computed, group[middle:])


def _is_free(source: ModelSource, computed: frozenset[str], group: Sequence[_Candidate]) -> bool:
    present = _variant(source, [candidate.present for candidate in group])
    other = _variant(source, [candidate.other for candidate in group])
    if present is None or other is None or present["equations"] != other["equations"]:
        return False
    if present["functions"] and bodies(present["functions"]) != bodies(other["functions"]):
        return False
    changed = {
        name
        for name, value in present["values"].items()
        if value != other["values"].get(name) and not name.startswith(SETTING_PREFIX)
    }
    if not changed <= computed | {name for candidate in group for name in candidate.names}:
        return False
    probes = (_variant(source, settings) for settings in zip(*(one.probes for one in group), strict=True))
    return all(probe is None or probe["equations"] == present["equations"] for probe in probes)


def _variant(source: ModelSource, settings: Sequence[Setting]) -> dict[str, Any] | None:
    """Return the equations for other parameter values, or None if the model does not compile with them."""
    try:
        return read_mapping(source.variant(settings).codegen(str(_TARGET)).files[0].content)
    except (rumoca.RumocaError, RuntimeError):
        return None


def _candidates(
    model: LoweredModel, starts: StartValues, compared: tuple[float, ...] | None
) -> Iterator[_Candidate]:
    """Yield every parameter that can be set unless it is baked."""
    finals = model.flat.get("variable_final_flags", {})
    groups: dict[str, list[Mapping[str, Any]]] = {}
    for entry in model.dae["variables"]:
        flat = model.flat["variables"].get(entry["name"])
        is_open = flat is not None and not flat["is_protected"] and not finals.get(entry["name"], False)
        if entry["role"] == "parameter" and is_open and entry["attributes"]["tunable"]:
            groups.setdefault(_SUBSCRIPTS.sub("", entry["name"]), []).append(entry)
    for number, (path, entries) in enumerate(groups.items()):
        probe = (
            partial(probe_values, number=number, compared=compared) if compared is not None else _no_probes
        )
        candidate = _candidate(model, starts, path, entries, probe)
        if candidate is not None:
            yield candidate


def _no_probes(_: float) -> list[float]:
    return []


def _candidate(
    model: LoweredModel,
    starts: StartValues,
    path: str,
    entries: Sequence[Mapping[str, Any]],
    probe: Callable[[float], list[float]],
) -> _Candidate | None:
    """Return the candidate for a parameter, in all components of an array if they form one."""
    bindings = model.solve["layout"]["bindings"]
    scalars = [scalar for entry in entries for scalar in entry["scalar_names"] if scalar in bindings]
    values = [starts.of(("p", bindings[scalar]["P"]["index"])) for scalar in scalars]
    texts = [_texts(model, starts, entries[0], value, probe(value)) for value in values]
    if not texts or None in texts:
        return None
    present, other, *probes = zip(*(text for text in texts if text), strict=True)
    last = [int(n) for group in _SUBSCRIPTS.findall(entries[-1]["name"]) for n in group[1:-1].split(",")]
    dimensions = (*last, *entries[0]["value_type"]["dimensions"])
    kind = _kind(model, starts, entries[0])
    names = tuple(entry["name"] for entry in entries)
    whole = _Candidate(
        names,
        Setting(path, kind, dimensions, _array(present, dimensions)),
        Setting(path, kind, dimensions, _array(other, dimensions)),
        tuple(Setting(path, kind, dimensions, _array(one, dimensions)) for one in probes),
    )
    if len(names) == 1 or len(set(present)) > 1:
        return whole
    # A modifier for the whole array does not replace one that was given with "each".
    one, another, *more = (
        Setting(path, kind, (), value[0], each=True) for value in (present, other, *probes)
    )
    return _Candidate(names, one, another, tuple(more), fallback=whole)


def _kind(model: LoweredModel, starts: StartValues, entry: Mapping[str, Any]) -> str:
    """Return the Modelica type name of a parameter."""
    enumeration = starts.enumeration_of(model.flat["variable_type_names"].get(entry["name"], ""))
    kind = entry["value_type"]["scalar"]
    return enumeration.name if kind == "enumeration" and enumeration else kind.capitalize()


def _texts(
    model: LoweredModel, starts: StartValues, entry: Mapping[str, Any], value: float, probes: Sequence[float]
) -> tuple[str, ...] | None:
    """Return the Modelica texts of a value, another of its type and the probes; None if there is no other."""
    match entry["value_type"]["scalar"]:
        case "real":
            return tuple(map(repr, (value, value * 1.0625 + 0.03125, *probes)))
        case "integer":
            return tuple(str(round(one)) for one in (value, value + 1, *probes))
        case "boolean":
            return tuple("true" if one else "false" for one in (value, not value, *(p > 0 for p in probes)))
    enumeration = starts.enumeration_of(model.flat["variable_type_names"].get(entry["name"], ""))
    if enumeration is None or len(enumeration.literals) < 2:
        return None
    numbers = [int(value) - 1, int(value), *(int(value) + 1 + i for i in range(len(probes)))]
    literals = enumeration.literals
    return tuple(f"{enumeration.name}.{literals[n % len(literals)][0]}" for n in numbers)


def _array(values: Sequence[str], dimensions: Sequence[int]) -> str:
    """Return values in row-major order as nested array constructors."""
    if not dimensions:
        return values[0]
    size = len(values) // dimensions[0]
    rows = (_array(values[i : i + size], dimensions[1:]) for i in range(0, len(values), size))
    return "{" + ", ".join(rows) + "}"
