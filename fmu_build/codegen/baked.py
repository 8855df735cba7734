"""Parameters whose value the compiler has put into the equations, so that setting them would do nothing.

Array sizes, the arguments of ``sample()``, conditions of conditional components and the like are evaluated
when the model is compiled, and nothing in rumoca's output says which parameters went into them. They are
found by trying: a parameter that is free can have another value without a change to the equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import rumoca

from fmu_build.codegen.functions.definitions import bodies
from fmu_build.codegen.lowered import LoweredModel, lower
from fmu_build.codegen.source import ModelSource
from fmu_build.codegen.start_values import StartValues
from fmu_build.errors import UnsupportedModelError

_IGNORED = frozenset({"provenance", "owner", "site", "origin", "scheduled_time_events"})
"""What may differ between equal equations: places in the source, and event times (see relations.py)."""


def baked_parameters(source: ModelSource, model: LoweredModel, starts: StartValues) -> frozenset[str]:
    """Names of the parameters (of whole arrays) that cannot be set after compiling."""
    others = dict(_other_values(model, starts))
    if not others:
        return frozenset()
    return frozenset(_search(source, _equations(source, {}), list(others), others))


def _search(
    source: ModelSource, unchanged: object, names: Sequence[str], others: Mapping[str, str]
) -> Iterator[str]:
    """Halve a group of parameters until it is free together, or a single one that is not."""
    if _equations(source, {name: others[name] for name in names}) == unchanged:
        return
    if len(names) == 1:
        yield names[0]
        return
    middle = len(names) // 2
    yield from _search(source, unchanged, names[:middle], others)
    yield from _search(source, unchanged, names[middle:], others)


def _equations(source: ModelSource, values: Mapping[str, str]) -> object:
    """The equations for other parameter values, None where the model does not compile with them."""
    try:
        variant = lower(source.variant(values))
    except (rumoca.RumocaError, RuntimeError, UnsupportedModelError):
        return None
    return _plain(variant.solve), bodies(variant.dae)


def _plain(tree: Any) -> Any:
    if isinstance(tree, dict):
        return {k: _plain(v) for k, v in tree.items() if k not in _IGNORED and "span" not in k}
    return [_plain(item) for item in tree] if isinstance(tree, list) else tree


def _other_values(model: LoweredModel, starts: StartValues) -> Iterator[tuple[str, str]]:
    """Another value for every parameter that could be set, as Modelica text."""
    bindings = model.solve["layout"]["bindings"]
    finals = model.flat.get("variable_final_flags", {})
    for entry in model.dae["variables"]:
        name = entry["name"]
        flat = model.flat["variables"].get(name)
        is_open = flat is not None and not flat["is_protected"] and not finals.get(name, False)
        if entry["role"] != "parameter" or not is_open or not entry["attributes"]["tunable"]:
            continue
        slots = [bindings[scalar]["P"]["index"] for scalar in entry["scalar_names"] if scalar in bindings]
        present = [starts.of(("p", slot)) for slot in slots]
        values = [_other(model, starts, name, entry["value_type"]["scalar"], value) for value in present]
        if values and None not in values:
            yield name, _array([str(value) for value in values], entry["value_type"]["dimensions"])


def _other(model: LoweredModel, starts: StartValues, name: str, kind: str, value: float) -> str | None:
    if kind == "real":
        return repr(value * 1.0625 + 0.03125)
    if kind == "integer":
        return str(int(value) + 1)
    if kind == "boolean":
        return "false" if value else "true"
    enumeration = starts.enumeration_of(model.flat["variable_type_names"].get(name, ""))
    if enumeration is None or len(enumeration.literals) < 2:
        return None
    literal = enumeration.literals[int(value) % len(enumeration.literals)][0]
    return f"{enumeration.name}.{literal}"


def _array(values: Sequence[str], dimensions: Sequence[int]) -> str:
    """Values in row-major order as nested array constructors."""
    if not dimensions:
        return values[0]
    size = len(values) // dimensions[0]
    rows = (_array(values[i : i + size], dimensions[1:]) for i in range(0, len(values), size))
    return "{" + ", ".join(rows) + "}"
