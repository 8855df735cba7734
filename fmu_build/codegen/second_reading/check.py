"""Compare what rumoca gives to a model's variables with a second reading of the source.

Numbers must be equal. An equation in a declaration must be the text that the source gives, and its names
must mean variables of the component in which it stands. Values of parameters that are not numbers are not
compared, because rumoca replaces names in them by their values.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any, Final

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.codegen.second_reading.arithmetic import UnknownError, Value
from fmu_build.codegen.second_reading.connections import mistaken_connections
from fmu_build.codegen.second_reading.equations import mistaken_equations, mistaken_names
from fmu_build.codegen.second_reading.instances import Given, Instances, Leaf
from fmu_build.codegen.second_reading.packages import mistaken_packages
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import TOKEN, Tokens

_ROUNDING: Final = 1e-9
_ZERO: Final = Given(("0",))
_ATTRIBUTES: Final = {"start": "start", "min": "minimum", "max": "maximum", "nominal": "nominal"}
_ITERATOR: Final = re.compile(r"(?:\bfor|,)\s+(\w+)\s+in\b")
_SUBSCRIPTS: Final = re.compile(r"\[[^\[\]]*\]|\s")


def reject_other_values(model: LoweredModel) -> None:
    """Raise an error for the first variable to which rumoca gives something else than the source.

    Raises:
        ModelicaError: a modifier names what does not exist, or changes what is final
        UnsupportedModelError: a modifier is lost or misplaced
    """
    try:
        library = Library(text for _, text in model.sources.values())
        instances = Instances(library, model.name)
    except (SyntaxError, UnknownError):
        return  # The checks that look for single constructs remain.
    for mistake, name in instances.mistakes:
        found = model.classes.find([rf"(?<![\w.]){re.escape(name)}\s*[(=](?!=)"])
        raise model.invalid(mistake, [construct.place for construct in found])
    for variable in model.dae["variables"]:
        leaf = instances.leaves.get(variable["name"])
        if leaf is None:
            continue
        for difference in (
            *_differences(instances, leaf, variable),
            *_in_equation(model, instances, variable["name"]),
        ):
            raise model.unsupported(
                f"{difference}: the compiler has lost or misplaced a modifier of {variable['name']}, or of "
                "another variable with this name; declare the value in a class of its own",
                variable["declaration"]["span"],
            )
    for difference, span in mistaken_equations(model, instances):
        raise model.unsupported(
            f"{difference}: the compiler has misread the class; write it another way", span
        )
    for difference, span in mistaken_packages(model, library):
        raise model.unsupported(
            f"{difference}: the compiler looks up the name in the wrong class; write its full name", span
        )
    for difference in mistaken_connections(model, instances):
        raise model.unsupported(f"{difference}: the compiler has misread a connection; write it another way")


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


def _contains(whole: Tokens, part: Tokens) -> bool:
    return any(whole[i : i + len(part)] == part for i in range(len(whole) - len(part) + 1))
