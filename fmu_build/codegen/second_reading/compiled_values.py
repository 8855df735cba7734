"""The values of rumoca's expressions at a point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.arithmetic import OPERATORS, built_in
from fmu_build.codegen.second_reading.called_functions import Function, plain_function
from fmu_build.codegen.second_reading.gathered import indexed
from fmu_build.codegen.second_reading.operations import (
    UnknownError,
    Value,
    as_value,
    binary,
    choice,
    matrix,
    scalar,
    smooth,
    span_of,
    unary,
)
from fmu_build.codegen.second_reading.points import Point
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class

_SIGNS: Final = {
    "Add": "+",
    "AddElem": ".+",
    "And": "and",
    "Div": "/",
    "DivElem": "./",
    "Eq": "==",
    "Exp": "^",
    "ExpElem": ".^",
    "Ge": ">=",
    "Gt": ">",
    "Le": "<=",
    "Lt": "<",
    "Minus": "-",
    "Mul": "*",
    "MulElem": ".*",
    "Neq": "<>",
    "Not": "not",
    "Or": "or",
    "Plus": "+",
    "Sub": "-",
    "SubElem": ".-",
}


class CompiledValues:
    """The values of expressions at a point, in which iterators have these values."""

    def __init__(self, model: LoweredModel, point: Point, iterators: Mapping[str, float]) -> None:
        self._model = model
        self._point = point
        self._iterators = iterators

    def of(self, tree: Mapping[str, Any]) -> Value:
        """Return the value of an expression; raises `UnknownError` if it is not known."""
        ((kind, content),) = tree.items()
        method = getattr(self, f"_{kind.lower()}", None)
        if method is None:
            raise UnknownError
        found: Value = method(content)
        return found

    def _literal(self, content: Mapping[str, Any]) -> Value:
        value = next(iter(content["value"].values()))
        if isinstance(value, str):
            raise UnknownError
        return as_value(value)

    def _varref(self, content: Mapping[str, Any]) -> Value:
        name = content["name"]["name"]
        if name in self._iterators:
            return as_value(self._iterators[name])
        ordinals = self._model.flat["enum_literal_ordinals"]
        if name == "time":
            value = self._point.time
        elif name in self._point.instances.leaves:
            value = self._point.of(name)
        elif name in ordinals:
            value = as_value(ordinals[name])
        else:
            raise UnknownError
        return indexed(value, self._subscripts(content))

    def _subscripts(self, content: Mapping[str, Any]) -> Sequence[Value | None]:
        return [self.subscript(one) for one in content["subscripts"]]

    def subscript(self, subscript: Mapping[str, Any]) -> Value | None:
        """Return the value of a subscript; None for ``:``."""
        ((kind, content),) = subscript.items()
        if kind == "Colon":
            return None
        return as_value(content["value"]) if kind == "Index" else self.of(content["expr"])

    def _binary(self, content: Mapping[str, Any]) -> Value:
        if content["op"] not in _SIGNS:
            raise UnknownError
        sign, sides = _SIGNS[content["op"]], (content["lhs"], content["rhs"])
        operands = [self.of(one) for one in sides]
        found = smooth(sign, operands) if self._is_smooth(sides) else None
        return binary(sign, *operands) if found is None else found

    def _unary(self, content: Mapping[str, Any]) -> Value:
        if content["op"] not in _SIGNS:
            raise UnknownError
        sign, operand = _SIGNS[content["op"]], self.of(content["rhs"])
        found = smooth(sign, [operand]) if self._is_smooth([content["rhs"]]) else None
        return unary(sign, operand) if found is None else found

    def _is_smooth(self, trees: Sequence[Mapping[str, Any]]) -> bool:
        return self._point.is_smooth and any(map(self._is_random, trees))

    def _is_random(self, tree: Mapping[str, Any]) -> bool:
        names = (one["name"]["name"] for one in expressions(tree, "VarRef"))
        leaves = self._point.instances.leaves
        return any(one == "time" or (one in leaves and self._point.is_random(one)) for one in names)

    def _if(self, content: Mapping[str, Any]) -> Value:
        (condition, value), *further = content["branches"]
        holds = self.of(condition)
        if scalar(holds) == 1:
            return self.of(value)
        other = {"If": {**content, "branches": further}} if further else content["else_branch"]
        return self.of(other) if not scalar(holds) else choice(holds, self.of(value), self.of(other))

    def _array(self, content: Mapping[str, Any]) -> Value:
        if content["kind"] == "Vertical":
            return matrix([[self.of(one)] for one in content["elements"]])
        if content["kind"] == "Horizontal":
            return matrix([[self.of(one) for one in content["elements"]]])
        return as_value([self.of(one) for one in content["elements"]])

    def _range(self, content: Mapping[str, Any]) -> Value:
        step = as_value(1) if content["step"] is None else self.of(content["step"])
        return span_of(self.of(content["start"]), step, self.of(content["end"]))

    def _arraycomprehension(self, content: Mapping[str, Any]) -> Value:
        if content["filter"] is not None:
            raise UnknownError
        return self._elements(content["expr"], content["indices"])

    def _elements(self, body: Mapping[str, Any], indices: Sequence[Mapping[str, Any]]) -> Value:
        if not indices:
            return self.of(body)
        *outer, last = indices
        numbers = self.of(last["range"])
        points = ({**self._iterators, last["name"]: float(one)} for one in numbers.flat)
        return as_value(
            [CompiledValues(self._model, self._point, one)._elements(body, outer) for one in points]
        )

    def _index(self, content: Mapping[str, Any]) -> Value:
        return indexed(self.of(content["base"]), self._subscripts(content))

    def _builtincall(self, content: Mapping[str, Any]) -> Value:
        name = content["function"][0].lower() + content["function"][1:]
        if name in OPERATORS:
            return self._applied(name, content["args"][0])
        arguments = [self.of(one) for one in content["args"]]
        if name == "size":
            array, *dimension = arguments
            shape = as_value(array.shape)
            return indexed(shape, dimension)
        found = smooth(name, arguments) if self._is_smooth(content["args"]) else None
        found = self._point.of_operator(name, arguments) if found is None else found
        return built_in(name, arguments, {}) if found is None else found

    def _applied(self, operator: str, variable: Mapping[str, Any]) -> Value:
        content = variable.get("VarRef")
        if content is None or content["name"]["name"] not in self._point.instances.leaves:
            raise UnknownError
        whole = self._point.applied(operator, content["name"]["name"])
        return indexed(whole, self._subscripts(content))

    def _functioncall(self, content: Mapping[str, Any]) -> Value:
        function = self._model.flat["functions"].get(content["name"]["name"])
        if function is None or content["is_constructor"]:
            raise UnknownError
        library, span = self._point.instances.library, content["span"]
        if span["source"] not in self._model.sources:
            raise UnknownError
        around = library.class_at(span["source"], self._model.offset(span))
        found = compiled_function(self._model, library, function, around)
        return self._point.result(found, [self.of(one) for one in content["args"]])


def compiled_function(
    model: LoweredModel, library: Library, function: Mapping[str, Any], around: Class
) -> Function:
    """Return the function of the source that rumoca has found for a call in a class.

    Raises `UnknownError` if it is not known.
    """
    span = function["span"]
    if span["source"] not in model.sources:
        raise UnknownError
    *path, _ = function["name"].split(".")
    package = library.default(".".join(path), around) if path else None
    return plain_function(library, library.class_at(span["source"], model.offset(span)), package)
