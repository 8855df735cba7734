"""Compare rumoca's equations with those of the classes in the source.

An equation of a component must stand in one of its classes, and the names in it must mean variables of this
component. Each equation of its classes must be there, if it is not in a branch that does not hold.
"""

from __future__ import annotations

import bisect
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.codegen.second_reading.arithmetic import UnknownError
from fmu_build.codegen.second_reading.givens import Scope, plain
from fmu_build.codegen.second_reading.inlined import mistaken_constants
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.packages import NAME, is_iterator, is_one_of
from fmu_build.codegen.second_reading.references import points
from fmu_build.codegen.second_reading.sections import Branches, Equation, Loop, Statement, statements
from fmu_build.codegen.second_reading.syntax import TOKEN, Section

Difference = tuple[str, Span]


def mistaken_equations(model: LoweredModel, instances: Instances) -> Iterator[Difference]:
    """Yield what is wrong with the equations of components, and where these stand."""
    for kind in ("equations", "initial_equations"):
        found = _by_component(one for one in model.flat[kind] if one["span"]["source"] in model.sources)
        for path, part in instances.parts.items():
            for equation in found.get(path, []):
                span = equation["span"]
                place = (span["source"], model.offset(span))
                owner = next((one for one in part.classes if one.contains(*place)), None)
                if owner is None:
                    yield f"{path} has an equation that is not in its class", span
                else:
                    yield from _mistaken(model, instances, Scope(path, owner), equation)
            for owner in part.classes:
                comparison = _Comparison(model, instances, Scope(path, owner), found.get(path, []))
                for section in owner.sections:
                    if section.is_initial == (kind == "initial_equations"):
                        yield from comparison.of(section)


def _mistaken(
    model: LoweredModel, instances: Instances, scope: Scope, equation: Mapping[str, Any]
) -> Iterator[Difference]:
    """Yield the names and numbers in an equation that are not what the source means."""
    span, tree = equation["span"], equation["residual"]
    for difference in mistaken_names(model, instances, scope, tree):
        yield difference, span
    for difference in mistaken_numbers(model, instances, scope, tree):
        yield difference, span
    tokens = tuple(TOKEN.findall(blanked(model.text(span))))
    if "=" in tokens:  # Equations in loops and branches have the place of an iterator or a condition.
        for difference in mistaken_constants(instances, scope, tokens, tree):
            yield difference, span


def _by_component(equations: Iterable[Mapping[str, Any]]) -> dict[str, list[Mapping[str, Any]]]:
    found = defaultdict(list)
    for equation in equations:
        if "ComponentEquation" in equation["origin"]:
            found[equation["origin"]["ComponentEquation"]["component"]].append(equation)
    return found


def mistaken_names(model: LoweredModel, instances: Instances, scope: Scope, tree: Any) -> Iterator[str]:
    """Yield names in an expression that rumoca takes for variables of another component."""
    for reference in expressions(tree, "VarRef"):
        if reference["name"]["instance_id"] is None or reference["span"]["source"] not in model.sources:
            continue  # an iterator, or made by rumoca
        written = plain(model.text(reference["span"]))
        with suppress(UnknownError):
            if instances.means_member(written, scope):
                prefix, found = f"{scope.path}." if scope.path else "", reference["name"]["name"]
                inner = plain(found.removeprefix(prefix))
                # It may go on with a member of a record, or be followed by one.
                is_same = f"{inner}.".startswith(f"{written}.") or f"{written}.".startswith(f"{inner}.")
                if not (found.startswith(prefix) and is_same) and not instances.is_through_outer(
                    plain(prefix + written)
                ):
                    yield f"{written} means {found} instead of {prefix}{written}"


def mistaken_numbers(model: LoweredModel, instances: Instances, scope: Scope, tree: Any) -> Iterator[str]:
    """Yield numbers that rumoca has written for names of variables and constants, if these have others."""
    for span, value in _numbers(model, tree):
        if span["source"] not in model.sources or not scope.around.contains(
            span["source"], model.offset(span)
        ):
            continue  # It stands in the declaration of a function or constant.
        written = model.text(span)
        if NAME.fullmatch(written):
            with suppress(UnknownError):
                meant = instances.value_of(tuple(TOKEN.findall(written)), scope)
                if not is_one_of(value, meant) and not is_iterator(model, scope.around, written):
                    yield f"{written} is not {value:g}"


def _numbers(model: LoweredModel, tree: Any) -> Iterator[tuple[Span, float]]:
    """Yield the numbers in an expression, and those of the literals of enumerations, with their places."""
    for literal in expressions(tree, "Literal"):
        value = next(iter(literal["value"].values()))
        if not isinstance(value, str):
            yield literal["span"], value
    ordinals = model.flat["enum_literal_ordinals"]
    for reference in expressions(tree, "VarRef"):
        if reference["name"]["name"] in ordinals:
            yield reference["span"], ordinals[reference["name"]["name"]]


class _Comparison:
    """Compares the equations of one class with those that rumoca gives to a component of it."""

    def __init__(
        self, model: LoweredModel, instances: Instances, scope: Scope, found: Sequence[Mapping[str, Any]]
    ) -> None:
        self._model = model
        self._instances = instances
        self._scope = scope
        self._file = scope.around.file
        own = [one for one in found if one["span"]["source"] == self._file]
        self._starts = [model.offset(one["span"]) for one in own]
        spans = (span for one in own for span in expressions(one["residual"], "span"))
        self._parts = sorted(model.offset(span) for span in spans if span["source"] == self._file)

    def of(self, section: Section) -> Iterator[Difference]:
        """Yield the equations of a section that are lost."""
        with suppress(SyntaxError):
            for one in statements(section):
                yield from self._in(one)

    def _in(self, one: Statement) -> Iterator[Difference]:
        with suppress(UnknownError):
            if isinstance(one, Equation):
                yield from self._equation(one)
            elif isinstance(one, Loop):
                yield from self._loop(one)
            elif isinstance(one, Branches):
                # Loops in branches have another place.
                active = (inner for inner in self._active(one, {}) if not isinstance(inner, Loop))
                for inner in active:
                    yield from self._in(inner)

    def _active(self, one: Branches, iterators: Mapping[str, float]) -> tuple[Statement, ...]:
        """Return the equations of the branch that holds."""
        for condition, body in one.branches:
            if not condition or self._instances.number(condition, self._scope, iterators):
                return body
        return ()

    def _equation(self, one: Equation) -> Iterator[Difference]:
        first = bisect.bisect_left(self._parts, one.start)
        if first == len(self._parts) or self._parts[first] >= one.end:
            yield self._difference(f"the equation {' '.join(one.tokens)}{self._where} is lost", one.start)

    def _difference(self, what: str, start: int) -> Difference:
        return what, self._model.span(self._file, start, start + 1)

    @property
    def _where(self) -> str:
        return f" of {self._scope.path}" if self._scope.path else ""

    def _loop(self, one: Loop) -> Iterator[Difference]:
        """Count the equations, which all have the place of the first iterator."""
        found, expected = self._starts.count(one.start), self._count(one, {})
        if found < expected:
            what = f"of {expected} equations of the loop over {one.iterators[0][0]}{self._where}"
            yield self._difference(f"{what}, {found} remain", one.start)

    def _count(self, one: Statement, iterators: Mapping[str, float]) -> int:
        """Return the number of equations for values of the iterators around."""
        if isinstance(one, Loop):
            inner = points(self._instances, self._scope, one.iterators, iterators)
            return sum(self._count(it, point) for point in inner for it in one.body)
        if isinstance(one, Branches):
            return sum(self._count(it, iterators) for it in self._active(one, iterators))
        return int(isinstance(one, Equation))
