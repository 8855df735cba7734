"""Compare rumoca's functions with those of the source: statements and the defaults of variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.agreement import Size, differ
from fmu_build.codegen.second_reading.called_functions import Function
from fmu_build.codegen.second_reading.clause_values import compiled_values, source_values
from fmu_build.codegen.second_reading.compiled_values import compiled_function
from fmu_build.codegen.second_reading.givens import Scope, Text, nowhere
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.points import Points
from fmu_build.codegen.second_reading.residuals import kept_names, value_differs
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.sections import statements
from fmu_build.codegen.second_reading.syntax import Class


def mistaken_functions(
    model: LoweredModel, library: Library, unknown: list[Text], in_functions: list[Text]
) -> Iterator[tuple[str, Span]]:
    """Yield functions in which something differs in the compiler's reading, and where these stand.

    The texts of functions that cannot be compared are added to `in_functions`, or to `unknown` if it
    is not known through which package they are called.
    """
    callers = _callers(model, library)
    for one in model.flat["functions"].values():
        span = one["span"]
        if span["source"] not in model.sources:
            continue
        owner = library.class_at(span["source"], model.offset(span))
        text = Text(nowhere(owner), owner.tokens)
        try:
            function = compiled_function(model, library, one, callers[one["name"]])
        except (KeyError, UnknownError):
            unknown.append(text)
            continue
        try:
            if _differs(model, function, one):
                yield f"the function {owner.name} differs in the compiler's reading", span
        except (SyntaxError, UnknownError):
            in_functions.append(text)


def _callers(model: LoweredModel, library: Library) -> dict[str, Class]:
    """Return a class in which each function is called."""
    found = {}
    for call in expressions(model.flat, "FunctionCall"):
        name, span = call.get("name", {}).get("name"), call["span"]
        if name is not None and span["source"] in model.sources:
            with suppress(UnknownError):
                found[name] = library.class_at(span["source"], model.offset(span))
    return found


def _differs(model: LoweredModel, function: Function, one: Mapping[str, Any]) -> bool:
    """Return whether a function differs from that of the source.

    Raises `SyntaxError` or `UnknownError` if that is not known.
    """
    instances = function.instances()
    for variable in (*one["inputs"], *one["outputs"], *one["locals"]):
        leaf = instances.leaves.get(variable["name"])
        if leaf is None or bool(leaf.given.value) != (variable["default"] is not None):
            raise UnknownError
        if variable["default"] is not None and value_differs(
            model, instances, leaf.given, leaf.sizes, variable["default"]
        ):
            return True
    sections = [
        (base, section) for base in function.library.lineage(function.declared) for section in base.algorithms
    ]
    if len(sections) != 1 or one["external"] is not None:
        raise UnknownError
    ((base, section),) = sections
    size, points = Size(), Points(instances, kept_names(one["body"]))
    return differ(
        points,
        lambda point: source_values(point, Scope("", base), statements(section), size),
        lambda point: compiled_values(model, point, one["body"]),
        size,
    )
