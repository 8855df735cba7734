"""Compare the values of variables and the equations in declarations with those of the source.

Numbers must be equal. An equation in a declaration must be the text that the source gives, and its names
must mean variables of the component in which it stands. Values of parameters that are not numbers are not
compared, because rumoca replaces names in them by their values.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from typing import Any, Final

from fmu_build.codegen.compiled import Span
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.codegen.second_reading.arithmetic import UnknownError, Value
from fmu_build.codegen.second_reading.equations import mistaken_names, mistaken_numbers
from fmu_build.codegen.second_reading.givens import Given
from fmu_build.codegen.second_reading.inlined import mistaken_constants
from fmu_build.codegen.second_reading.instances import Instances, Leaf
from fmu_build.codegen.second_reading.syntax import TOKEN, Tokens

_ROUNDING: Final = 1e-9
_ZERO: Final = Given(("0",))
_ATTRIBUTES: Final = {"start": "start", "min": "minimum", "max": "maximum", "nominal": "nominal"}


def mistaken_values(model: LoweredModel, instances: Instances) -> Iterator[tuple[str, Span]]:
    """Yield variables with another value, attribute or equation, and where they are declared."""
    for variable in model.dae["variables"]:
        name = variable["name"]
        leaf = instances.leaves.get(name)
        if leaf is not None:
            for difference in (
                *_differences(instances, leaf, variable),
                *_in_equation(model, instances, name),
            ):
                why = f"the compiler has lost or misplaced a modifier of {name}, or of another variable"
                yield f"{difference}: {why} with this name", variable["declaration"]["span"]


def _differences(instances: Instances, leaf: Leaf, variable: dict[str, Any]) -> Iterator[str]:
    """Yield the values and attributes whose numbers differ."""
    attributes, inner = variable["attributes"], leaf.given.inner
    is_given = leaf.is_constant and bool(leaf.given.value)
    compared = [("value", leaf.given, "binding")] if is_given else []
    for name, place in _ATTRIBUTES.items():
        if name in inner and not (is_given and name == "start"):
            compared.append((f"{name} value", inner[name], place))
        elif name == "start" and not leaf.is_constant and leaf.has_zero_start:
            compared.append(("start value", _ZERO, place))
    for what, given, place in compared:
        found = attributes[f"{place}_values"]
        with suppress(UnknownError):
            meant = _flat(instances.value(given))
            if found and len(meant) in (1, len(found)):
                pairs = zip(found, meant if len(meant) > 1 else meant * len(found), strict=True)
                yield from (
                    f"the {what} is {a:g} instead of {b:g}"
                    for a, b in pairs
                    if not math.isclose(a, b, rel_tol=_ROUNDING)
                )


def _flat(value: Value) -> list[float]:
    return [one for element in value for one in _flat(element)] if isinstance(value, list) else [value]


def _in_equation(model: LoweredModel, instances: Instances, name: str) -> Iterator[str]:
    """Yield what is wrong with the equation in the declaration of a variable."""
    leaf, flat = instances.leaves[name], model.flat["variables"].get(name)
    if leaf.is_constant or flat is None:
        return
    given, binding = leaf.given, flat.get("binding")
    if binding is None and given.value:
        yield f"the equation {' '.join(given.value)} is lost"
    elif binding is not None and not given.value:
        yield "there is an equation that the source does not give"
    elif binding is not None:
        ((_, content),) = binding.items()
        text = model.text(content["span"])
        if not _contains(given.value, tuple(TOKEN.findall(blanked(text)))):
            yield f"the equation is {text} instead of {' '.join(given.value)}"
        if given.scope is not None:
            yield from mistaken_names(model, instances, given.scope, binding)
            yield from mistaken_numbers(model, instances, given.scope, binding)
            yield from mistaken_constants(instances, given.scope, given.value, binding)


def _contains(whole: Tokens, part: Tokens) -> bool:
    return any(whole[i : i + len(part)] == part for i in range(len(whole) - len(part) + 1))
