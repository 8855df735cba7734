"""Reject connections of elements in an order of their own.

rumoca connects the elements of ``a.y[{2, 1}]`` in the order of their declaration, as those of ``a.y[:]``, and
for ``a.y[:, 2]`` of a square matrix those of ``a.y[2, :]``.
"""

from __future__ import annotations

import re
from collections.abc import Container

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.clauses import component_clauses
from fmu_build.codegen.modelica_source.modifiers import closing

_CONNECT = r"\bconnect\s*\("
_CONNECTED_ELEMENTS = r"\bconnect\s*\([^;]*\["
#: Subscripts, with brackets inside of them.
_SUBSCRIPTS = re.compile(r"\[((?:[^\[\]]|\[[^\[\]]*\])*)\]")
#: Functions that give a number, and their calls with arguments that may be arrays.
#: A colon before an index.
_COLUMN = re.compile(r"(?:^|,)\s*:\s*,(?!\s*:\s*$)")
_TO_NUMBERS = {"abs", "div", "integer", "max", "min", "mod", "ndims", "product", "rem", "size", "sum"}
_OF_ARRAYS = re.compile(r"\b(?:max|min|ndims|product|size|sum)\s*\([^()]*\)")
_WHY = "because elements would be connected in the order of their declaration; connect them one by one"
_ARRAY_TYPE = re.compile(r"=\s*[\w.]+\s*\[")
_ITERATOR = re.compile(r"(?:\bfor|,)\s+(\w+)\s+in\b")


def reject_reordered_connections(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first connection with an array or a function as a subscript."""
    text = model.classes
    if not text.find([_CONNECTED_ELEMENTS]):
        return
    types = {
        name.rpartition(".")[2]
        for name, kind, own in text.named()
        if kind == "type" and _ARRAY_TYPE.search(own)
    }
    # Constants of a package may stand in subscripts without its name.
    arrays, _ = _declared("; ".join(model.classes_around.classes()), types)
    for _, _, own in text.named():
        own_arrays, own_others = _declared(own, types)
        known = own_arrays | (arrays - own_others - set(_ITERATOR.findall(own)))
        for found in re.finditer(_CONNECT, own):
            call = " ".join(own[found.start() : closing(own, found.end() - 1)].split())
            for subscripts in _SUBSCRIPTS.findall(call):
                if (what := _fault(subscripts, known)) is not None:
                    places = [one for one in text.find([_CONNECT]) if one.plain == call]
                    raise model.unsupported_at(f"{what} in connect() is not supported, {_WHY}", places[0])


def _fault(subscripts: str, arrays: Container[str]) -> str | None:
    """Return what rumoca would connect in another order, if anything."""
    if _COLUMN.search(subscripts):
        return "a column of a matrix"
    return "a vector as a subscript" if _is_vector(subscripts, arrays) else None


def _declared(plain: str, types: Container[str]) -> tuple[set[str], set[str]]:
    """Return the names that a text declares as arrays of Integers or of such types, and as anything else."""
    arrays: set[str] = set()
    others: set[str] = set()
    for one in component_clauses(plain):
        is_array = (one.is_array and one.type == "Integer") or one.type in types
        (arrays if is_array else others).add(one.name)
    return arrays, others


def _is_vector(subscripts: str, arrays: Container[str]) -> bool:
    """Return whether one of the subscripts lists several elements otherwise than by a range."""
    plain = _OF_ARRAYS.sub("0", subscripts)
    if "{" in plain or not _TO_NUMBERS.issuperset(re.findall(r"\b([A-Za-z_]\w*)\s*\(", plain)):
        return True
    names = re.findall(r"(?:\w+\s*\.\s*)*([A-Za-z_]\w*)\b(?!\s*(?:[\[(]|\.\s*\w))", plain)
    return any(name in arrays for name in names)
