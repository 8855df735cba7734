"""Compare what rumoca makes of a model with a second reading of its source."""

from __future__ import annotations

import re
from collections.abc import Iterator

from fmu_build.codegen.compiled import Span
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.arithmetic import UnknownError
from fmu_build.codegen.second_reading.captures import (
    captured_names,
    constants_of_heirs,
    uses_of_replaceable_packages,
)
from fmu_build.codegen.second_reading.clauses import mistaken_clauses
from fmu_build.codegen.second_reading.connections import Connections, mistaken_connections
from fmu_build.codegen.second_reading.equations import mistaken_equations
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.packages import mistaken_packages
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.values import mistaken_values
from fmu_build.codegen.second_reading.variables import mistaken_variables


def reject_other_values(model: LoweredModel) -> None:
    """Raise an error for the first variable, equation or name of which rumoca makes something else.

    Raises:
        ModelicaError: a modifier names what does not exist, or changes what is final; or a connection
            joins different connectors
        UnsupportedModelError: rumoca has lost or misread something
    """
    try:
        library = Library({number: text for number, (_, text) in model.sources.items()})
        instances = Instances(library, library.class_of(model.name))
    except (SyntaxError, UnknownError):
        return  # The checks that look for single constructs remain.
    connections = Connections(instances)
    for mistake, name in (*instances.mistakes, *connections.mistakes):
        found = model.classes.find([rf"(?<![\w.]){re.escape(name)}\s*[(=](?!=)"])
        raise model.invalid(mistake, [construct.place for construct in found])
    for difference, span in _differences(model, library, instances, connections):
        raise model.unsupported(difference, span)


def _differences(
    model: LoweredModel, library: Library, instances: Instances, connections: Connections
) -> Iterator[tuple[str, Span | None]]:
    """Yield what differs, each with what to do and the place."""
    for difference, span in mistaken_values(model, instances):
        yield f"{difference}; declare the value in a class of its own", span
    for difference, around in captured_names(library, instances):
        span = model.span(around.file, around.start, around.end)
        yield f"{difference}, because the compiler looks it up there first; rename one of them", span
    for difference, around in uses_of_replaceable_packages(model, library, instances):
        span = model.span(around.file, around.start, around.end)
        why = "the compiler would take another package"
        yield f"{difference}: {why}; pass the value as a parameter or an argument", span
    for difference, around in constants_of_heirs(library, instances):
        span = model.span(around.file, around.start, around.end)
        why = "the compiler may take those of another package with the same base"
        yield f"{difference} in {around.name} cannot be checked: {why}; use a parameter", span
    for difference in mistaken_variables(model, instances):
        yield f"{difference}: the compiler has misread a size, a condition or a type; write a number", None
    for difference, span in (*mistaken_equations(model, instances), *mistaken_clauses(model, instances)):
        yield f"{difference}: the compiler has misread the class; write it another way", span
    for difference, span in mistaken_packages(model, library, instances):
        yield f"{difference}: the compiler looks up the name in the wrong class; write its full name", span
    for difference in mistaken_connections(model, connections):
        yield f"{difference}: the compiler has misread a connection; write it another way", None
