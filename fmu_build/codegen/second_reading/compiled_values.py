"""The values of rumoca's expressions at a point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.arithmetic import OPERATORS, built_in
from fmu_build.codegen.second_reading.called_functions import variables_of
from fmu_build.codegen.second_reading.functions import Function, plain_function
from fmu_build.codegen.second_reading.gathered import flattened, gathered, indexed, leaves_in
from fmu_build.codegen.second_reading.known_variables import Variables
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
from fmu_build.codegen.second_reading.records import Constructor, constructor, member_of
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
        elif name in self._point.instances.order and not content["subscripts"]:
            return gathered(self._point.instances, name, [], self._point.of)
        else:
            value = self._point.of(member_of_input(self._point.instances, name))
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
        if sign == "-" and "Tuple" in content["lhs"]:
            return self._results(*sides)
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
        of_sizes = {
            id(one)
            for call in expressions(tree, "BuiltinCall")
            if call["function"] == "Size"
            for one in expressions(call["args"], "VarRef")
        }
        names = (one["name"]["name"] for one in expressions(tree, "VarRef") if id(one) not in of_sizes)
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
        """Return an array whose first dimension belongs to the first iterator, as rumoca takes it."""
        if not indices:
            return self.of(body)
        first, *inner = indices
        numbers = self.of(first["range"])
        points = ({**self._iterators, first["name"]: float(one)} for one in numbers.flat)
        return as_value(
            [CompiledValues(self._model, self._point, one)._elements(body, inner) for one in points]
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
        name = content["name"]["name"]
        return self._constructed(content) if content["is_constructor"] else self.result(name, content, 0)

    def _constructed(self, content: Mapping[str, Any]) -> Value:
        function = self._function(content["name"]["name"])
        return self._point.constructed(self._constructor(content), [], self._arguments(function, content))

    def _arguments(self, function: Mapping[str, Any], content: Mapping[str, Any]) -> dict[str, Value]:
        """Return the arguments of a call by the names that rumoca gives to the inputs."""
        names = [one["name"] for one in function["inputs"]]
        if len(names) != len(content["args"]):
            raise UnknownError
        return dict(zip(names, map(self.of, content["args"]), strict=True))

    def _constructor(self, content: Mapping[str, Any]) -> Constructor:
        """Return the constructor that is called."""
        function, instances = self._function(content["name"]["name"]), self._point.instances
        declared, package = compiled_class(self._model, instances.library, function, self._around(content))
        found = constructor(instances, declared, package)
        if found is None:
            raise UnknownError
        return found

    def _fieldaccess(self, content: Mapping[str, Any]) -> Value:
        names, ((kind, base),) = [content["field"]], content["base"].items()
        while kind == "FieldAccess":
            names.insert(0, base["field"])
            ((kind, base),) = base["base"].items()
        if kind in ("Index", "VarRef"):
            return self._of_component(kind, base, names)
        if kind != "FunctionCall":
            raise UnknownError
        record = self._functioncall(base)
        if base["is_constructor"]:
            return member_of(self._constructor(base).variables, "", record, names)
        instances = self._point.instances
        function = compiled_function(
            self._model, instances.library, self._function(base["name"]["name"]), self._around(base)
        )
        output, *_ = function.outputs
        return member_of(variables_of(instances, function), output, record, names)

    def result(self, name: str, content: Mapping[str, Any], place: int) -> Value:
        """Return the result in a place of a call of a function."""
        instances, function = self._point.instances, self._function(name)
        found = compiled_function(self._model, instances.library, function, self._around(content))
        values = self._arguments(function, content)
        return self._point.result(
            found, in_declared_order(found, variables_of(instances, found), values), place
        )

    def _of_component(self, kind: str, base: Mapping[str, Any], names: Sequence[str]) -> Value:
        """Return the value of a member, of which the names are nested, of a component or its elements."""
        if kind == "Index":
            ((inner, variable),) = base["base"].items()
            if inner != "VarRef" or variable["subscripts"]:
                raise UnknownError
            base = {"name": variable["name"], "subscripts": base["subscripts"]}
        path, _, last = base["name"]["name"].rpartition(".")
        reference = [(last, self._subscripts(base)), *((name, ()) for name in names)]
        return gathered(self._point.instances, path, reference, self._point.of)

    def _function(self, name: str) -> Mapping[str, Any]:
        found: Mapping[str, Any] | None = self._model.flat["functions"].get(name)
        if found is None:
            raise UnknownError
        return found

    def _around(self, content: Mapping[str, Any]) -> Class:
        """Return the class in which a call stands."""
        span = content["span"]
        if span["source"] not in self._model.sources:
            raise UnknownError
        return self._point.instances.library.class_at(span["source"], self._model.offset(span))

    def _results(self, names: Mapping[str, Any], call: Mapping[str, Any]) -> Value:
        """Return the residuals of ``(a, b) = f(x)``."""
        if call.keys() != {"FunctionCall"}:
            raise UnknownError
        content, pairs = call["FunctionCall"], []
        for place, variable in enumerate(names["Tuple"]["elements"]):
            if "Empty" not in variable:
                pairs.append((self.of(variable), self.result(content["name"]["name"], content, place)))
        if any(a.shape != b.shape for a, b in pairs):
            raise UnknownError
        return flattened(a - b for a, b in pairs)


def in_declared_order(function: Function, variables: Variables, values: Mapping[str, Value]) -> list[Value]:
    """Return the arguments of a function by the order of its inputs; rumoca may have another one.

    A record is the vector of its members, for each of which rumoca has an argument, as ``r_a``. Raises
    `UnknownError` if names differ.
    """
    found = []
    for name in function.inputs:
        if name in values:
            found.append(values[name])
        else:
            members = [leaf.replace(".", "_") for leaf in leaves_in(variables, name)]
            if not values.keys() >= {*members}:
                raise UnknownError
            found.append(flattened(values[one] for one in members))
    return found


def member_of_input(instances: Variables, name: str) -> str:
    """Return the member of a record for which rumoca has made an input with this name, as ``r_a``.

    Raises `UnknownError` if there is none, or more than one.
    """
    found = [one for one in instances.leaves if "." in one and one.replace(".", "_") == name]
    if len(found) != 1:
        raise UnknownError
    return found[0]


def compiled_function(
    model: LoweredModel, library: Library, function: Mapping[str, Any], around: Class
) -> Function:
    """Return the function of the source that rumoca has found for a call in a class.

    Raises `UnknownError` if it is not known.
    """
    return plain_function(library, *compiled_class(model, library, function, around))


def compiled_class(
    model: LoweredModel, library: Library, function: Mapping[str, Any], around: Class
) -> tuple[Class, Class | None]:
    """Return the class of a function or record that is called in a class, and the package that it names."""
    span = function["span"]
    if span["source"] not in model.sources:
        raise UnknownError
    *path, _ = function["name"].split(".")
    package = library.default(".".join(path), around) if path else None
    return library.class_at(span["source"], model.offset(span)), package
