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

from fmu_build.codegen.second_reading.arithmetic import UnknownError
from fmu_build.codegen.second_reading.givens import Scope
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.syntax import Tokens

#: What makes arrays, or of which a part is left out.
_NOT_SCALAR: Final = frozenset(("{", "[", ":", "for", "if"))
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
    for name in _names(tokens):
        with suppress(UnknownError):
            if not instances.means_member(name, scope):
                meant = instances.constant(name, scope)
                if isinstance(meant, list):
                    continue
                if not any(math.isclose(meant, value, rel_tol=1e-9) for value in values):
                    yield f"the value of {name} is not {meant:g}"


def _names(tokens: Tokens) -> Iterator[str]:
    """Yield the qualified names in an expression, but not those of functions."""
    name = ""
    for token, after in zip(tokens, (*tokens[1:], ""), strict=True):
        if token == "." or (token.isidentifier() and (not name or name.endswith("."))):
            name += token
        if name and after != "." and not name.endswith("."):
            if after not in ("(", "="):
                yield name
            name = ""


def _collect(tree: Any, values: list[float]) -> float | None:
    """Add the values of all constant parts of an expression; return that of the whole."""
    if isinstance(tree, list):
        for one in tree:
            _collect(one, values)
        return None
    if not isinstance(tree, dict):
        return None
    found = None
    if "Literal" in tree:
        found = next(iter(tree["Literal"]["value"].values()))
    elif "Unary" in tree and (inner := _collect(tree["Unary"]["rhs"], values)) is not None:
        found = -inner
    elif "Binary" in tree:
        one, other = (_collect(tree["Binary"][side], values) for side in ("lhs", "rhs"))
        operation = _OPERATIONS.get(str(tree["Binary"]["op"]))
        if one is not None and other is not None and operation is not None:
            with suppress(ZeroDivisionError):
                found = operation(one, other)
    else:
        for one in tree.values():
            _collect(one, values)
    if isinstance(found, (int, float)):
        values.append(float(found))
        return float(found)
    return None
