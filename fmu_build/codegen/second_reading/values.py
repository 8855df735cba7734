"""Compare the values of variables and the equations in declarations with those of the source.

Both sides must have the same values at random points, and numbers must be equal. Of an equation that cannot
be computed, the text must be the one that the source gives, and its names must mean variables of the
component in which it stands.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any, Final

from fmu_build.codegen.compiled import Span
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.codegen.second_reading.equations import mistaken_names, mistaken_numbers
from fmu_build.codegen.second_reading.givens import Given, Text, as_written
from fmu_build.codegen.second_reading.known_variables import Leaf, Variables
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.residuals import value_differs
from fmu_build.codegen.second_reading.syntax import TOKEN, Tokens
from fmu_build.codegen.start_values import StartValues

_ROUNDING: Final = 1e-9
_ZERO: Final = Given(("0",))
_ATTRIBUTES: Final = {"start": "start", "min": "minimum", "max": "maximum", "nominal": "nominal"}


def mistaken_values(
    model: LoweredModel, instances: Variables, unknown: list[Text]
) -> Iterator[tuple[str, Span]]:
    """Yield variables with another value, attribute or equation, and where they are declared.

    The texts of equations that cannot be computed are added to `unknown`.
    """
    starts = StartValues(model)
    for variable in model.dae["variables"]:
        name = variable["name"]
        leaf = instances.leaves.get(name)
        if leaf is not None:
            for difference in (
                *_differences(instances, starts, leaf, variable),
                *_in_attributes(model, instances, name, unknown),
                *_in_equation(model, instances, name, unknown),
            ):
                why = f"the compiler has lost or misplaced a modifier of {name}, or of another variable"
                yield f"{difference}: {why} with this name", variable["declaration"]["span"]


def _differences(
    instances: Variables, starts: StartValues, leaf: Leaf, variable: dict[str, Any]
) -> Iterator[str]:
    """Yield the values and attributes whose numbers, in the stage after the flat model, differ."""
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
        if not found and place in ("binding", "start") and attributes[place] is not None:
            found = [starts.given(variable, place, number) for number in range(len(variable["scalar_names"]))]
        with suppress(UnknownError):
            meant, rest = [*instances.value(given).flat], _rest(given.value)
            if found and None not in found and len(meant) in (1, len(found)):
                pairs = zip(found, meant if len(meant) > 1 else meant * len(found), strict=True)
                yield from (
                    f"the {what} is {a:g} instead of {b:g}"
                    for a, b in pairs
                    if not math.isclose(a, b, rel_tol=_ROUNDING, abs_tol=rest)
                )


def _rest(tokens: Tokens) -> float:
    """Return what may be left of zero in a value, other than that of a number; `results` is more exact."""
    sign = tokens[:1] in (("-",), ("+",))
    return 0.0 if len(tokens) == 1 + sign and tokens[-1][0].isdigit() else 1e-6


def _in_attributes(
    model: LoweredModel, instances: Variables, name: str, unknown: list[Text]
) -> Iterator[str]:
    """Yield the attributes of a variable that have other values in the flat model."""
    leaf, flat = instances.leaves[name], model.flat["variables"].get(name, {})
    for attribute in _ATTRIBUTES:
        given, tree = leaf.given.inner.get(attribute), flat.get(attribute)
        if (
            given is None
            or not given.value
            or (attribute == "start" and leaf.is_constant and leaf.given.value)
        ):
            continue
        if tree is None:
            yield f"the {attribute} value {as_written(given.value)} is lost"
            continue
        try:
            if value_differs(model, instances, given, leaf.sizes, tree):
                yield f"the {attribute} value {as_written(given.value)} differs in the compiler's reading"
        except UnknownError as error:
            if given.scope is not None:
                unknown.append(Text(given.scope, given.value, error.is_of_change))


def _in_equation(model: LoweredModel, instances: Variables, name: str, unknown: list[Text]) -> Iterator[str]:
    """Yield what is wrong with the equation in the declaration of a variable."""
    leaf, flat = instances.leaves[name], model.flat["variables"].get(name)
    if flat is None:
        return
    given, binding = leaf.given, flat.get("binding")
    if binding is None or not given.value:
        if binding is not None and not leaf.is_constant:
            yield "there is an equation that the source does not give"
        elif given.value and not leaf.is_constant:
            yield f"the equation {as_written(given.value)} is lost"
        return
    try:
        differs = value_differs(model, instances, given, leaf.sizes, binding)
    except UnknownError as error:
        if given.scope is not None:
            unknown.append(Text(given.scope, given.value, error.is_of_change))
        if not leaf.is_constant:
            yield from _in_text(model, instances, given, binding)
        return
    if differs:
        specific = [*_in_text(model, instances, given, binding)]
        yield from specific or [f"the equation {as_written(given.value)} differs in the compiler's reading"]


def _in_text(
    model: LoweredModel, instances: Variables, given: Given, binding: Mapping[str, Any]
) -> Iterator[str]:
    """Yield how the text of an equation and its names differ from what is given."""
    ((_, content),) = binding.items()
    text = model.text(content["span"])
    if not _contains(given.value, tuple(TOKEN.findall(blanked(text)))):
        yield f"the equation is {text} instead of {as_written(given.value)}"
    if given.scope is not None:
        yield from mistaken_names(model, instances, given.scope, binding)
        yield from mistaken_numbers(model, instances, given.scope, binding)


def _contains(whole: Tokens, part: Tokens) -> bool:
    return any(whole[i : i + len(part)] == part for i in range(len(whole) - len(part) + 1))
