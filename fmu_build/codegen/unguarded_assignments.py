"""Reject assignments of an ``elsewhen`` in an algorithm that rumoca carries out beside an earlier branch.

rumoca makes an equation for each variable, from the branches that assign it. A branch that does not assign it
has no part in that equation, and so does not keep a later one from deciding at the same event.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from fmu_build.codegen.compiled import CompiledModel, Span, expressions

Tree = Mapping[str, Any]


def reject_unguarded_assignments(model: CompiledModel) -> None:
    """Raise `UnsupportedModelError` for the first such assignment."""
    for clause in expressions(model.flat["algorithms"], "When"):
        earlier: list[tuple[Tree, set[str]]] = []
        for block in clause["blocks"]:
            guards = [always for cond, always in earlier if not _at_other_events(cond, block["cond"])]
            for name, span in _assigned(block["stmts"]):
                if not all(name in always for always in guards):
                    _refuse(model, clause, name, span)
            earlier.append((block["cond"], _always_assigned(block["stmts"])))


def _refuse(model: CompiledModel, clause: Tree, name: str, span: Span) -> None:
    conditions = [block["cond"] for block in clause["blocks"]]
    sampled = any(call["function"] == "Sample" for call in expressions(conditions, "BuiltinCall"))
    instead = (
        "one when-clause that samples at a common period and counts"
        if sampled
        else f"{name} := pre({name}) in the earlier branch too"
    )
    raise model.unsupported(
        f"an elsewhen of an algorithm assigns {name}, which an earlier branch does not assign in every case: "
        f"the compiler would carry it out even if the earlier branch has fired; write {instead}",
        span,
    )


def _at_other_events(one: Tree, other: Tree) -> bool:
    """Return whether two conditions surely become true at different events: a and not a, initial() and a.

    During initialization, only branches with initial() itself in their condition are active.
    """
    if one.get("BuiltinCall", {}).get("function") == "Initial":
        return all(call["function"] != "Initial" for call in expressions(other, "BuiltinCall"))
    return _is_negation(one, other) or _is_negation(other, one)


def _is_negation(one: Tree, other: Tree) -> bool:
    """Return whether a condition is ``not v`` and the other one the variable v."""
    unary = one.get("Unary", {})
    if unary.get("op") != "Not" or "VarRef" not in unary["rhs"] or "VarRef" not in other:
        return False
    inside, alone = unary["rhs"]["VarRef"], other["VarRef"]
    return bool(
        inside["name"]["name"] == alone["name"]["name"] and not inside["subscripts"] + alone["subscripts"]
    )


def _assigned(statements: Iterable[Tree]) -> Iterator[tuple[str, Span]]:
    """Yield the variables that statements assign in some case, with their places.

    Single elements of arrays, which the generator does not support, count as the array.
    """
    targets = [one["comp"] for one in expressions(statements, "Assignment")]
    for call in expressions(statements, "FunctionCall"):
        targets += call.get("outputs", [])
    for target in targets:
        yield ".".join(part["ident"] for part in target["parts"]), target["span"]


def _always_assigned(statements: Iterable[Tree]) -> set[str]:
    """Return the variables that statements assign in every case."""
    always: set[str] = set()
    for one in statements:
        if "If" not in one:
            always |= {name for name, _ in _assigned([one])}
        elif one["If"]["else_block"] is not None:
            blocks = [*(block["stmts"] for block in one["If"]["cond_blocks"]), one["If"]["else_block"]]
            always |= set.intersection(*map(_always_assigned, blocks))
    return always
