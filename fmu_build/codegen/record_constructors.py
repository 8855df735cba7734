"""Records and functions that rumoca constructs and calls differently from Modelica.

Where a record inherits with modifiers, as ``record I = B(x = 3)``, the members of ``I()`` have the values of
B, unless the call is the whole value of a declaration. Modifiers of record variables of functions are lost.
Members that are final or constant count as arguments, although they are none (Modelica 3.6, section 12.6),
and inherited ones come first, even if the extends clause stands behind others (section 5.6.1).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from fmu_build.codegen.modelica_source.clauses import component_clauses
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.inheritance import Inheritance, extensions
from fmu_build.codegen.modelica_source.modifiers import assigned, closing, values

_NOT_A_CALL = re.compile(r"(?:\bextends\s+|\b(?:record|function)\s+\w+\s*=\s*)[\w.\s]*\Z")
_POSITIONAL = re.compile(r"\(\s*(?!\)|\w+\s*=(?!=))")
_KEPT = re.compile(r"\b(?:final|constant)\b[^;]*")


def mistaken_constructors(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield an explanation and the place of each record and function that would be taken for another."""
    inheritance = Inheritance(text)
    modified = _modified_records(text, inheritance)
    yield from _variables_of_functions(text, modified)
    for name in sorted(modified):
        if _has_other_calls(text, name):
            why = (
                f"{name}() would have the values of the record that {name} inherits, unless it is the whole "
                f"value of a component; declare a component {name} r and use r"
            )
            yield from ((why, found) for found in text.find([rf"\b{name}\s*\("]))
    for name, why in _with_other_arguments(text, inheritance):
        if any(_POSITIONAL.match(own, call) for own in text.classes() for call in _calls(own, name)):
            yield from ((why, found) for found in text.find([rf"\b(?:record|function)\s+{name}\b"]))


def _modified_records(text: ModelText, inheritance: Inheritance) -> set[str]:
    """Return the simple names of the records that inherit with modifiers, or from such a record."""
    found = {
        name.rpartition(".")[2]
        for name, kind, own in text.named()
        if kind.endswith("record") and any(assigned(modifiers) for _, modifiers in extensions(own))
    }
    return found | {name for name in text.records if inheritance.ancestry(name) & found}


def _variables_of_functions(text: ModelText, modified: set[str]) -> Iterator[tuple[str, Construct]]:
    """Yield the record variables of functions with modifiers, except for inputs of a modified class."""
    for name, kind, own in text.named():
        if not kind.endswith("function"):
            continue
        inputs = {one.name for one in component_clauses(";".join(re.findall(r"\binput\b[^;]*", own)))}
        for one in component_clauses(own):
            is_modified = one.type in modified and one.name not in inputs
            if one.type in text.records and (is_modified or assigned(one.modifiers)):
                why = (
                    f"the modifiers of the record {one.name} of the function {name.rpartition('.')[2]}, or "
                    "of its class, would be lost; assign its members in the algorithm"
                )
                yield from ((why, found) for found in text.find([rf"\b{one.type}\s+{one.name}\b"]))


def _has_other_calls(text: ModelText, name: str) -> bool:
    """Return whether a record is constructed elsewhere than as the whole value of a component."""
    for _, kind, own in text.named():
        calls = len(list(_calls(own, name)))
        if calls and (kind.endswith("function") or calls > sum(_is_call(one, name) for one in _values(own))):
            return True
    return False


def _values(plain: str) -> Iterator[str]:
    """Yield all values that the declarations and extends clauses of a class give."""
    for component in component_clauses(plain):
        yield component.value
        yield from values(component.modifiers).values()
    for _, modifiers in extensions(plain):
        yield from values(modifiers).values()


def _is_call(value: str, name: str) -> bool:
    found = re.match(rf"[\w.]*\b{name}\s*\(", value)
    return found is not None and not re.match(r"\s*[^\s\"]", value[closing(value, found.end() - 1) :])


def _calls(plain: str, name: str) -> Iterator[int]:
    """Yield the position of the opening parenthesis of each call."""
    for found in re.finditer(rf"(?<!\w){name}\s*\(", plain):
        if not _NOT_A_CALL.search(plain, 0, found.start()):
            yield found.end() - 1


def _with_other_arguments(text: ModelText, inheritance: Inheritance) -> Iterator[tuple[str, str]]:
    """Yield the records and functions whose positional arguments rumoca counts otherwise, and why."""
    kept = {name.rpartition(".")[2] for name, _, own in text.named() if _KEPT.search(own)}
    for name, kind, own in text.named():
        simple = name.rpartition(".")[2]
        if kind.endswith("record") and kept & inheritance.ancestry(simple):
            what = "its final and constant members would count too; name the arguments"
            yield simple, f"the arguments of {simple}(...): {what}"
        if kind.endswith(("record", "function")) and _inherits_late(own, inheritance):
            what = (
                "the inherited ones would come first, although others are declared before the extends "
                "clause; name the arguments, or write the extends clause first"
            )
            yield simple, f"the arguments of {simple}(...): {what}"


def _inherits_late(plain: str, inheritance: Inheritance) -> bool:
    """Return whether a class declares components before it inherits some."""
    for found in re.finditer(r"\bextends\b", plain):
        bases = {one for base, _ in extensions(plain[found.start() :]) for one in inheritance.ancestry(base)}
        if any(component_clauses(plain[: found.start()])) and any(map(inheritance.all_components, bases)):
            return True
    return False
