"""Compare the functions and the constants of packages that rumoca finds with those that names mean.

A name of a function is looked up in the classes around it, as a constant of a package is (Modelica 3.6,
section 5.3); rumoca writes the value of the latter in the place of the name.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any, Final

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.givens import nowhere
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError, Value
from fmu_build.codegen.second_reading.scopes import PREDEFINED, Library
from fmu_build.codegen.second_reading.syntax import Class

_TREES: Final = ("initial_equations", "when_chains", "algorithms", "initial_algorithms")
NAME: Final = re.compile(r"\.?[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*")
_ROUNDING: Final = 1e-9


def mistaken_packages(
    model: LoweredModel, library: Library, instances: Variables
) -> Iterator[tuple[str, Span]]:
    """Yield functions, constants and variables that are not what their names mean, and where these stand."""
    bindings = [one.get("binding") for one in model.flat["variables"].values()]
    # Connections have the places of declarations.
    equations = [one for one in model.flat["equations"] if "ComponentEquation" in one["origin"]]
    for tree in (equations, *(model.flat[name] for name in _TREES), bindings, model.flat["functions"]):
        for call in expressions(tree, "FunctionCall"):
            yield from _call(model, library, call)
        for literal in expressions(tree, "Literal"):
            yield from _literal(model, library, literal, instances)
        for reference in expressions(tree, "VarRef"):
            is_local = tree is model.flat["functions"]
            yield from _captured(model, library, reference, None if is_local else instances)


def _captured(
    model: LoweredModel,
    library: Library,
    reference: dict[str, Any],
    instances: Variables | None,
) -> Iterator[tuple[str, Span]]:
    """Yield a name that means nothing in its class, but a component of the model, or a local of a function.

    Modelica looks it up in the classes around its own, rumoca in the model or function that uses the class.
    """
    span, found = reference["span"], reference["name"]["name"]
    text = model.text(span) if span["source"] in model.sources else ""
    first = NAME.match(text)
    is_call = first is not None and text[first.end() :].lstrip().startswith("(")  # as inStream()
    if first is None or is_call or found in model.flat["enum_literal_ordinals"]:
        return
    name, head = first[0].partition(".")[0], re.split(r"[.\[]", found)[0]
    is_component = "." not in found if instances is None else head in instances.members("")
    with suppress(UnknownError):
        around = _around(model, library, span)
        while around.is_short and around.around is not None:
            around = around.around
        is_captured = is_component and name not in library.components(around) and name != "time"
        if is_captured and not is_iterator(model, around, name):
            whose = "the function that extends it" if instances is None else "the model"
            yield f"{name}, which {around.name} does not declare, means the {found} of {whose}", span


def _call(model: LoweredModel, library: Library, call: dict[str, Any]) -> Iterator[tuple[str, Span]]:
    span, called = call["span"], call.get("name", {}).get("name")  # not of a call that is a statement
    written = NAME.match(model.text(span)) if span["source"] in model.sources else None
    if written is not None and called is not None:
        with suppress(UnknownError):
            meant = _plain(library, library.meaning(written[0], _around(model, library, span)))
            found = model.flat["functions"].get(called)
            if meant.kind == "function" and found is not None:
                other = _plain(library, _around(model, library, found["span"]))
                if other.kind == "function" and other is not meant:
                    yield f"{written[0]} means {other.qualified} instead of {meant.qualified}", span


def _plain(library: Library, found: Class) -> Class:
    """Return the class for which a short class stands."""
    while found.is_short and found not in PREDEFINED.values():
        ((name, modifier),) = found.bases
        if modifier.inner:
            raise UnknownError
        found = library.base(found, name)
    return found


def is_iterator(model: LoweredModel, around: Class, name: str) -> bool:
    """Return whether a name may be that of an iterator somewhere in a class."""
    text = model.sources[around.file][1][around.start : around.end]
    return re.search(rf"(?:\bfor|,)\s*{name}\s+in\b", text) is not None


def is_one_of(value: float, meant: Value) -> bool:
    """Return whether a number is a value, or in an array of values."""
    return any(math.isclose(one, value, rel_tol=_ROUNDING) for one in meant.flat)


def _literal(
    model: LoweredModel,
    library: Library,
    literal: dict[str, Any],
    instances: Variables,
) -> Iterator[tuple[str, Span]]:
    span, value = literal["span"], next(iter(literal["value"].values()))
    if isinstance(value, str) or span["source"] not in model.sources:
        return
    written = model.text(span)
    if NAME.fullmatch(written) and written not in ("true", "false"):
        with suppress(UnknownError):
            around = _around(model, library, span)
            meant = instances.of_constant([(name, ()) for name in written.split(".")], nowhere(around))
            if not is_one_of(value, meant) and not is_iterator(model, around, written):
                yield f"{written} is not {value:g}", span


def _around(model: LoweredModel, library: Library, span: Span) -> Class:
    if span["source"] not in model.sources:
        raise UnknownError
    return library.class_at(span["source"], model.offset(span))
