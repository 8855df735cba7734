"""The values in when-clauses, assertions and algorithms at a point: of all conditions, variables and values.

Nothing is carried out: the values of all branches are there, and those of loops for each pass.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.agreement import Size
from fmu_build.codegen.second_reading.arithmetic import results_of, value_of
from fmu_build.codegen.second_reading.compiled_values import CompiledValues
from fmu_build.codegen.second_reading.gathered import gathered, indexed
from fmu_build.codegen.second_reading.givens import Scope
from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value
from fmu_build.codegen.second_reading.points import Point, source_names
from fmu_build.codegen.second_reading.sections import Branches, Call, Equation, Loop, Statement, When
from fmu_build.codegen.second_reading.syntax import Tokens

_ELEMENT = re.compile(r"(.*)\[([\d,]+)\]")


def source_values(point: Point, scope: Scope, inner: Sequence[Statement], size: Size) -> list[Value]:
    """Return the values in statements of the source; raises `UnknownError` if one is not known."""
    found = [*_Source(point, scope, {}).of(inner)]
    size.enter(*found)
    return found


def compiled_values(model: LoweredModel, point: Point, trees: Sequence[Mapping[str, Any]]) -> list[Value]:
    """Return the values in what rumoca has made of them; raises `UnknownError` if one is not known."""
    return [*_Compiled(model, point, {}).of(trees)]


class _Source:
    def __init__(self, point: Point, scope: Scope, iterators: Mapping[str, float]) -> None:
        self._point = point
        self._scope = scope
        self._iterators = iterators

    def of(self, inner: Sequence[Statement]) -> Iterator[Value]:
        for one in inner:
            if isinstance(one, Equation):
                yield from self._equation(one)
            elif isinstance(one, Branches | When):
                for condition, body in one.branches:
                    if condition:
                        yield self._value(condition)
                    yield from self.of(body)
            elif isinstance(one, Loop):
                yield from self._loop(one.iterators, one.body)
            elif isinstance(one, Call):
                yield from self._call(one)
            else:
                raise UnknownError

    def _loop(self, ranges: Sequence[tuple[str, Tokens]], body: Sequence[Statement]) -> Iterator[Value]:
        if not ranges:
            yield from self.of(body)
            return
        (name, numbers), *inner = ranges
        for number in self._value(numbers).flat:
            each = {**self._iterators, name: float(number)}
            yield from _Source(self._point, self._scope, each)._loop(inner, body)

    def _equation(self, one: Equation) -> Iterator[Value]:
        results = one.results
        yield from map(self._value, results.values() or (one.left,))
        if results:
            names = source_names(self._point, self._scope)
            yield from results_of(one.right, results, names, self._iterators)
        else:
            yield self._value(one.right)

    def _call(self, one: Call) -> Iterator[Value]:
        count = {"reinit": 2, "assert": 1, "terminate": 0, "return": 0}.get(one.name)
        if count is None or any("=" in argument for argument in one.arguments):
            raise UnknownError
        yield from map(self._value, one.arguments[:count])

    def _value(self, tokens: Tokens) -> Value:
        return value_of(tokens, source_names(self._point, self._scope), self._iterators)


class _Compiled:
    def __init__(self, model: LoweredModel, point: Point, iterators: Mapping[str, float]) -> None:
        self._model = model
        self._point = point
        self._values = CompiledValues(model, point, iterators)
        self._iterators = iterators

    def of(self, trees: Sequence[Mapping[str, Any]]) -> Iterator[Value]:
        for one in trees:
            if "first" in one:
                yield from self._branches(
                    [(each["condition"], each["equations"]) for each in (one["first"], *one["else_when"])]
                )
            elif "condition" in one:
                yield self._values.of(one["condition"])
            else:
                ((kind, content),) = one.items()
                method = getattr(self, f"_{kind.lower()}", None)
                if method is None:
                    raise UnknownError
                yield from method(content)

    def _branches(
        self, branches: Sequence[tuple[Mapping[str, Any], Sequence[Mapping[str, Any]]]]
    ) -> Iterator[Value]:
        for condition, body in branches:
            yield self._values.of(condition)
            yield from self.of(body)

    def _assign(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield self._variable(content["target"])
        yield self._values.of(content["value"])

    def _reinit(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield self._variable(content["state"])
        yield self._values.of(content["value"])

    def _assert(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield self._values.of(content["condition"])

    def _terminate(self, content: Mapping[str, Any]) -> Iterator[Value]:
        del content
        yield from ()

    def _return(self, content: Mapping[str, Any]) -> Iterator[Value]:
        del content
        yield from ()

    def _conditional(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield from self._branches(content["branches"])
        yield from self.of(content["else_branch"] or ())

    def _assignment(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield self._target(content["comp"])
        yield self._values.of(content["value"])

    def _functioncall(self, content: Mapping[str, Any]) -> Iterator[Value]:
        outputs = {place: one for place, one in enumerate(content["outputs"]) if one is not None}
        yield from map(self._target, outputs.values())
        for place in outputs:
            yield self._values.result(content["comp"]["name"], content, place)

    def _target(self, component: Mapping[str, Any]) -> Value:
        reference = [
            (part["ident"], [self._values.subscript(one) for one in part["subs"]])
            for part in component["parts"]
        ]
        return gathered(self._point.instances, "", reference, self._point.of)

    def _if(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield from self._branches([(one["cond"], one["stmts"]) for one in content["cond_blocks"]])
        yield from self.of(content["else_block"] or ())

    def _when(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield from self._branches([(one["cond"], one["stmts"]) for one in content["blocks"]])

    def _for(self, content: Mapping[str, Any]) -> Iterator[Value]:
        yield from self._loop(content["indices"], content["equations"], self._iterators)

    def _loop(
        self,
        indices: Sequence[Mapping[str, Any]],
        body: Sequence[Mapping[str, Any]],
        iterators: Mapping[str, float],
    ) -> Iterator[Value]:
        if not indices:
            yield from _Compiled(self._model, self._point, iterators).of(body)
            return
        first, *further = indices
        numbers = CompiledValues(self._model, self._point, iterators).of(first["range"])
        for number in numbers.flat:
            yield from self._loop(further, body, {**iterators, first["ident"]: float(number)})

    def _variable(self, name: str) -> Value:
        if name in self._point.instances.leaves:
            return self._point.of(name)
        match = _ELEMENT.fullmatch(name)
        if match is None or match[1] not in self._point.instances.leaves:
            raise UnknownError
        return indexed(self._point.of(match[1]), [as_value(int(one)) for one in match[2].split(",")])
