"""Reject models that rumoca silently lowers wrongly; the error names the construct and its line."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from fmu_build.codegen.compiled import Span
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.modelica_source.constructs import Construct, ModelText
from fmu_build.modelica_source.places import located
from fmu_build.support.errors import UnsupportedModelError


def reject_unsupported(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first construct that would be translated wrongly."""
    _reject_operators(model)
    _reject_dynamic_state_selection(model)
    _reject_surplus_initial_equations(model)
    _reject_undetermined_parameters(model)
    _reject_repeated_assignments(model)
    _reject_lost_modifiers(model)


def _reject_operators(model: LoweredModel) -> None:
    temporal = model.dae["systems"]["temporal"]
    for kind in ("delay", "terminal"):
        for call in temporal[f"{kind}s"]:
            raise model.unsupported(f"{kind}() is not supported", call["provenance"]["span"])


def _reject_dynamic_state_selection(model: LoweredModel) -> None:
    names = model.solve["solve_layout"]["solver_maps"]["names"]
    chosen = any(name.startswith("$state_coordinates") for name in names)
    if chosen or model.solve["initialization"]["manifold_row_count"]:
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
    determined = {slot["P"]["index"] for slot in slots if "P" in slot}
    bindings = model.solve["layout"]["bindings"]
    for entry in model.dae["variables"]:
        attributes = entry["attributes"]
        if attributes["fixed"] is not False or attributes["binding"] is not None:
            continue
        for name in entry["scalar_names"]:
            slot = bindings.get(name, {})
            if entry["role"] == "parameter" and "P" in slot and slot["P"]["index"] not in determined:
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


_KINDS = r"(?:model|block|record|type|package|class)"
_REDECLARED_CLASS = (
    rf"(?<=[(,])\s*\bredeclare\s+(?:replaceable\s+)?{_KINDS}\s+\w+\s*=\s*[\w.]+\s*\(",
    "the modifiers of a class that is redeclared inside a modifier are lost; "
    "give the class with its modifiers a name of its own",
)
_CONSTRAINING_CLASS = (
    r"\bconstrainedby\s+[\w.]+\s*\(",
    "the modifiers of a constraining class are lost; put them on the component",
)
_EXTENSION = r"\bextends\s+[\w.]+\s*\("
_REDECLARED_COMPONENT = re.compile(rf"\bredeclare\s+(?:replaceable\s+)?(?!{_KINDS}\b)[\w.]+\s+(\w+)")


def _reject_lost_modifiers(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first modifier in the model's classes that would be lost."""
    texts = {Path(path): content for _, path, content in model.source_files}
    text = ModelText(model.name, texts, around=False)
    for pattern, why in (_REDECLARED_CLASS, _CONSTRAINING_CLASS):
        for construct in text.find([pattern]):
            raise _rejection(model, why, construct)
    for extension in text.find([_EXTENSION]):
        base = re.split(r"[\s(]+", extension.text)[1].rpartition(".")[2]
        for component in _REDECLARED_COMPONENT.findall(extension.text):
            if text.mentions(base, rf"\breplaceable\b[^;]*\b{component}\b") is False:
                why = (
                    f"the redeclaration of {component} is lost, because {base} inherits it; "
                    "extend the class that declares it"
                )
                raise _rejection(model, why, extension)


def _rejection(model: LoweredModel, why: str, construct: Construct) -> UnsupportedModelError:
    return UnsupportedModelError(located(why, [construct.place], model.name, construct.place.file))
