"""Compare rumoca's functions with those of the source: statements and the defaults of variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.agreement import Size, differ
from fmu_build.codegen.second_reading.arithmetic import value_of
from fmu_build.codegen.second_reading.called_functions import variables_of
from fmu_build.codegen.second_reading.clause_values import compiled_values, source_values
from fmu_build.codegen.second_reading.compiled_values import (
    CompiledValues,
    compiled_function,
    member_of_input,
)
from fmu_build.codegen.second_reading.functions import Function
from fmu_build.codegen.second_reading.gathered import flattened, leaves_in
from fmu_build.codegen.second_reading.givens import Scope, Text, nowhere
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.points import Points, source_names
from fmu_build.codegen.second_reading.residuals import kept_names, value_differs
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.sections import has_branches, statements
from fmu_build.codegen.second_reading.syntax import Class


def mistaken_functions(
    model: LoweredModel, instances: Variables, unknown: list[Text], in_functions: list[Text]
) -> Iterator[tuple[str, Span]]:
    """Yield functions in which something differs in the compiler's reading, and where these stand.

    The texts of functions that cannot be compared are added to `in_functions`, or to `unknown` if it
    is not known through which package they are called.
    """
    library = instances.library
    callers = _callers(model, library)
    for one in model.flat["functions"].values():
        span = one["span"]
        if span["source"] not in model.sources:
            continue
        owner = library.class_at(span["source"], model.offset(span))
        text = Text(nowhere(owner), owner.tokens)
        try:
            # Only the functions of derivatives have no calls.
            function = compiled_function(model, library, one, callers.get(one["name"], owner))
        except UnknownError:
            if not one["is_constructor"]:  # All calls of these have all arguments.
                unknown.append(text)
            continue
        try:
            if _differs(model, function, variables_of(instances, function), one):
                yield f"the function {owner.name} differs in the compiler's reading", span
        except SyntaxError:
            in_functions.append(text)
        except UnknownError as error:
            in_functions.append(replace(text, is_changed=error.is_of_change))


def _callers(model: LoweredModel, library: Library) -> dict[str, Class]:
    """Return a class in which each function is called."""
    found = {}
    for call in expressions(model.flat, "FunctionCall"):
        called = call["comp"] if "comp" in call else call["name"]
        span = call["span"] if "span" in call else called["span"]
        if span["source"] in model.sources:
            with suppress(UnknownError):
                found[called["name"]] = library.class_at(span["source"], model.offset(span))
    return found


def _differs(model: LoweredModel, function: Function, variables: Variables, one: Mapping[str, Any]) -> bool:
    """Return whether a function differs from that of the source.

    Raises `SyntaxError` or `UnknownError` if that is not known.
    """
    if any(
        _default_differs(model, variables, variable) or _sizes_differ(model, variables, variable)
        for variable in (*one["inputs"], *one["outputs"], *one["locals"])
    ):
        return True
    sections = [
        (base, section) for base in function.library.lineage(function.declared) for section in base.algorithms
    ]
    if len(sections) != 1 or one["external"] is not None:
        raise UnknownError
    ((base, section),) = sections
    inner, size, points = statements(section), Size(), Points(variables, kept_names(one["body"]))
    return differ(
        points,
        lambda point: source_values(point, Scope("", base), inner, size),
        lambda point: compiled_values(model, point, one["body"]),
        size,
        is_complete=not has_branches(inner),
    )


def _default_differs(model: LoweredModel, variables: Variables, one: Mapping[str, Any]) -> bool:
    name, default = one["name"], one["default"]
    if name in variables.order:
        if default is None:
            return False
        leaves = [*leaves_in(variables, name)]
        if not all(variables.leaves[leaf].given.value for leaf in leaves):
            raise UnknownError  # rumoca has made up a value.
        points = Points(variables, kept_names([default]))
        return differ(
            points,
            lambda point: [flattened(point.own(leaf) for leaf in leaves)],
            lambda point: [CompiledValues(model, point, {}).of(default)],
            Size(),
        )
    if name not in variables.leaves and default is None and member_of_input(variables, name):
        return False  # It is an argument, whatever is declared for the members of the record.
    leaf = variables.leaves[name]
    if bool(leaf.given.value) != (default is not None):
        raise UnknownError
    return default is not None and value_differs(model, variables, leaf.given, leaf.sizes, default)


def _sizes_differ(model: LoweredModel, variables: Variables, one: Mapping[str, Any]) -> bool:
    shape, dimensions = one["shape_expr"], variables.dimensions.get(one["name"], [])
    if not dimensions:
        return False  # a member of a record
    if len(dimensions) != len(shape):
        raise UnknownError
    compared = [
        (*dimension, each["Expr"]["expr"])
        for dimension, each in zip(dimensions, shape, strict=True)
        if "Expr" in each
    ]
    if not compared:
        return False
    return differ(
        Points(variables, kept_names([tree for *_, tree in compared])),
        lambda point: [value_of(tokens, source_names(point, scope)) for tokens, scope, _ in compared],
        lambda point: [CompiledValues(model, point, {}).of(tree) for *_, tree in compared],
        Size(),
    )
