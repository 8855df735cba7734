"""Models that rumoca lowers without complaint, but not to what they mean: refused by name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.source_text import blanked

_LOST_MODIFIERS = (
    (
        re.compile(
            r"\bredeclare\s+(?:replaceable\s+)?(?:model|block|record|type|package|class)\s+\w+\s*=\s*[\w.]+\s*\("
        ),
        "the modifiers of a class that is redeclared inside a modifier are lost; "
        "give the class with its modifiers a name of its own",
    ),
    (
        re.compile(r"\bconstrainedby\s+[\w.]+\s*\("),
        "the modifiers of a constraining class are lost; put them on the component",
    ),
)


def refuse_unfaithful(model: LoweredModel) -> None:
    """Raises `UnsupportedModelError` for the first construct of the model that would come out wrong."""
    _refuse_delays(model)
    _refuse_dynamic_state_selection(model)
    _refuse_loose_initial_equations(model)
    _refuse_repeated_assignments(model)
    _refuse_lost_modifiers(model)


def _refuse_delays(model: LoweredModel) -> None:
    temporal = model.dae["systems"]["temporal"]
    for delay in temporal["delays"]:
        raise model.refuse("delay() is not supported", delay.get("provenance", {}).get("span"))
    if temporal["terminals"]:
        raise model.refuse("terminal() is not supported")


def _refuse_dynamic_state_selection(model: LoweredModel) -> None:
    names = model.solve["solve_layout"]["solver_maps"]["names"]
    chosen = any(name.startswith("$state_coordinates") for name in names)
    if chosen or model.solve["initialization"]["manifold_row_count"]:
        raise model.refuse(
            "the model has constraints between its states (an index above one), and the states that "
            "were chosen would do in a part of the motion only; write it in independent coordinates"
        )


def _refuse_loose_initial_equations(model: LoweredModel) -> None:
    for role in model.solve["initialization"]["row_roles"]:
        if role == "SurplusCheck":
            raise model.refuse("there are more initial equations than values to be found")
        if isinstance(role, dict) and "UnownedCoordinate" in role:
            raise model.refuse(
                "an initial equation for a discrete variable is supported only as pre(v) = ..."
            )


def _refuse_repeated_assignments(model: LoweredModel) -> None:
    """Of several assignments to a discrete Real in one when-clause the first unconditional one would win."""
    expressions = model.dae["expressions"]
    unconditional: set[tuple[object, object]] = set()
    for row in model.dae["systems"]["discrete_real"]["residuals"]:
        target = expressions[expressions[row["residual"]]["operation"].get("lhs", 0)]["operation"]
        activation = row["activation"]
        if activation.get("kind") != "when" or target["kind"] != "coordinate":
            continue
        key = (target["coordinate"]["id"], activation["trigger"])
        if key in unconditional:
            raise model.refuse(
                "a discrete variable is assigned again after an assignment in the same when-clause; "
                "write one assignment with an if-expression",
                row["provenance"]["span"],
            )
        if activation["guard"] == activation["trigger"]:
            unconditional.add(key)


def _refuse_lost_modifiers(model: LoweredModel) -> None:
    used = set(_sources(model.flat))
    for number, _, text in model.source_files:
        if number not in used:
            continue
        plain = blanked(text)
        for pattern, why in _LOST_MODIFIERS:
            for match in pattern.finditer(plain):
                if _inside_parentheses(plain, match.start()) or "constrainedby" in match.group():
                    start = len(plain[: match.start()].encode())
                    raise model.refuse(why, {"source": number, "start": start})


def _inside_parentheses(text: str, position: int) -> bool:
    """Whether a redeclaration stands in a modifier; as an element of a class body it keeps its modifiers."""
    statement = text[text.rfind(";", 0, position) + 1 : position]
    return statement.count("(") > statement.count(")")


def _sources(tree: Any) -> Iterator[int]:
    """The numbers of the files that a model is made from."""
    if isinstance(tree, dict):
        if isinstance(tree.get("source"), int):
            yield tree["source"]
        tree = tree.values()
    elif not isinstance(tree, list):
        return
    for child in tree:
        yield from _sources(child)
