"""Expressions in bodies of Modelica functions, element by element.

An array expression is never built as a whole: `element` gives the scalar at a position, which may depend on the
variables of C loops. What needs statements of its own (long sums, calls with several results) puts them in front.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import Expression
from fmu_build.codegen.functions.code import FunctionCode
from fmu_build.codegen.functions.dae import FunctionDae
from fmu_build.codegen.functions.index import Index, LoopVariable, Position, positions
from fmu_build.codegen.functions.signature import FunctionSignature
from fmu_build.codegen.functions.subscripts import Subscripts

_UNROLLED = 3
"""Up to so many elements are written one by one instead of in a loop."""

_OPERATORS = {
    "add": "Add",
    "subtract": "Sub",
    "multiply": "Mul",
    "divide": "Div",
    "power": "Pow",
    "and": "And",
    "or": "Or",
    "less": "Lt",
    "less_equal": "Le",
    "greater": "Gt",
    "greater_equal": "Ge",
    "equal": "Eq",
    "not_equal": "Ne",
}
_UNARY_BUILTINS = {name.lower(): name for name in ex.UNARY - {"Neg", "Not", "Trunc"}} | {"integer": "Floor"}
_REDUCTIONS = {
    "sum": ("Add", 0.0),
    "product": ("Mul", 1.0),
    "min": ("Min", math.inf),
    "max": ("Max", -math.inf),
}
_CONCATENATIONS = {"promoted_cat1": 0, "promoted_cat2": 1}


class Callees(Protocol):
    """Knows the C functions of the Modelica functions that a body calls."""

    def signature(self, function: int) -> FunctionSignature: ...


class FunctionExpressions:
    """Translates the expressions of one function.

    `parameters` and `variables` are the C names by number; `current` is the definition whose value each variable
    has at the point that is being written.
    """

    def __init__(self, dae: FunctionDae, code: FunctionCode, callees: Callees) -> None:
        self.parameters: dict[int, str] = {}
        self.variables: dict[int, str] = {}
        self.current: dict[int, int] = {}
        self.subscripts = Subscripts(dae, code, self.element)
        self._dae = dae
        self._code = code
        self._callees = callees
        self._called: dict[str, str] = {}

    def forget_calls(self) -> None:
        """Results of calls are not used again once a variable may have changed or a block has ended."""
        self._called.clear()

    def scalar(self, number: int) -> Expression:
        return self.element(number, ())

    def text(self, number: int) -> str:
        return self._code.text(self.scalar(number))

    def element(self, number: int, at: tuple[Position, ...]) -> Expression:
        """The element of an expression at a position (none for a scalar)."""
        operation = self._dae.operation(number)
        if self.is_list(number):
            return self._listed(number, operation, at)
        match operation["kind"]:
            case "literal":
                return self._literal(operation["value"], number)
            case "coordinate" | "function_value":
                return self._reference(operation, number, at)
            case "unary" if operation["operator"] in ("negate", "not"):
                name = "Neg" if operation["operator"] == "negate" else "Not"
                return ex.unary(name, self.element(operation["operand"], at))
            case "binary":
                return self._binary(number, operation, at)
            case "conditional":
                return self._conditional(operation["operands"], at)
            case "builtin":
                return self._builtin(number, operation, at)
            case "index":
                base = operation["base"]
                dimensions = self._dae.dimensions(base)
                return self.element(
                    base, self.subscripts.base_positions(operation["subscripts"], dimensions, at)
                )
            case "comprehension":
                return self._comprehension(operation, number, at)
            case "range":
                index = self.subscripts.integer(number, at)
                return self._materialized(number, at) if index is None else self._code.index_value(index)
            case "array_update":
                return self._updated(operation, number, at)
            case "call":
                return self._call(number, operation, at)
            case kind:
                raise self._dae.refuse(f"operation {operation.get('operator', kind)}", number)

    def _literal(self, value: Mapping[str, Any], number: int) -> Expression:
        ((kind, content),) = value.items()
        if kind not in ("real", "integer", "boolean", "enumeration"):
            raise self._dae.refuse(f"a literal of type {kind}", number)
        return ex.number(float(content))

    def _reference(self, operation: Mapping[str, Any], number: int, at: tuple[Position, ...]) -> Expression:
        name = self._array_name(number)
        if name is not None:
            return self.subscripts.read(name, self._dae.dimensions(number), at)
        coordinate = operation["coordinate"]
        index = self.subscripts.integer(number, ()) if coordinate["kind"] == "binder" else None
        if index is None:
            raise self._dae.refuse(f"a reference to a {coordinate['kind']}", number)
        return self._code.index_value(index)

    def _array_name(self, number: int) -> str | None:
        """The C variable that an expression is, if it is one; it has to hold the value that is meant."""
        operation = self._dae.operation(number)
        if operation["kind"] == "function_value":
            if self.current.get(operation["value"]) != operation["definition"]:
                raise self._dae.refuse("the use of a variable's earlier value", number)
            return self.variables[operation["value"]]
        if operation["kind"] == "coordinate" and operation["coordinate"]["kind"] == "function_parameter":
            return self.parameters[operation["coordinate"]["ordinal"]]
        return None

    def _binary(self, number: int, operation: Mapping[str, Any], at: tuple[Position, ...]) -> Expression:
        operator, a, b = operation["operator"], operation["lhs"], operation["rhs"]
        if operator == "multiply" and self._dae.dimensions(a) and self._dae.dimensions(b):
            return self._contraction(a, b, at)
        name = _OPERATORS.get(operator.removeprefix("elementwise_"))
        if name is None or (operator == "power" and at):
            raise self._dae.refuse(f"operator {operator} of {len(at)}-dimensional operands", number)
        operands = self._broadcast(a, at), self._broadcast(b, at)
        return Expression(name, operands) if name in ex.COMPARE else ex.binary(name, *operands)

    def _broadcast(self, number: int, at: tuple[Position, ...]) -> Expression:
        return self.element(number, at if self._dae.dimensions(number) else ())

    def _contraction(self, a: int, b: int, at: tuple[Position, ...]) -> Expression:
        """The product of vectors and matrices: the sum over a's last and b's first axis."""
        outer = len(self._dae.dimensions(a)) - 1
        left, right = at[:outer], at[outer:]
        return self._accumulate(
            "sum",
            self._dae.dimensions(a)[-1:],
            lambda k: ex.binary("Mul", self.element(a, (*left, *k)), self.element(b, (*k, *right))),
        )

    def _accumulate(
        self, reduction: str, dimensions: tuple[int, ...], term: Callable[[tuple[Index, ...]], Expression]
    ) -> Expression:
        """Sum, product, minimum or maximum over all positions, in a loop in front where there are many."""
        operator, start = _REDUCTIONS[reduction]
        if math.prod(dimensions) <= _UNROLLED:
            first, *others = (term(position) for position in positions(dimensions))
            for other in others:
                first = ex.binary(operator, first, other)
            return first
        name = self._code.name(reduction)
        total = self._code.leaf(name)
        self._code.line(f"double {name} = {self._code.text(ex.number(start))};")

        def add(position: tuple[Index, ...]) -> None:
            self._code.line(f"{name} = {self._code.text(ex.binary(operator, total, term(position)))};")

        self.for_each(dimensions, add)
        return total

    def for_each(self, dimensions: tuple[int, ...], action: Callable[[tuple[Index, ...]], None]) -> None:
        """Do something at every position: one by one where they are few, else in C loops."""
        if math.prod(dimensions) <= _UNROLLED:
            for position in positions(dimensions):
                action(position)
            return
        variables = [LoopVariable(self._code.name("i"), 0, dimension - 1) for dimension in dimensions]
        for variable, dimension in zip(variables, dimensions, strict=True):
            self._code.open(
                f"for (int {variable.name} = 0; {variable.name} < {dimension}; ++{variable.name})"
            )
        self.forget_calls()
        action(tuple(Index.of(variable) for variable in variables))
        self.forget_calls()
        for variable in variables:
            self._code.close()
            self._code.release(variable.name)

    def _conditional(self, operands: Sequence[int], at: tuple[Position, ...]) -> Expression:
        *arms, fallback = operands
        result = self.element(fallback, at)
        for condition, value in reversed(list(zip(arms[::2], arms[1::2], strict=True))):
            result = ex.select(self.scalar(condition), self.element(value, at), result)
        return result

    def _comprehension(
        self, operation: Mapping[str, Any], number: int, at: tuple[Position, ...]
    ) -> Expression:
        """``{body for i in ..., j in ...}``: the first positions are those of the loops."""
        loops = self._dae.loops(operation["domain"])
        for ordinal, (loop, position) in enumerate(zip(loops, at, strict=False)):
            if not isinstance(position, Index):
                return self._materialized(number, at)
            self.subscripts.binders[operation["domain"], ordinal] = position * loop["step"] + loop["lower"]
        return self.element(operation["body"], at[len(loops) :])

    def is_list(self, number: int) -> bool:
        """Whether the elements are written out one by one: ``{a, b, c}`` or ``[a, b; c, d]``."""
        operation = self._dae.operation(number)
        return operation["kind"] == "array" or operation.get("builtin") in _CONCATENATIONS

    def _listed(self, number: int, operation: Mapping[str, Any], at: tuple[Position, ...]) -> Expression:
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

    def _materialized(self, number: int, at: tuple[Position, ...]) -> Expression:
        """The element of a copy of the whole expression in an array of its own."""
        dimensions = self._dae.dimensions(number)
        name = self._code.name("list")
        elements = [self._code.text(self.element(number, position)) for position in positions(dimensions)]
        self._code.line(f"const double {name}[{len(elements)}] = {{{', '.join(elements)}}};")
        return self.subscripts.read(name, dimensions, at)

    def _updated(self, operation: Mapping[str, Any], number: int, at: tuple[Position, ...]) -> Expression:
        """An element of an array of which one element has a new value."""
        if any(subscript["kind"] != "index" for subscript in operation["subscripts"]):
            raise self._dae.refuse("the use of an array right after an assignment to a part of it", number)
        dimensions = self._dae.dimensions(operation["base"])
        places = self.subscripts.base_positions(operation["subscripts"], dimensions, ())
        is_there: Expression = ex.ONE
        for a, b in zip(at, places, strict=True):
            is_there = ex.binary("And", is_there, _equal(self.subscripts.value(a), self.subscripts.value(b)))
        return ex.select(is_there, self.scalar(operation["value"]), self.element(operation["base"], at))

    def _builtin(self, number: int, operation: Mapping[str, Any], at: tuple[Position, ...]) -> Expression:
        name, arguments = operation["builtin"], operation["arguments"]
        match name:
            case _ if name in _UNARY_BUILTINS:
                return ex.unary(_UNARY_BUILTINS[name], self.element(arguments[0], at))
            case "min" | "max" | "atan2" if len(arguments) == 2:
                return ex.binary(
                    name.capitalize(), *(self._broadcast(argument, at) for argument in arguments)
                )
            case "div" | "mod" | "rem":
                return _division(name, *(self._broadcast(argument, at) for argument in arguments))
            case _ if name in _REDUCTIONS:
                (array,) = arguments
                return self._accumulate(name, self._dae.dimensions(array), lambda k: self.element(array, k))
            case "size" if (size := self.subscripts.integer(number, at)) is not None:
                return self._code.index_value(size)
            case "no_event" | "smooth":
                return self.element(arguments[-1], at)
            case "zeros" | "ones":
                return ex.number(name == "ones")
            case "fill":
                return self.scalar(arguments[0])
            case "transpose":
                return self.element(arguments[0], (at[1], at[0], *at[2:]))
            case "identity":
                return _equal(*(self.subscripts.value(position) for position in at))
        raise self._dae.refuse(f"{name}()", number)

    def _call(self, number: int, operation: Mapping[str, Any], at: tuple[Position, ...]) -> Expression:
        signature = self._callees.signature(operation["function"])
        if signature.returns_value:
            return self._code.leaf(self.call(number), is_costly=True)
        call = self.call(number, "@")
        name = self._called.get(call)
        if name is None:
            name = self._code.name("r")
            self._called[call] = name
            self._code.line(f"double {name}[{signature.n_results}];")
            self._code.line(f"{call.replace('@', name)};")
        kinds = self._dae.functions[operation["function"]]["result_types"][: operation["output"]]
        offset = sum(math.prod(self._dae.dimensions_of_type(kind)) for kind in kinds)
        dimensions = self._dae.dimensions(number)
        if not dimensions:
            return self._code.leaf(f"{name}[{offset}]")
        return self.subscripts.read(name, dimensions, at, offset)

    def is_only_result(self, number: int) -> bool:
        """Whether a call has no other results than the array that this expression is."""
        operation = self._dae.operation(number)
        if operation["kind"] != "call":
            return False
        return self._callees.signature(operation["function"]).n_results == self._dae.size(number)

    def call(self, number: int, results: str = "") -> str:
        """The C text of a call that stores its results in the array `results`, if it does not return one."""
        operation = self._dae.operation(number)
        callee = self._dae.functions[operation["function"]]
        kinds = [parameter["value_type"] for parameter in callee["parameters"]]
        passed = [*zip(operation["arguments"], kinds, strict=True)]
        passed.append((number, callee["result_types"][operation["output"]]))
        if any(self._dae.dimensions(given) != self._dae.dimensions_of_type(kind) for given, kind in passed):
            raise self._dae.refuse(f"a call of {callee['name']} for each element of an array", number)
        arguments = [
            self._passed_array(argument) if self._dae.dimensions(argument) else self.text(argument)
            for argument in operation["arguments"]
        ]
        return self._callees.signature(operation["function"]).call(arguments, results)

    def _passed_array(self, number: int) -> str:
        name = self._array_name(number)
        if name is not None:
            return name
        elements = [
            self._code.text(self.element(number, at)) for at in positions(self._dae.dimensions(number))
        ]
        return f"(const double[]){{{', '.join(elements)}}}"


def _equal(a: Expression, b: Expression) -> Expression:
    return ex.number(a.value == b.value) if a.is_number and b.is_number else Expression("Eq", (a, b))


def _division(name: str, a: Expression, b: Expression) -> Expression:
    """Integer division and its remainders, Modelica 3.6 section 3.7.2."""
    quotient = ex.binary("Div", a, b)
    if name == "div":
        return ex.unary("Trunc", quotient)
    return ex.binary("Sub", a, ex.binary("Mul", ex.unary("Floor" if name == "mod" else "Trunc", quotient), b))
