"""Compare rumoca's when-clauses, assertions and algorithms with those of the classes in the source.

All conditions, variables and values in them must have the same values at random points, in the same order.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.agreement import Size, differ
from fmu_build.codegen.second_reading.clause_values import compiled_values, source_values
from fmu_build.codegen.second_reading.equations import mistaken_names, mistaken_numbers
from fmu_build.codegen.second_reading.givens import Scope, Text
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.points import Points
from fmu_build.codegen.second_reading.residuals import kept_names
from fmu_build.codegen.second_reading.sections import (
    Branches,
    Call,
    Loop,
    Statement,
    When,
    has_branches,
    has_clauses,
    statements,
)
from fmu_build.codegen.second_reading.syntax import Section

Difference = tuple[str, Span]
Trees: TypeAlias = Sequence[Mapping[str, Any]]
_Outer: TypeAlias = When | Call | Branches | Loop
_OF_COMPONENT = "algorithm from "


def mistaken_clauses(model: LoweredModel, instances: Variables, unknown: list[Text]) -> Iterator[Difference]:
    """Yield what is wrong with when-clauses, assertions and algorithms, and where these stand.

    The texts of those that cannot be compared are added to `unknown`.
    """
    for path, part in instances.parts.items():
        for owner in part.classes:
            clauses = _Clauses(model, instances, Scope(path, owner), unknown)
            for section in owner.sections:
                yield from clauses.in_equations(section)
            for section in owner.algorithms:
                yield from clauses.algorithm(section)


class _Clauses:
    """The clauses in one class of a component."""

    def __init__(self, model: LoweredModel, instances: Variables, scope: Scope, unknown: list[Text]) -> None:
        self._model = model
        self._instances = instances
        self._scope = scope
        self._unknown = unknown

    def in_equations(self, section: Section) -> Iterator[Difference]:
        """Yield what is wrong with the when-clauses and assertions of a section."""
        try:
            inner = statements(section)
        except SyntaxError:
            return  # The text is among the unknown ones already.
        for outer in inner:
            if not isinstance(outer, _Outer):
                continue
            # rumoca gives clauses in a branch the place of the if-equation.
            for one in self._that_hold(section, outer):
                if isinstance(one, When):
                    yield from self._when(section, one, outer)
                else:
                    yield from self._call(section, one, outer)

    def _that_hold(self, section: Section, one: Statement) -> Iterator[When | Call]:
        """Yield the clauses that an equation is or contains, of branches those that parameters choose."""
        if isinstance(one, When | Call):
            yield one
        elif isinstance(one, Branches | Loop) and has_clauses(one):
            try:
                for inner in self._chosen(one):
                    yield from self._that_hold(section, inner)
            except UnknownError as error:
                tokens = section.between(one.start, one.end)
                self._unknown.append(Text(self._scope, tokens, error.is_of_change))

    def _chosen(self, one: Branches | Loop) -> Sequence[Statement]:
        """Return the branch that holds; raises `UnknownError` for a loop, or if no parameter decides."""
        if isinstance(one, Loop):
            raise UnknownError
        bodies = (
            body
            for condition, body in one.branches
            if not condition or self._instances.number(condition, self._scope)
        )
        return next(bodies, ())

    def algorithm(self, section: Section) -> Iterator[Difference]:
        """Yield what is wrong with an algorithm."""
        kind = "initial_algorithms" if section.is_initial else "algorithms"
        start, end = section.places[0], section.places[-1]
        found = [one for one in self._between(self._model.flat[kind], start, end) if self._is_own(one)]
        trees = [one for each in found for one in each["statements"]]
        try:
            inner = statements(section)
        except SyntaxError:
            inner = None
        if not trees and section.tokens:
            yield f"an algorithm{self._where} is lost", self._span(start, end)
        yield from self._compared("algorithm", Text(self._scope, section.tokens), inner, [trees], start)

    def _when(self, section: Section, one: When, outer: _Outer) -> Iterator[Difference]:
        chains = self._between(self._model.flat["when_chains"], outer.start, outer.end)
        chains = [chain for chain in chains if self._sets_own(chain)]
        if not chains:
            yield f"a when-clause{self._where} is lost", self._span(one.start, one.end)
            return
        text = Text(self._scope, section.between(one.start, one.end))
        yield from self._compared("when-clause", text, [one], [[chain] for chain in chains], one.start)

    def _call(self, section: Section, one: Call, outer: _Outer) -> Iterator[Difference]:
        kind = "initial_assert_equations" if section.is_initial else "assert_equations"
        found = [
            each
            for each in self._between(self._model.flat[kind], outer.start, outer.end)
            if self._is_own(each)
        ]
        text = Text(self._scope, section.between(one.start, one.end))
        yield from self._compared("assertion", text, [one], [[each] for each in found], one.start)

    def _compared(
        self,
        what: str,
        text: Text,
        inner: Sequence[Statement] | None,
        candidates: Sequence[Trees],
        start: int,
    ) -> Iterator[Difference]:
        """Yield that none of rumoca's trees, of perhaps several components, has the values of the source."""
        try:
            if not candidates or any(not self._differ(inner, trees) for trees in candidates):
                return
        except UnknownError as error:
            self._unknown.append(replace(text, is_changed=error.is_of_change))
            if len(candidates) == 1:
                yield from self._by_names(candidates[0])
            return
        specific = [*self._by_names(candidates[0])] if len(candidates) == 1 else []
        yield from specific or [
            (f"the {what}{self._where} differs in the compiler's reading", self._span(start, start + 1))
        ]

    def _differ(self, inner: Sequence[Statement] | None, trees: Trees) -> bool:
        if inner is None:
            raise UnknownError
        size, points = Size(), Points(self._instances, kept_names(trees))
        return differ(
            points,
            lambda point: source_values(point, self._scope, inner, size),
            lambda point: compiled_values(self._model, point, trees),
            size,
            is_complete=not has_branches(inner),
        )

    def _by_names(self, trees: Trees) -> Iterator[Difference]:
        for one in trees:
            span = next(expressions(dict(one), "span"))
            for check in (mistaken_names, mistaken_numbers):
                for difference in check(self._model, self._instances, self._scope, dict(one)):
                    yield difference, span

    def _sets_own(self, chain: Mapping[str, Any]) -> bool:
        """Return whether all variables that a when-clause sets are in this component."""
        prefix = f"{self._scope.path}." if self._scope.path else ""
        return all(one["target"].startswith(prefix) for one in expressions(dict(chain), "Assign"))

    def _is_own(self, one: Mapping[str, Any]) -> bool:
        """Return whether an assertion or algorithm is that of this component."""
        origin = one["origin"]
        if isinstance(origin, str):
            return (
                origin.removeprefix(_OF_COMPONENT) if origin.startswith(_OF_COMPONENT) else ""
            ) == self._scope.path
        return any(
            found["component"] == self._scope.path for found in expressions(origin, "ComponentEquation")
        )

    def _between(self, found: Trees, start: int, end: int) -> list[Mapping[str, Any]]:
        file = self._scope.around.file
        own = (one for one in found if one["span"]["source"] == file)
        return [one for one in own if start <= self._model.offset(one["span"]) < end]

    @property
    def _where(self) -> str:
        return f" of {self._scope.path}" if self._scope.path else ""

    def _span(self, start: int, end: int) -> Span:
        return self._model.span(self._scope.around.file, start, end)
