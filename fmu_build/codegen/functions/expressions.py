"""Translate expressions in bodies of Modelica functions, element by element.

An array expression is never built as a whole: `element` returns the scalar at a position, which may depend on
the variables of C loops. Expressions that need statements (long sums, calls with several results) insert them
before the current statement.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Protocol

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.builtins import Builtins, equal
from fmu_build.codegen.functions.code import FunctionCode, twin
from fmu_build.codegen.functions.dae import FunctionDae, Operation
from fmu_build.codegen.functions.index import Index, Position, positions
from fmu_build.codegen.functions.loops import ArrayLoops
from fmu_build.codegen.functions.signature import FunctionSignature
from fmu_build.codegen.functions.subscripts import Subscripts

_CONCATENATIONS = {"promoted_cat1": 0, "promoted_cat2": 1}

At = tuple[Position, ...]


class Callees(Protocol):
    """Maps the Modelica functions that a body calls to C functions."""

    def signature(self, function: int) -> FunctionSignature:
        """Return the signature of the function with this id."""


class FunctionExpressions:
    """Translates the expressions of one function.

    `parameters` and `variables` hold C names by number; `current` holds the definition whose value each
    variable has at the statement being written.
    """

    def __init__(self, dae: FunctionDae, code: FunctionCode, callees: Callees) -> None:
        self.parameters: dict[int, str] = {}
        self.variables: dict[int, str] = {}
        self.current: dict[int, int] = {}
        self.subscripts = Subscripts(dae, code, self.element)
        self.loops = ArrayLoops(code)
        self._dae = dae
        self._code = code
        self._callees = callees
        builtins = Builtins(dae, self.subscripts, self.loops, self.element)
        self._by_kind: dict[str, Callable[[int, Operation, At], Expression]] = {
            "literal": self._literal,
            "coordinate": self._reference,
            "function_value": self._reference,
            "unary": builtins.unary,
            "binary": builtins.binary,
            "builtin": builtins.builtin,
            "conditional": self._conditional,
            "index": self._index,
            "comprehension": self._comprehension,
            "range": self._range,
            "array_update": self._updated,
            "call": self._call,
        }

    def scalar(self, number: int) -> Expression:
        """Return the value of a scalar expression."""
        return self.element(number, ())

    def text(self, number: int) -> str:
        """Return the C text of a scalar expression."""
        return self._code.text(self.scalar(number))

    def element(self, number: int, at: At) -> Expression:
        """Return the element of an expression at a position, which is empty for a scalar."""
        operation = self._dae.operation(number)
        if self.is_list(number):
            return self._listed(number, operation, at)
        translate = self._by_kind.get(operation["kind"])
        if translate is None:
            raise self._dae.unsupported(f"operation {operation['kind']}", number)
        return translate(number, operation, at)

    def _literal(self, number: int, operation: Operation, at: At) -> Expression:
        ((kind, content),) = operation["value"].items()
        if kind not in ("real", "integer", "boolean", "enumeration"):
            raise self._dae.unsupported(f"a literal of type {kind}", number)
        return ex.number(float(content))

    def _reference(self, number: int, operation: Operation, at: At) -> Expression:
        name = self._variable_name(number)
        if name is not None:
            return self.subscripts.read(name, self._dae.dimensions(number), at)
        kind = operation["coordinate"]["kind"]
        index = self.subscripts.integer(number, ()) if kind == "binder" else None
        if index is None:
            raise self._dae.unsupported(f"a reference to a {kind}", number)
        return self._code.index_value(index)

    def _variable_name(self, number: int) -> str | None:
        """Return the C variable that an expression reads, if it is a mere reference.

        Raises `UnsupportedModelError` if the variable no longer holds the value of that definition.
        """
        operation = self._dae.operation(number)
        if operation["kind"] == "function_value":
            if self.current.get(operation["value"]) != operation["definition"]:
                raise self._dae.unsupported("the use of a variable's earlier value", number)
            return self.variables[operation["value"]]
        if operation["kind"] == "coordinate" and operation["coordinate"]["kind"] == "function_parameter":
            return self.parameters[operation["coordinate"]["ordinal"]]
        return None

    def _conditional(self, number: int, operation: Operation, at: At) -> Expression:
        *arms, fallback = operation["operands"]
        result = self.element(fallback, at)
        for condition, value in reversed(list(zip(arms[::2], arms[1::2], strict=True))):
            result = ex.select(self.scalar(condition), self.element(value, at), result)
        return result

    def _index(self, number: int, operation: Operation, at: At) -> Expression:
        dimensions = self._dae.dimensions(operation["base"])
        base_at = self.subscripts.base_positions(operation["subscripts"], dimensions, at)
        return self.element(operation["base"], base_at)

    def _comprehension(self, number: int, operation: Operation, at: At) -> Expression:
        """Return an element of ``{body for i in ..., j in ...}``: the loops take the first positions."""
        domain = operation["domain"]
        loops = self._dae.loops(domain)
        for ordinal, (loop, position) in enumerate(zip(loops, at, strict=False)):
            if not isinstance(position, Index):
                return self._materialized(number, at)
            self.subscripts.binders[domain, ordinal] = position * loop["step"] + loop["lower"]
        return self.element(operation["body"], at[len(loops) :])

    def _range(self, number: int, operation: Operation, at: At) -> Expression:
        if not isinstance(at[0], Index):
            return self._materialized(number, at)
        index = self.subscripts.integer(number, at)
        if index is None:
            raise self._dae.unsupported("a range whose bounds are not Integer constants", number)
        return self._code.index_value(index)

    def is_list(self, number: int) -> bool:
        """Return whether the expression lists its elements: ``{a, b, c}`` or ``[a, b; c, d]``."""
        operation = self._dae.operation(number)
        return operation["kind"] == "array" or operation.get("builtin") in _CONCATENATIONS

    def _listed(self, number: int, operation: Operation, at: At) -> Expression:
        place = tuple(p.constant for p in at if isinstance(p, Index) and p.is_constant)
        if len(place) < len(at):
            return self._materialized(number, at)
        if operation["kind"] == "array":
            return self.element(operation["elements"][place[0]], at[1:])
        axis = _CONCATENATIONS[operation["builtin"]]
        offset = place[axis]
        for part in operation["arguments"]:
            own = self._dae.dimensions(part)
            extent = (*own, 1, 1)[axis]
            if offset < extent:
                inside = (*place[:axis], offset, *place[axis + 1 :])
                return self.element(part, tuple(Index(p) for p in inside[: len(own)]))
            offset -= extent
        raise AssertionError(f"no element {place} in expression {number}")

    def _materialized(self, number: int, at: At) -> Expression:
        """Return an element of the expression, copied as a whole to a new array."""
        name = self._code.name("list")
        self._code.define_array(name, self.elements(number))
        return self.subscripts.read(name, self._dae.dimensions(number), at)

    def elements(self, number: int) -> list[Expression]:
        """Return all elements of an array in row-major order."""
        return [self.element(number, at) for at in positions(self._dae.dimensions(number))]

    def _updated(self, number: int, operation: Operation, at: At) -> Expression:
        """Return an element of an array in which one element has a new value."""
        if any(subscript["kind"] != "index" for subscript in operation["subscripts"]):
            raise self._dae.unsupported("the use of an array right after assigning to part of it", number)
        dimensions = self._dae.dimensions(operation["base"])
        places = self.subscripts.base_positions(operation["subscripts"], dimensions, ())
        is_there: Expression = ex.ONE
        for a, b in zip(at, places, strict=True):
            is_there = ex.binary("And", is_there, equal(self.subscripts.value(a), self.subscripts.value(b)))
        return ex.select(is_there, self.scalar(operation["value"]), self.element(operation["base"], at))

    def _call(self, number: int, operation: Operation, at: At) -> Expression:
        signature = self._callees.signature(operation["function"])
        call = self._call_text(number)
        if signature.returns_value:
            return self._code.leaf(call(""), lambda: self._tangent_call_text(number)(""), is_costly=True)
        name = self._code.results(call, lambda r: self._tangent_call_text(number)(r), signature.n_results)
        kinds = self._dae.functions[operation["function"]]["result_types"][: operation["output"]]
        offset = sum(math.prod(self._dae.dimensions_of_type(kind)) for kind in kinds)
        dimensions = self._dae.dimensions(number)
        if not dimensions:
            return self._code.variable(f"{name}[{offset}]")
        return self.subscripts.read(name, dimensions, at, offset)

    def is_only_result(self, number: int) -> bool:
        """Return whether this is a call with the array as its only result."""
        operation = self._dae.operation(number)
        if operation["kind"] != "call":
            return False
        return self._callees.signature(operation["function"]).n_results == self._dae.size(number)

    def call_into(self, number: int, name: str) -> None:
        """Write a call that stores its only result, an array, in `name`."""
        self._code.store_results(name, self._call_text(number), lambda r: self._tangent_call_text(number)(r))

    def _call_text(self, number: int) -> Callable[[str], str]:
        """Return a function that maps the name of the array for results, if any, to the C text of a call."""
        operation: dict[str, Any] = self._dae.operation(number)
        callee = self._dae.functions[operation["function"]]
        kinds = [parameter["value_type"] for parameter in callee["parameters"]]
        passed = [*zip(operation["arguments"], kinds, strict=True)]
        passed.append((number, callee["result_types"][operation["output"]]))
        if any(self._dae.dimensions(given) != self._dae.dimensions_of_type(kind) for given, kind in passed):
            raise self._dae.unsupported(f"a call of {callee['name']} for each element of an array", number)
        signature = self._callees.signature(operation["function"])
        arguments = [self._argument(argument) for argument in operation["arguments"]]
        return lambda results: signature.call(arguments, results)

    def _tangent_call_text(self, number: int) -> Callable[[str], str]:
        """Return the same for the call that computes the tangents of the results."""
        operation = self._dae.operation(number)
        signature = self._callees.signature(operation["function"]).tangent
        values = [self._argument(argument) for argument in operation["arguments"]]
        tangents = [self._argument(argument, is_tangent=True) for argument in operation["arguments"]]
        return lambda results: signature.call([*values, *tangents], results)

    def _argument(self, number: int, is_tangent: bool = False) -> str:
        if not self._dae.dimensions(number):
            value = self.scalar(number)
            return self._code.text(self._code.tangent(value) if is_tangent else value)
        name = self._variable_name(number)
        if name is not None:
            return twin(name) if is_tangent else name
        values = self.elements(number)
        texts = [self._code.text(self._code.tangent(v) if is_tangent else v) for v in values]
        return f"(const double[]){{{', '.join(texts)}}}"
