"""Reject models that rumoca would lower incorrectly without a message; the error names construct and line."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.computed_connections import computed_connections
from fmu_build.codegen.connected_slices import reject_reordered_connections
from fmu_build.codegen.lost_equations import reject_lost_equations
from fmu_build.codegen.lost_modifiers import reject_lost_modifiers
from fmu_build.codegen.lowered import LoweredModel, slot_of
from fmu_build.codegen.member_slices import reject_member_slices
from fmu_build.codegen.mistaken_names import reject_mistaken_names
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.codegen.not_discrete import reject_continuous_definitions
from fmu_build.codegen.record_constructors import mistaken_constructors
from fmu_build.codegen.second_reading.check import reject_other_values
from fmu_build.codegen.unguarded_assignments import reject_unguarded_assignments


def reject_unsupported(model: LoweredModel) -> list[str]:
    """Raise `UnsupportedModelError` for the first construct that would be translated incorrectly."""
    _reject_operators(model)
    _reject_initial_manifold(model)
    _reject_surplus_initial_equations(model)
    _reject_undetermined_parameters(model)
    _reject_repeated_assignments(model)
    _reject_overridden_branches(model)
    _reject_unguarded_actions(model)
    reject_unguarded_assignments(model)
    _reject_repeated_samples(model)
    _reject_conditions_of_their_results(model)
    _reject_reordered_arguments(model)
    reject_member_slices(model)
    reject_reordered_connections(model)
    _reject_found(model)
    reject_lost_modifiers(model)
    reject_lost_equations(model)
    reject_mistaken_names(model)
    reject_continuous_definitions(model)
    return reject_other_values(model)


def _reject_found(model: LoweredModel) -> None:
    """Reject what is found in the source without regard to what rumoca made of it."""
    for find in (mistaken_constructors, computed_connections):
        for why, construct in find(model.classes):
            raise model.unsupported_at(why, construct)


def _reject_operators(model: LoweredModel) -> None:
    temporal = model.dae["systems"]["temporal"]
    for kind in ("delay", "terminal"):
        for call in temporal[f"{kind}s"]:
            raise model.unsupported(f"{kind}() is not supported", call["provenance"]["span"])


def _reject_initial_manifold(model: LoweredModel) -> None:
    if model.solve["initialization"]["manifold_row_count"]:
        raise model.unsupported(
            "the model has constraints between its states (an index above one), and the states that rumoca "
            "selects are valid for part of the motion only; write the model in independent coordinates"
        )


def _reject_surplus_initial_equations(model: LoweredModel) -> None:
    for row, role in enumerate(model.solve["initialization"]["row_roles"]):
        if role == "SurplusCheck":
            what = "there are more initial equations than unknowns"
            raise model.unsupported(what, initial_spans(model).get(row))


def initial_spans(model: LoweredModel) -> dict[int, Span]:
    """Return the source spans of initial equations by row, for tables with one output per program."""
    return dict(_row_spans(model.solve["initialization"]["residual"]["nodes"]))


def _row_spans(nodes: Iterable[Any]) -> Iterator[tuple[int, Span]]:
    for node in nodes:
        table = node.get("ScalarPrograms", {"output_indices": [], "program_spans": []})
        if len(table["output_indices"]) == len(table["program_spans"]):
            yield from zip(table["output_indices"], table["program_spans"], strict=True)


def _reject_undetermined_parameters(model: LoweredModel) -> None:
    """Reject a parameter with ``fixed = false`` that no initial equation determines."""
    initialization = model.solve["initialization"]
    blocks = initialization["projection_plan"]["blocks"]
    slots = [*initialization["update_targets"], *(slot for block in blocks for slot in block["unknowns"])]
    determined = set(map(slot_of, slots))
    for entry in model.dae["variables"]:
        attributes = entry["attributes"]
        if attributes["fixed"] is not False or attributes["binding"] is not None:
            continue
        for name in entry["scalar_names"]:
            slot = model.slots.get(name)
            if entry["role"] == "parameter" and slot is not None and slot not in determined:
                raise model.unsupported(
                    f"the parameter {name} has fixed = false, and no initial equation determines it",
                    entry["declaration"]["span"],
                )


def _reject_repeated_assignments(model: LoweredModel) -> None:
    """Reject repeated assignments to a discrete Real in a when-clause: the first unconditional one wins."""
    expressions = model.dae["expressions"]
    unconditional: set[tuple[object, object]] = set()
    for row in model.dae["systems"]["discrete_real"]["residuals"]:
        target = expressions[expressions[row["residual"]]["operation"].get("lhs", 0)]["operation"]
        activation = row["activation"]
        if activation.get("kind") != "when" or target["kind"] != "coordinate":
            continue
        key = (target["coordinate"]["id"], activation["trigger"])
        if key in unconditional:
            raise model.unsupported(
                "a discrete variable is assigned again after an assignment in the same when-clause; "
                "write one assignment with an if-expression",
                row["provenance"]["span"],
            )
        if activation["guard"] == activation["trigger"]:
            unconditional.add(key)


def _reject_overridden_branches(model: LoweredModel) -> None:
    """Reject an if-equation in an ``elsewhen`` that rumoca puts before an earlier branch without one.

    It does so for variables of all types but Real.
    """
    reals = {one["name"] for one in model.dae["variables"] if one["value_type"]["scalar"] == "real"}
    for chain in model.flat["when_chains"]:
        before: set[str] = set()
        for branch in (chain["first"], *chain["else_when"]):
            conditional = [one for one in branch["equations"] if "Conditional" in one]
            overriding = {one["target"] for one in expressions(conditional, "Assign")} & before - reals
            if overriding:
                raise model.unsupported(
                    f"an if-equation for {min(overriding)} in an elsewhen is not supported after a branch "
                    "that sets it without one, because the compiler would let the later one decide if both "
                    "conditions become true at once; write x = if condition then value else other",
                    branch["span"],
                )
            before |= {one["Assign"]["target"] for one in branch["equations"] if "Assign" in one}


def _reject_unguarded_actions(model: LoweredModel) -> None:
    """Reject actions of an ``elsewhen``: rumoca carries them out even if an earlier branch has fired.

    It is right for states that all earlier branches reinitialize too, because the first one decides.
    """
    for chain in model.flat["when_chains"]:
        before = _reinitialized(chain["first"]["equations"])
        for branch in chain["else_when"]:
            inside = branch["equations"]
            states = {one["state"] for one in expressions(inside, "Reinit")}
            has_others = any(next(expressions(inside, kind), None) for kind in ("Assert", "Terminate"))
            if has_others or not states <= before:
                _refuse_actions(model, branch["span"])
            before &= _reinitialized(inside)
    for clause in expressions(model.flat["algorithms"], "When"):
        for block in clause["blocks"][1:]:
            for found in expressions(block["stmts"], "Assert"):
                _refuse_actions(model, found["span"])


def _reinitialized(equations: list[dict[str, Any]]) -> set[str]:
    """Return the states that a branch reinitializes in any case."""
    return {one["Reinit"]["state"] for one in equations if "Reinit" in one}


def _refuse_actions(model: LoweredModel, span: Span) -> None:
    raise model.unsupported(
        "reinit(), assert() and terminate() in an elsewhen are supported only if all earlier branches "
        "reinitialize the same variable, because the compiler would carry them out even if an earlier branch "
        "has fired; write a when-clause of its own: when b and not a then",
        span,
    )


def _reject_repeated_samples(model: LoweredModel) -> None:
    """Reject a condition with several ``sample()``; of two equal ones, rumoca leaves reinit() unguarded."""
    for chain in model.flat["when_chains"]:
        for branch in (chain["first"], *chain["else_when"]):
            calls = expressions(branch["condition"], "BuiltinCall")
            if len([call for call in calls if call["function"] == "Sample"]) > 1:
                raise model.unsupported(
                    "a when-clause with several sample() in its condition is not supported; sample at a "
                    "common period and count",
                    branch["span"],
                )


def _reject_conditions_of_their_results(model: LoweredModel) -> None:
    """Reject a when-clause that sets a discrete Real on which its condition depends: it cannot settle.

    rumoca reports such variables of other types.
    """
    chains = [(chain["first"], *chain["else_when"]) for chain in model.flat["when_chains"]]
    branches = [(one["condition"], one["equations"], one["span"]) for chain in chains for one in chain]
    for algorithm in model.flat["algorithms"]:
        for clause in expressions(algorithm, "When"):
            branches += [(one["cond"], one["stmts"], algorithm["span"]) for one in clause["blocks"]]
    for condition, statements, span in branches:
        targets = {one["target"] for one in expressions(statements, "Assign")}
        for one in expressions(statements, "Assignment"):
            targets.add(".".join(part["ident"] for part in one["comp"]["parts"]))
        for name in _read_now(condition):
            if name in targets:
                raise model.unsupported(
                    f"the condition of a when-clause reads {name}, which the clause sets; write pre({name})",
                    span,
                )


def _read_now(tree: Any) -> Iterator[str]:
    """Yield the variables that an expression reads outside of pre(), edge() and change()."""
    if isinstance(tree, dict):
        if "VarRef" in tree:
            yield tree["VarRef"]["name"]["name"]
        if tree.get("BuiltinCall", {}).get("function") in ("Pre", "Edge", "Change"):
            return
        tree = tree.values()
    elif not isinstance(tree, list):
        return
    for child in tree:
        yield from _read_now(child)


def _reject_reordered_arguments(model: LoweredModel) -> None:
    """Reject named arguments out of order in ``(a, b) := f(...)``: rumoca takes them in order."""
    functions = model.flat["functions"]
    for function in functions.values():
        calls = [call for call in expressions(function["body"], "FunctionCall") if "outputs" in call]
        for call in calls:
            inputs = functions.get(call["comp"]["name"], {}).get("inputs", ())
            for number, name in _named_arguments(model, call):
                if number >= len(inputs) or inputs[number]["name"] != name:
                    raise model.unsupported(
                        f"the argument {name} would be taken for another, because a call in a function that "
                        "takes several results has its arguments in the order of the declaration; give them "
                        "in this order",
                        call["span"],
                    )


def _named_arguments(model: LoweredModel, call: Mapping[str, Any]) -> Iterator[tuple[int, str]]:
    """Yield position and name of the arguments that a call gives by name."""
    end = call["span"]["end"]
    for number, argument in enumerate(call["args"]):
        ((_, content),) = argument.items()
        span = content["span"]
        before = model.text({"source": span["source"], "start": end, "end": span["start"]})
        if found := re.search(r"[(,]\s*([\w']+)\s*=[\s(]*$", blanked(before)):
            yield number, found[1]
        end = span["end"]
