"""Find constants of packages whose values rumoca has written into an equation wrongly.

rumoca replaces the name of a constant by the expression of its declaration, and so on for the names in that.
The value of each constant must be that of a part of the equation.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any, Final

from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.second_reading.arithmetic import UnknownError
from fmu_build.codegen.second_reading.givens import Scope
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.syntax import Tokens

#: What makes arrays, or of which a part is left out.
_NOT_SCALAR: Final = frozenset(("{", "[", ":", "for", "if"))
_CALLS: Final = frozenset(("Array", "BuiltinCall", "FunctionCall", "If", "Index"))
_OPERATIONS: Final[Mapping[str, Callable[[float, float], float]]] = {
    "Add": operator.add,
    "Sub": operator.sub,
    "Mul": operator.mul,
    "Div": operator.truediv,
}


def mistaken_constants(instances: Instances, scope: Scope, tokens: Tokens, tree: Any) -> Iterator[str]:
    """Yield the constants in an equation, with these tokens, whose values are not in rumoca's expression."""
    if _NOT_SCALAR & {*tokens}:
        return
    values: list[float] = []
    _collect(tree, values)
    if any(map(math.isnan, values)):
        return  # One of the values is that of a function.
    for name in names_of_constants(tokens):
        with suppress(UnknownError):
            if not instances.means_member(name, scope) and not instances.means_literal(name, scope):
                meant = instances.constant(name, scope)
                if isinstance(meant, list):
                    continue
                if not any(math.isclose(meant, value, rel_tol=1e-9) for value in values):
                    yield f"the value of {name} is not {meant:g}"


def names_of_constants(tokens: Tokens) -> Iterator[str]:
    """Yield the qualified names in an expression, but not those of functions."""
    name = ""
    for token, after in zip(tokens, (*tokens[1:], ""), strict=False):
        if token == "." or (token.isidentifier() and (not name or name.endswith("."))):
            name += token
        if name and after != "." and not name.endswith("."):
            if after not in ("(", "="):
                yield name
            name = ""


def _collect(tree: Any, values: list[float]) -> float | None:
    """Add the values of all constant parts of an expression; return that of the whole."""
    found: float | None = None
    if isinstance(tree, list):
        for one in tree:
            _collect(one, values)
    elif isinstance(tree, dict) and "Binary" in tree:
        found = _of_binary(tree["Binary"], values)
    elif isinstance(tree, dict) and tree.keys() & _CALLS and next(expressions(tree, "VarRef"), None) is None:
        found = math.nan
    elif isinstance(tree, dict):
        inner = _literal(tree["Literal"]) if "Literal" in tree else _collect([*tree.values()], values)
        if "Unary" in tree and (operand := _collect(tree["Unary"]["rhs"], values)) is not None:
            inner = -operand
        found = inner
    if found is not None:
        values.append(found)
    return found


def _literal(literal: Mapping[str, Any]) -> float | None:
    value = next(iter(literal["value"].values()))
    return float(value) if isinstance(value, (int, float)) else None


def _of_binary(tree: Mapping[str, Any], values: list[float]) -> float | None:
    one, other = (_collect(tree[side], values) for side in ("lhs", "rhs"))
    if one is None or other is None:
        return None
    operation = _OPERATIONS.get(str(tree["op"]))
    if operation is None or (operation is operator.truediv and not other):
        return math.nan
    return operation(one, other)
