"""Parameters whose value the compiler has put into the code, so that setting them would have no effect."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fmu_build.codegen.lowered import LoweredModel


def baked_parameters(model: LoweredModel) -> frozenset[str]:
    """Names of the parameters that the arguments of ``sample()`` are computed from.

    rumoca turns period and phase into numbers. The flat model still has the calls with their arguments.
    """
    variables = model.flat["variables"]
    baked: set[str] = set()
    waiting = [name for call in _calls(model.flat, "Sample") for name in _references(call["args"])]
    while waiting:
        name = waiting.pop()
        if name in variables and name not in baked:
            baked.add(name)
            waiting.extend(_references(variables[name]["binding"]))
    return frozenset(baked)


def _calls(tree: Any, function: str) -> Iterator[dict[str, Any]]:
    for node in _mappings(tree):
        call = node.get("BuiltinCall")
        if isinstance(call, dict) and call.get("function") == function:
            yield call


def _references(tree: Any) -> Iterator[str]:
    for node in _mappings(tree):
        reference = node.get("VarRef")
        if isinstance(reference, dict):
            name = reference["name"]
            yield name["name"] if isinstance(name, dict) else name


def _mappings(tree: Any) -> Iterator[dict[str, Any]]:
    if isinstance(tree, dict):
        yield tree
        tree = tree.values()
    elif not isinstance(tree, list):
        return
    for child in tree:
        yield from _mappings(child)
