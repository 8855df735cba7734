"""Constants of packages to which derived packages give several values, of which rumoca uses only one.

If a package gives a value to a constant and a derived package gives it another one, the latter is lost. If
two derived packages give different values, each has its own value, but not what depends on the constant:
rumoca evaluates the other constants of the base package, and its models, records and types, for only one
derived package. References by the full name of a package, ``P.c`` or ``P.f(x)``, are correct.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from fmu_build.codegen.changed_constants import is_named
from fmu_build.codegen.modelica_source.clauses import EXTENSION_CLAUSE, component_clauses
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.inheritance import Inheritance, extensions
from fmu_build.codegen.modelica_source.modifiers import values

_CONSTANTS = re.compile(r"\bconstant\b[^;]*")
_ALIAS = r"\bpackage\s+\w+\s*=\s*(?:\w+\s*\.\s*)*"
_DECLARED = re.compile(r"\b(?:model|block|record|type|package|class|function)\s+(?:extends\s+)?(\w+)")
_REDECLARED = r"\bredeclare\s+(?:replaceable\s+)?(?:final\s+)?constant\b[^;]*"

Given = dict[str, str]
"""Values that modifiers give to constants, by name."""


def contradicted_constants(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield errors in the values of constants that packages inherit, with the clauses that give them."""
    packages = {name.rpartition(".")[2] for name, kind, _ in text.named() if kind.endswith("package")}
    for clause in _redeclared(text):
        yield (
            "a constant that a package redeclares keeps its former value; give it in the extends clause",
            clause,
        )
    clauses = [
        (found["base"], _given(clause.plain[found.end() + 1 : -1]), clause)
        for clause in text.find([rf"{EXTENSION_CLAUSE}\("])
        if (found := re.match(EXTENSION_CLAUSE, clause.plain)) is not None and found["base"] in packages
    ]
    if not any(given for _, given, _ in clauses):
        return
    inheritance = Inheritance(text)
    for base, given, clause in clauses:
        for name in _given_again(inheritance, base, given):
            yield (
                f"{base}, or a class that it extends, gives {name} another value, which would prevail; "
                "extend the class that declares it",
                clause,
            )
    heirs = _heirs(text, inheritance)
    for base in sorted(packages):
        of_this = {heir: given[base] for heir, given in heirs.items() if base in given}
        for name in sorted({name for given in of_this.values() for name in given}):
            several = any(
                _differ(given.get(name), other.get(name))
                for given in of_this.values()
                for other in of_this.values()
            )
            if several and _is_mixed_up(text, base, name, of_this):
                names = ", ".join(sorted({one.rpartition(".")[2] for one in of_this}))
                yield (
                    f"{names} have different values of {name}, but what depends on it in {base} would be the "
                    "same for all; declare it in each of them",
                    next(clause for _, given, clause in reversed(clauses) if name in given),
                )


def _redeclared(text: ModelText) -> Iterator[Construct]:
    """Yield the clauses in which packages redeclare constants as elements of their own."""
    of_packages = {
        "".join(found.split())
        for _, kind, own in text.named()
        if kind.endswith("package")
        for found in re.findall(_REDECLARED, own)
    }
    for clause in text.find([_REDECLARED]):
        if "".join(clause.plain.split()) in of_packages:
            yield clause


def _given(modifiers: str) -> Given:
    return {path[0]: value for path, value in values(modifiers).items() if len(path) == 1}


def _differ(one: str | None, other: str | None) -> bool:
    """Return whether two values differ; None is the declared value; blanked strings count as equal."""
    first, second = ("".join(value.split()) if value is not None else None for value in (one, other))
    return first != second and "" not in (first, second)


def _given_again(inheritance: Inheritance, base: str, given: Given) -> Iterator[str]:
    """Yield the names to which a base class, or one that it extends, gives another value than `given`."""
    for ancestor in sorted(inheritance.ancestry(base)):
        for _, modifiers in inheritance.bases[ancestor]:
            before = _given(modifiers)
            yield from sorted(name for name in given.keys() & before if _differ(given[name], before[name]))


def _heirs(text: ModelText, inheritance: Inheritance) -> dict[str, dict[str, Given]]:
    """Return the values that each package used by the model gives to its base classes, by qualified name.

    Aliases of packages, ``package P = Q``, are left out.
    """
    model = next(text.named())[0]
    return {
        name: _given_to_bases(inheritance, extensions(own), frozenset())
        for name, kind, own in text.named()
        if kind.endswith("package") and not re.match(rf"{_ALIAS}\w+\b(?!\s*\()", own)
        if f"{model}.".startswith(f"{name}.") or is_named(text, name.rpartition(".")[2])
    }


def _given_to_bases(
    inheritance: Inheritance, bases: Iterable[tuple[str, str]], seen: frozenset[str]
) -> dict[str, Given]:
    given: dict[str, Given] = {}
    for base, modifiers in bases:
        if base in seen:
            continue
        own = _given(modifiers)
        given.setdefault(base, {}).update(own)
        further = _given_to_bases(inheritance, inheritance.bases[base], seen | {base})
        for ancestor, before in further.items():
            given.setdefault(ancestor, {}).update({**before, **own})
    return given


def _is_mixed_up(text: ModelText, base: str, name: str, heirs: Iterable[str]) -> bool:
    """Return whether the model uses what depends on a constant of the base package, except by full names."""
    dependent = _dependent(text, base, name)
    inside = [one for one in text.named() if base in one[0].split(".")[:-1]]
    functions = {scope.rpartition(".")[2]: own for scope, kind, own in inside if kind.endswith("function")}
    blind = {name, *dependent}
    while found := {one for one, own in functions.items() if one not in blind and _mentions(own, blind)}:
        blind |= found
    if any(_mentions(own, blind) for _, kind, own in inside if not kind.endswith("function")):
        return True
    if any(_mentions(own, blind - {name}) for own in _inside_of(text, heirs)):
        return True
    return bool(dependent) and any(_has_another_name(text, heir) for heir in heirs)


def _dependent(text: ModelText, base: str, name: str) -> set[str]:
    """Return the names of the constants of a package whose values depend on the constant `name`."""
    clauses = [
        ({one.name for one in component_clauses(found[0])}, set(re.findall(r"\w+", found[0])))
        for own in text.of(base)
        for found in _CONSTANTS.finditer(own)
    ]
    dependent, known = set[str](), -1
    while known != len(dependent):
        known = len(dependent)
        for names, words in clauses:
            if (words - names) & {name, *dependent}:
                dependent |= names
    return dependent


def _mentions(own: str, names: set[str]) -> bool:
    """Return whether a class uses one of these names without declaring it."""
    used = names - {one.name for one in component_clauses(own)} - set(_DECLARED.findall(own))
    return any(re.search(rf"(?<![\w.]){re.escape(one)}\b(?!\s*=(?!=))", own) for one in used)


def _inside_of(text: ModelText, packages: Iterable[str]) -> Iterator[str]:
    """Yield the texts of these packages and of all classes inside them."""
    return (own for name, _, own in text.named() if any(f"{name}.".startswith(f"{one}.") for one in packages))


def _has_another_name(text: ModelText, package: str) -> bool:
    """Return whether a package is declared in a model, or has an alias outside of modifiers."""
    scope, _, simple = package.rpartition(".")
    classes = {name: (kind, own) for name, kind, own in text.named()}
    if classes.get(scope, ("", ""))[0].endswith(("model", "block", "class")):
        return True
    alias = re.compile(rf"{_ALIAS}{simple}\b")
    # The text of a class does not include its inner classes, but those in modifiers.
    return any(
        alias.match(own) and not alias.search(classes.get(name.rpartition(".")[0], ("", ""))[1])
        for name, (_, own) in classes.items()
    )
