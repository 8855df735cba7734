"""The residuals of equations, by which rumoca's are compared with those of the source.

The residual of an equation is its left side less its right one. Whatever rumoca has made of the equations of
a statement, these must have the same residuals, apart from their signs and order, for all values of the
variables.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.agreement import Size, differ
from fmu_build.codegen.second_reading.arithmetic import results_of, value_of
from fmu_build.codegen.second_reading.compiled_values import CompiledValues
from fmu_build.codegen.second_reading.givens import Given, Scope
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError, Value, choice, scalar
from fmu_build.codegen.second_reading.points import Point, Points, source_names
from fmu_build.codegen.second_reading.references import points
from fmu_build.codegen.second_reading.sections import Branches, Equation, Loop, Statement
from fmu_build.codegen.second_reading.syntax import Tokens


@dataclass(frozen=True, slots=True)
class Pass:
    """An expression of rumoca, with the values of iterators for which it is meant."""

    tree: Mapping[str, Any]
    iterators: Mapping[str, float]


def passes(equations: Sequence[Mapping[str, Any]], families: Sequence[Mapping[str, Any]]) -> list[list[Pass]]:
    """Return the residuals of each flat equation: one, or those of the passes of a loop that it begins.

    Of a loop, rumoca keeps a template, and only the first equations.
    """
    found = [[Pass(one["residual"], {})] for one in equations]
    for family in families:
        if not family["interiors_materialized"]:
            first, binders = family["first_equation_index"], family["domain"]["binders"]
            ranges = [_numbers(one) for one in binders]
            names = [one["display_name"] for one in binders]
            expanded = [
                Pass(body, dict(zip(names, map(float, numbers), strict=True)))
                for numbers in itertools.product(*ranges)
                for body in family["template"]["body"]
            ]
            count = family["equations_per_point"] * int(np.prod([len(one) for one in ranges]))
            found[first : first + count] = [expanded, *([] for _ in range(count - 1))]
    return found


def _numbers(binder: Mapping[str, int]) -> range:
    step = binder["step"]
    return range(binder["lower"], binder["upper"] + (1 if step > 0 else -1), step)


class Residuals:
    """The residuals of a statement in the source, and those of what rumoca has made of it."""

    def __init__(
        self, model: LoweredModel, instances: Variables, scope: Scope, compiled: Sequence[Pass]
    ) -> None:
        self._model = model
        self._instances = instances
        self._compiled = compiled
        self._scope = scope
        self._points = Points(instances, kept_names([each.tree for each in compiled]))
        self._size = Size()

    def differ(self, statement: Statement) -> bool:
        """Return whether they differ; raises `UnknownError` if that is not known."""
        if not self._differ([statement]):
            return False
        if isinstance(statement, Branches) and not self._is_decided(statement):
            # rumoca may have computed the variable that decides, and kept one branch.
            for _, body in statement.branches:
                if not self._differ(body):
                    raise UnknownError
        return True

    def _differ(self, inner: Sequence[Statement]) -> bool:
        return differ(
            self._points,
            lambda point: [value for one in inner for value in self._meant(point, one, {})],
            self._found,
            self._size,
            is_residual=True,
        )

    def _is_decided(self, statement: Branches) -> bool:
        """Return whether parameters and constants decide which branch holds."""
        try:
            for condition, _ in statement.branches:
                self._instances.number(condition or ("true",), self._scope)
        except UnknownError:
            return False
        return True

    def _found(self, point: Point) -> list[Value]:
        return [CompiledValues(self._model, point, one.iterators).of(one.tree) for one in self._compiled]

    def _meant(self, point: Point, one: Statement, iterators: Mapping[str, float]) -> list[Value]:
        if isinstance(one, Equation):
            names = source_names(point, self._scope)
            results = one.results
            left = [value_of(side, names, iterators) for side in results.values() or (one.left,)]
            if results:
                right = results_of(one.right, results, names, iterators)
            else:
                right = [value_of(one.right, names, iterators)]
            return [self._difference(a, b) for a, b in zip(left, right, strict=True)]
        if isinstance(one, Loop):
            passes_ = points(point.instances, self._scope, one.iterators, iterators)
            return [
                value for inner in passes_ for each in one.body for value in self._meant(point, each, inner)
            ]
        return self._of_branches(point, one.branches, iterators) if isinstance(one, Branches) else []

    def _difference(self, left: Value, right: Value) -> Value:
        if left.shape != right.shape:
            raise UnknownError
        self._size.enter(left, right)
        with np.errstate(all="ignore"):
            return np.asarray(left - right)

    def _of_branches(
        self,
        point: Point,
        branches: Sequence[tuple[Tokens, tuple[Statement, ...]]],
        iterators: Mapping[str, float],
    ) -> list[Value]:
        """Return the residuals of the branch that holds, or a mixture of them all at a smooth point."""
        if not branches:
            return []
        (condition, body), *further = branches
        holds = value_of(condition or ("true",), source_names(point, self._scope), iterators)
        own = (
            [value for each in body for value in self._meant(point, each, iterators)] if scalar(holds) else []
        )
        if scalar(holds) == 1:
            return own
        others = self._of_branches(point, further, iterators)
        if not scalar(holds):
            return others
        if len(own) != len(others):
            raise UnknownError
        return [choice(holds, a, b) for a, b in zip(own, others, strict=True)]


def kept_names(trees: Sequence[Any]) -> frozenset[str]:
    """Return the names of the variables in rumoca's expressions."""
    return frozenset(one["name"]["name"] for tree in trees for one in expressions(tree, "VarRef"))


def value_differs(
    model: LoweredModel,
    instances: Variables,
    given: Given,
    sizes: tuple[int, ...],
    tree: Mapping[str, Any],
) -> bool:
    """Return whether rumoca's expression in a declaration has another value than what the source gives.

    Raises `UnknownError` if that is not known.
    """
    scope = given.scope or instances.nowhere
    ones, size = np.ones(sizes), Size()

    def meant(point: Point) -> list[Value]:
        value = given.chosen(value_of(given.value, source_names(point, scope)))
        size.enter(value)
        return [value if value.ndim else value * ones]

    def found(point: Point) -> list[Value]:
        value = CompiledValues(model, point, {}).of(tree)
        return [value if value.ndim else value * ones]

    return differ(Points(instances, kept_names([tree])), meant, found, size)
