"""Compare what rumoca makes of a model with a second reading of its source."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.captures import (
    captured_in_packages,
    captured_names,
    constants_of_heirs,
    unknown_components,
    unknown_declarations,
    uses_of_replaceable_packages,
)
from fmu_build.codegen.second_reading.clauses import mistaken_clauses
from fmu_build.codegen.second_reading.connections import Connections, mistaken_connections
from fmu_build.codegen.second_reading.equations import mistaken_equations
from fmu_build.codegen.second_reading.function_bodies import mistaken_functions
from fmu_build.codegen.second_reading.givens import Text, as_written
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.packages import mistaken_packages
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class
from fmu_build.codegen.second_reading.values import mistaken_values
from fmu_build.codegen.second_reading.variables import mistaken_variables

_LONGEST: Final = 60


def reject_other_values(model: LoweredModel) -> list[str]:
    """Raise an error for the first variable, equation or name of which rumoca makes something else.

    Returns:
        what could not be computed and was only compared by its names, each with its class

    Raises:
        ModelicaError: a modifier names what does not exist, or changes what is final; or a connection
            joins different connectors
        UnsupportedModelError: rumoca has lost or misread something
    """
    library = Library({number: text for number, (_, text) in model.sources.items()})
    for place in expressions([*model.flat["variables"].values(), model.flat["equations"]], "span"):
        if place["source"] in library.unread:
            raise model.unsupported(f"the file cannot be checked: {library.unread[place['source']]}", place)
    try:
        instances = Instances(library, library.class_of(model.name))
    except UnknownError as error:
        raise model.unsupported("the source cannot be checked: the class is not found") from error
    connections = Connections(instances)
    for mistake, name in (*instances.mistakes, *connections.mistakes):
        found = model.classes.find([rf"(?<![\w.]){re.escape(name)}\s*[(=](?!=)"])
        raise model.invalid(mistake, [construct.place for construct in found])
    unknown: list[Text] = []
    in_functions: list[Text] = []
    for difference, span in _differences(model, instances, connections, unknown, in_functions):
        raise model.unsupported(difference, span)
    texts = (*unknown, *in_functions, *unknown_components(instances))
    return [*dict.fromkeys(_described(one) for one in texts if _is_own(one))]


def _is_own(text: Text) -> bool:
    """Return whether a text is the user's, and no text that the generator has written."""
    words = (text.scope.around.qualified, *text.tokens)
    return bool(text.tokens) and not any(one.startswith("FmuBuild") for one in words)


def _described(text: Text) -> str:
    if text.tokens is text.scope.around.tokens:
        return f"the function {text.scope.around.qualified}"
    written = as_written(text.tokens)
    short = written if len(written) <= _LONGEST else f"{written[:_LONGEST]}..."
    return f"{short} in {text.scope.around.qualified}"


def _differences(
    model: LoweredModel,
    instances: Instances,
    connections: Connections,
    unknown: list[Text],
    in_functions: list[Text],
) -> Iterator[tuple[str, Span | None]]:
    """Yield what differs, each with what to do and the place; what is not known is added to the lists."""
    library = instances.library
    for difference, span in mistaken_values(model, instances, unknown):
        yield f"{difference}; declare the value in a class of its own", span
    for difference, span in (
        *mistaken_equations(model, instances, unknown),
        *mistaken_clauses(model, instances, unknown),
    ):
        yield f"{difference}: the compiler has misread the class; write it another way", span
    for difference, span in mistaken_packages(model, library, instances):
        yield f"{difference}: the compiler looks up the name in the wrong class; write its full name", span
    for difference, span in mistaken_functions(model, instances, unknown, in_functions):
        yield f"{difference}: the compiler has misread the function; write it another way", span
    yield from _of_unknown(model, instances, [*unknown, *unknown_declarations(instances)], in_functions)
    for text in (*unknown, *in_functions):
        if text.is_changed:
            why = "a name in it depends on a redeclaration or on modifiers of a class"
            yield f"{_described(text)} cannot be checked, because {why}", _place(model, text.scope.around)
    for what, around in instances.unknown:
        yield f"{what} cannot be checked; declare a class of its own for the component", _place(model, around)
    for difference in mistaken_variables(model, instances):
        yield f"{difference}: the compiler has misread a size, a condition or a type; write a number", None
    for difference in mistaken_connections(model, connections):
        yield f"{difference}: the compiler has misread a connection; write it another way", None


def _of_unknown(
    model: LoweredModel, instances: Instances, unknown: list[Text], in_functions: list[Text]
) -> Iterator[tuple[str, Span | None]]:
    """Yield what might differ in texts that cannot be compared."""
    library = instances.library
    for difference, around in (
        *captured_names(instances, unknown),
        *captured_in_packages(library),
    ):
        why = "because the compiler looks it up there first"
        yield f"{difference}, {why}; rename one of them", _place(model, around)
    for difference, around in uses_of_replaceable_packages(
        model, library, instances, (*unknown, *in_functions)
    ):
        why = "the compiler would take another package"
        yield f"{difference}: {why}; pass the value as a parameter or an argument", _place(model, around)
    for difference, around in constants_of_heirs(library, instances, unknown):
        why = "the compiler may take those of another package with the same base"
        yield (
            f"{difference} in {around.name} cannot be checked: {why}; use a parameter",
            _place(model, around),
        )


def _place(model: LoweredModel, owner: Class) -> Span:
    return model.span(owner.file, owner.start, owner.end)
