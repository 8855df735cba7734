"""Explain why rumoca could not lower a model, with the position that its message lacks."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

from fmu_build.codegen.compiled import CompiledModel, Span, expressions, is_fixed
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.support.errors import UnsupportedModelError

_STAGE = re.compile(
    r"^(?:Target rendering error: |Lower Solve IR for target capability validation: )*"
    r"(?:.*unsupported checked DAE semantics: |DAE system is not computable: |invalid Solve IR contract: )?"
)
_RELATIONS = ("Lt", "Le", "Gt", "Ge", "Eq", "Neq")
_ATTRIBUTES = ("start", "min", "max", "nominal")

Obstacles = Iterator[tuple[str, Span | None]]
"""Unsupported constructs with their source spans."""


def not_lowered(model: CompiledModel, message: str) -> UnsupportedModelError:
    """Return the error for a model that compiles but cannot be lowered; `message` is rumoca's."""
    for pattern, obstacles in _FINDERS:
        match = re.search(pattern, message)
        if match is not None:
            for what, span in obstacles(model, match):
                return model.unsupported(what, span)
    return model.unsupported(f"rumoca cannot lower this model: {_STAGE.sub('', message)}")


def _strings(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    string = model.flat["predefined_types"]["string"]
    for name, variable in model.flat["variables"].items():
        declared = model.flat["effective_types"].get(str(variable["type_id"]))
        if declared and declared["canonical_type"] == string and not is_fixed(variable):
            yield f"the variable {name} of type String is not supported", variable["source_span"]


def _variable_attributes(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    """Find attributes that depend on inputs or unknowns: they must be known before the simulation."""
    variables = model.flat["variables"]
    for name, variable in variables.items():
        for attribute in _ATTRIBUTES:
            for reference in expressions(variable[attribute], "VarRef"):
                other = reference["name"]["name"]
                if other in variables and not is_fixed(variables[other]):
                    what = f"{attribute} of {name} depends on {other}, which is not a parameter"
                    yield what, reference["span"]


def _external_functions(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    for name, function in model.flat["functions"].items():
        if function["external"] is None:
            continue
        span = dict(function["span"])
        keyword = re.search(r"\bexternal\b", blanked(model.text(span)))
        if keyword is not None:
            span["start"] += len(model.text(span)[: keyword.start()].encode())
        yield f"the external function {name} is not supported", span


def _recursive_functions(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    for qualified, function in model.flat["functions"].items():
        name = qualified.rpartition(".")[2]
        if re.search(rf"\b{re.escape(name)}\s*\(", blanked(model.text(function["span"]))):
            yield f"the recursive function {name} is not supported", function["span"]
    yield "functions that call each other in turn are not supported", None


def _string_arguments(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    for name, function in model.flat["functions"].items():
        for argument in function["inputs"]:
            if argument["type_name"] == "String":
                yield (
                    f"the argument {argument['name']} of {name}, a String, is not supported",
                    argument["span"],
                )


def _strings_in_equations(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield "Strings in equations are not supported; they can be parameters and parts of messages", None


def _discrete_loops(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield (
        "discrete variables that depend on each other at the same instant are not supported; "
        "use pre() of one of them, or solve the equations for them",
        None,
    )


def _partly_sampled_clauses(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    for chain in model.flat["when_chains"]:
        for branch in chain["else_when"] and (chain["first"], *chain["else_when"]):
            for sample in _calls(branch["condition"], "Sample"):
                yield "sample() in one of several branches of a when-clause is not supported", sample["span"]
    yield "a when-clause with sample() beside another condition is not supported", None


def _mixed_samples(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    """Find the sampled clause with an if-equation whose conditions come from elsewhere."""
    for chain in model.flat["when_chains"]:
        conditional = [one for one in chain["first"]["equations"] if "Conditional" in one]
        for sample in _calls(chain["first"]["condition"], "Sample") if conditional else ():
            yield (
                "an if-equation in a when-clause with sample() is not supported if its conditions combine "
                "what clauses with other conditions set; write if-expressions, or pre() of these variables",
                sample["span"],
            )
            return
    yield (
        "conditions that combine what clauses with different sample() set are not supported; use pre()",
        None,
    )


def _read_at_a_sample(model: CompiledModel, message: re.Match[str]) -> Obstacles:
    name = message[1]
    yield (
        f"a when-clause with sample() that reads {name}, which another clause sets at the same instant from "
        f"what is sampled, is not supported: where the value from before is meant, write pre({name})",
        model.flat["variables"].get(name, {}).get("source_span"),
    )


def _listed_elements(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    yield (
        "elements that a list of indices selects, as v[{1, 3}], are not supported in this place; write them "
        "out, as {v[1], v[3]}",
        None,
    )


def _dependent_equations(_: CompiledModel, message: re.Match[str]) -> Obstacles:
    yield (
        f"only {message[1]} of {message[2]} equations determine an unknown of their own: some repeat or "
        "contradict others, or the derivative of an input or of a function is needed",
        None,
    )


def _matrix_powers(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield "powers of matrices are not supported; write A*A for A^2", None


def _discrete_arrays_in_loops(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield (
        "a for-loop over the elements of a discrete array outside a when-clause is not supported; write one "
        "equation for each element",
        None,
    )


def _absent_elements(_: CompiledModel, message: re.Match[str]) -> Obstacles:
    yield (
        f"the index {message[1]} is outside of 1 to {message[2]}, if only in a branch that is never taken; "
        "write the equations of such elements outside of the loop",
        None,
    )


def _reinitialized_dependents(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield (
        "reinit() is not supported for a variable that follows from a state by a constraint; "
        "apply it to the state",
        None,
    )


def _vanishing_derivatives(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield (
        "the factor of a der(...) is zero, or not finite, with the values of its parameters: a variable "
        "whose capacitance or inertia is zero is not a state; remove that component",
        None,
    )


def _failed_assertions(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield "an assertion of a function fails with the values of the parameters", None


def _nested_arrays(_: CompiledModel, __: re.Match[str]) -> Obstacles:
    yield (
        "an array parameter cannot give each element of an array of components an array of its own; "
        "write the values out, as in (x = {{1, 2}, {3, 4}})",
        None,
    )


def _loops_over_samples(model: CompiledModel, message: re.Match[str]) -> Obstacles:
    name, read = message.groups()
    yield (
        f"the when-clause that sets {name} reads {read}, which depends on {name} at the same instant; this "
        f"is not supported: where the value from before is meant, write pre({name})",
        model.flat["variables"].get(name, {}).get("source_span"),
    )


def _derivatives_at_events(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    """Find derivatives that are read at events: in when-clauses, relations and if-conditions."""
    at_events = [model.flat["when_chains"]]
    for equation in model.flat["equations"]:
        at_events += [one for one in expressions(equation, "Binary") if one["op"] in _RELATIONS]
        at_events += [branch[0] for one in expressions(equation, "If") for branch in one["branches"]]
    for call in _calls(at_events, "Der"):
        yield (
            f"{model.text(call['span'])} is not supported in a when-clause or a relation; "
            "introduce a variable that is equal to it",
            call["span"],
        )
        return


def _derivatives_at_end(model: CompiledModel, _: re.Match[str]) -> Obstacles:
    """Find derivatives of an element whose subscript is not a number."""
    for call in _calls(model.flat["equations"], "Der"):
        if any(expressions(call["args"], "BuiltinCall")):
            yield (
                f"{model.text(call['span'])} is not supported; write the number of the element",
                call["span"],
            )
            return


_FINDERS: tuple[tuple[str, Callable[[CompiledModel, re.Match[str]], Obstacles]], ...] = (
    ("", _strings),
    ("", _external_functions),
    ("depends on a runtime coordinate", _variable_attributes),
    ("checked recursion limit|recursive functions", _recursive_functions),
    ("pure-call argument or slot interface", _string_arguments),
    ("String values", _strings_in_equations),
    ("coupled discrete Real", _discrete_loops),
    ("clock activation owners|(?:non-clock event|different) activation", _partly_sampled_clauses),
    ("relations from different clock partitions", _mixed_samples),
    ("same-tick read of `([^`]+)`", _read_at_a_sample),
    ("runtime indexed slices", _listed_elements),
    ("matrix power", _matrix_powers),
    ("function assertion failed", _failed_assertions),
    ("structured B.1c body", _discrete_arrays_in_loops),
    (r"index (-?\d+) is outside an axis of extent (\d+)", _absent_elements),
    ("one subscript per array dimension", _nested_arrays),
    ("definition of `([^`]+)` reads `([^`]+)`, which is causally reachable", _loops_over_samples),
    ("derivative coordinate escaped", _derivatives_at_events),
    ("subscript is not compile-time computable", _derivatives_at_end),
    ("zero or non-finite affine coefficient", _vanishing_derivatives),
    ("missing state mapping for event reinitialization", _reinitialized_dependents),
    (r"structurally singular system: (\d+) matched out of (\d+) equations", _dependent_equations),
)
"""Patterns of rumoca's messages with their finders; Strings and external functions may cause any message."""


def _calls(tree: Any, function: str) -> Iterator[dict[str, Any]]:
    return (call for call in expressions(tree, "BuiltinCall") if call["function"] == function)
