"""Modifiers that are invalid, and those that rumoca drops and `second_reading` does not see.

The latter are modifiers of records that a whole value replaces, those of the base of a function, and
arrays in modifiers that are counted wrongly; see also `record_values` and `comprehensions`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain

from fmu_build.codegen.comprehensions import miscounted_comprehensions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.inheritance import Inheritance, modified_classes
from fmu_build.codegen.modelica_source.modifiers import assigned, closing, dotted, repeated
from fmu_build.codegen.record_values import values_over_members

_KINDS = r"(?:model|block|record|type|package|class)"
_KEYWORD = (
    r"(?:algorithm|and|annotation|assert|connect|else|elseif|elsewhen|equation|for|if|in|initial|input|loop|not|or|"
    r"output|return|then|when|while)\b"
)
_COMPONENT = rf"(?<![\w.])(?!{_KEYWORD})[\w.]+\s+(?!{_KEYWORD})\w+\s*(?:\[[^\]]*\]\s*)?\("
_EXTENSION = r"\bextends\s+[\w.]+\s*\("
_SHORT_CLASS = rf"\b{_KINDS}\s+\w+\s*=\s*[\w.]+\s*\("


def reject_lost_modifiers(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first modifier in the model's classes that would be lost."""
    text = model.classes
    found = (
        _repeated_modifiers,
        _contradicted_bases,
        values_over_members,
        _modifiers_of_base_functions,
        miscounted_comprehensions,
    )
    for why, construct in chain.from_iterable(find(text) for find in found):
        raise model.unsupported_at(why, construct)
    for modified in text.find([f"{_COMPONENT}|{_EXTENSION}|{_SHORT_CLASS}"]):
        inside = modified.plain[modified.plain.index("(") + 1 : -1]
        for name in dotted(inside):
            nested = name.replace(".", "(") + " ..." + ")" * name.count(".")
            raise model.unsupported_at(f"the modifier of {name} is lost; write {nested}", modified)


def _repeated_modifiers(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield clauses that give one thing two values, which is invalid (Modelica 3.6, section 7.2)."""
    for _, modifiers, clause in modified_classes(text):
        for path in sorted(repeated(modifiers)):
            yield f"{'.'.join(path)} is given two values", clause


def _contradicted_bases(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield classes that inherit one base twice, with different values (Modelica 3.6, section 7.1)."""
    inheritance = Inheritance(text)
    for name, _, _ in text.named():
        simple = name.rpartition(".")[2]
        if len(text.of(simple)) > 1:
            continue
        for base, path in inheritance.contradictions(simple):
            if len(text.of(base)) == 1:
                what = f"{simple} inherits {base} twice, with different values of {'.'.join(path)}"
                yield from ((what, found) for found in text.headers(simple))


def _modifiers_of_base_functions(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield clauses by which functions with algorithms of their own modify inherited variables."""
    clauses = {
        "".join(own[found.start() : closing(own, found.end() - 1)].split())
        for _, kind, own in text.named()
        if kind.endswith("function") and re.search(r"\balgorithm\b", own)
        for found in re.finditer(_EXTENSION, own)
    }
    for clause in text.find([_EXTENSION]):
        given = assigned(clause.plain[clause.plain.index("(") + 1 : -1])
        if given and "".join(clause.plain.split()) in clauses:
            names = ", ".join(sorted(".".join(path) for path in given))
            yield (
                f"what the function gives to {names} of its base class is lost; write the function without "
                "the base class",
                clause,
            )
