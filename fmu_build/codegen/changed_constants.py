"""Constants and functions of packages to which rumoca gives the values of others.

After ``package B extends A(c = 7)``, rumoca takes 7 for ``A.c`` too wherever the model uses both packages,
and the functions that B redeclares for those of A. Components are not affected, only names like ``A.c``:
those of the class from which B inherits, not those of its other heirs.

Of the values that the heirs of a package give to one of its constants, rumoca takes one wherever the package
itself uses the constant, in another constant or in a model, record or type. Where an heir of an heir gives
another value, it takes the former one for everything.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.modifiers import assigned, closing

_KIND = r"(?:model|block|class|package|connector|record|function)"
_EXTENSION = r"\bextends\s+[\w.]+\s*\("
_PLAIN_EXTENSION = r"\bextends\s+[\w.]+\s*(?=;)"
_SHORT_CLASS = r"\bpackage\s+\w+\s*=\s*[\w.]+\s*\("
_BASE = re.compile(r"(?:\bextends\s+|=\s*)(?:\w+\s*\.\s*)*(?P<name>\w+)")


def changed_constants(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield an explanation and the clause for each class that is used together with a modified heir."""
    for clause in _changing_clauses(text):
        found = _BASE.search(clause.plain)
        assert found is not None  # by the patterns
        base = found["name"]
        if is_named(text, base):
            yield (
                f"the model uses {base} beside a class that extends it with other constants or functions, "
                f"and {base} would get these too; give both a common base class, which is partial",
                clause,
            )


def _changing_clauses(text: ModelText) -> Iterator[Construct]:
    """Yield the extends-clauses with modifiers, and those of packages that redeclare inherited elements."""
    yield from text.find([_SHORT_CLASS])
    for clause in text.find([_EXTENSION]):
        arguments = clause.plain[clause.plain.index("(") + 1 : -1]
        if arguments.strip() and not _sets_parameters_only(text, clause, arguments):
            yield clause
    redeclaring = {
        re.sub(r"\s+", "", found[0])
        for own in text.classes()
        if _redeclares(own)
        for found in re.finditer(_PLAIN_EXTENSION, own)
    }
    for clause in text.find([_PLAIN_EXTENSION]):
        if re.sub(r"\s+", "", clause.plain) in redeclaring:
            yield clause


def _sets_parameters_only(text: ModelText, clause: Construct, arguments: str) -> bool:
    """Return whether the clause only sets parameters, which no name like ``A.c`` can mean."""
    base = _BASE.search(clause.plain)
    names = {path[0] for path in assigned(arguments)}
    if base is None or not names or "redeclare" in arguments:
        return False
    declared = [rf"\bparameter\s[^;]*(?<![\w.]){re.escape(name)}\b" for name in names]
    return all(any(re.search(one, own) for own in text.of(base["name"])) for one in declared)


def _redeclares(own: str) -> bool:
    """Return whether a package redeclares elements that it inherits, outside of modifiers."""
    without = own
    while (opening := without.find("(")) >= 0:
        without = without[:opening] + without[closing(without, opening) :]
    return re.match(r"\s*package\b", own) is not None and re.search(r"\bredeclare\b", without) is not None


def is_named(text: ModelText, base: str) -> bool:
    """Return whether the model uses names of the class other than by inheritance.

    A package counts as used wherever its name occurs, because the name may be an alias; any other class,
    where an element of it is named. A partial package cannot be used.
    """
    kinds = text.kinds_of(base)
    if kinds == {"partial package"}:
        return False
    use = rf"(?<!\w){base}(?!\w)" if any("package" in kind for kind in kinds) else rf"(?<!\w){base}\s*\.\s*\w"
    return any(
        not _is_inheritance(own[: found.start()], own[found.end() :])
        for own in text.classes()
        for found in re.finditer(use, own)
    )


def _is_inheritance(before: str, after: str) -> bool:
    """Return whether a name, given the text before and after it, is a base class or is being declared."""
    scope = r"(?:\w+\s*\.\s*)*$"
    if re.search(rf"\b(?:extends|constrainedby|end|{_KIND})\s+{scope}", before):
        return True
    return re.search(rf"\bpackage\s+\w+\s*=\s*{scope}", before) is not None and after.lstrip().startswith("(")
