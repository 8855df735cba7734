"""Subscripts of members of arrays of components or records, as in ``parts.x[1]`` or ``parts[1:2].x[1]``.

Such a reference collects ``x[1]`` of all parts (Modelica 3.6, section 10.6.9). rumoca applies the subscript
to the parts instead and returns ``parts[1].x``.
"""

from __future__ import annotations

import re
from typing import Any

from fmu_build.codegen.compiled import CompiledModel, Span, expressions
from fmu_build.support.errors import UnsupportedModelError

_SUBSCRIPTS = re.compile(r"\s*\[\s*(?P<inside>[^\[\]]*(?:\[[^\[\]]*\][^\[\]]*)*)\]")
_REDUCTIONS = {"Sum", "Product", "Min", "Max"}
_COLONS = re.compile(r"[:,\s]*")
_PART = re.compile(r"\s*(?P<name>'(?:[^'\\]|\\.)*'|[A-Za-z_]\w*)\s*(?P<subscripts>\[[^\[\]]*\])?\s*(?:\.|$)")


def reject_member_slices(model: CompiledModel) -> None:
    """Raise `UnsupportedModelError` for the first reference whose subscripts would be misapplied."""
    for index in expressions(model.flat, "Index"):
        if (
            "base" in index
            and not _all_colons(index["subscripts"])
            and _is_member_of_slice(model, index["base"])
        ):
            raise _unsupported(model, index["span"])
    _reject_reductions_of_matrices(model)
    known: set[tuple[int, int, int]] = set()
    for reference in expressions(model.flat, "VarRef"):
        span, component = reference["span"], reference["name"]["component_ref"]
        if span is None or component is None or reference["subscripts"]:
            continue
        if not _is_in_array(component["parts"]):
            continue
        place = (span["source"], span["start"], span["end"])
        if place not in known and _has_lost_subscripts(model, span, component["parts"]):
            raise _unsupported(model, span)
        known.add(place)


def _reject_reductions_of_matrices(model: CompiledModel) -> None:
    """Reject ``sum(a.k)`` over a matrix of components, for which rumoca takes a single number, as 1."""
    for call in expressions(model.flat, "BuiltinCall"):
        if call["function"] in _REDUCTIONS and len(call["args"]) == 1 and "Literal" in call["args"][0]:
            raise model.unsupported(
                "a sum or the like over a matrix of components is not supported; write one with an iterator "
                "for each subscript",
                call["span"],
            )


def _is_in_array(parts: list[Any]) -> bool:
    """Return whether a reference passes through an element of an array."""
    return any(part["subs"] for part in parts[:-1]) and not parts[-1]["subs"]


def _is_member_of_slice(model: CompiledModel, base: Any) -> bool:
    """Return whether an expression selects a member, possibly nested, of several elements of an array."""
    while "FieldAccess" in base:
        base = base["FieldAccess"]["base"]
        if "Index" in base:
            if any(_takes_several(model, subscript) for subscript in base["Index"]["subscripts"]):
                return True
            base = base["Index"]["base"]
    return False


def _takes_several(model: CompiledModel, subscript: Any) -> bool:
    expression = subscript.get("Expr", {}).get("expr", {})
    name = expression.get("VarRef", {}).get("name", {}).get("name")
    is_array = (
        bool(model.flat["variables"].get(name, {}).get("dims")) and not expression["VarRef"]["subscripts"]
    )
    return "Colon" in subscript or "Range" in expression or "Array" in expression or is_array


def _all_colons(subscripts: list[Any]) -> bool:
    return all("Colon" in subscript for subscript in subscripts)


def _has_lost_subscripts(model: CompiledModel, span: Span, parts: list[Any]) -> bool:
    """Return whether the compiler has moved subscripts at the end of the reference to an earlier part of it.

    The span of a reference ends before its last subscripts. `parts` begins with the parts of the component
    that contains the source.
    """
    following = _SUBSCRIPTS.match(model.text({**span, "start": span["end"], "end": span["end"] + 200}))
    if following is None or _COLONS.fullmatch(following["inside"]):
        return False
    written = list(_PART.finditer(model.text(span)))
    if not 1 < len(written) <= len(parts):
        return False
    own = parts[-len(written) :]
    return [part["ident"] for part in own] == [part["name"] for part in written] and any(
        part["subs"] and not one["subscripts"] for part, one in zip(own[:-1], written, strict=False)
    )


def _unsupported(model: CompiledModel, span: Span | None) -> UnsupportedModelError:
    return model.unsupported(
        "a subscript of a member of an array of components or records would be applied to that array; "
        "write {a[i].b[1] for i in 1:n} for a.b[1]",
        span,
    )
