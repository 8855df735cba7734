"""Names that rumoca looks up in the wrong class: those in base classes, and those of replaceable packages.

Modelica looks up a name where it is written: in the class that contains it, in the bases of that, and then in
the classes around. An inheriting class may declare an element with the name of a constant that its base finds
outside, as in ``package P constant Real k = 2; model B Real y; equation y = k; end B; end P;`` with
``model M extends P.B; parameter Real k = 3; end M;``. rumoca takes ``k`` for that element.

A class inside of another one may use a constant of a replaceable package of the latter, as ``Medium.c``.
rumoca takes the default for the package, or the same one in all components, even if some redeclare it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import Final

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.text import REDECLARE
from fmu_build.codegen.second_reading.arithmetic import UnknownError
from fmu_build.codegen.second_reading.givens import Scope
from fmu_build.codegen.second_reading.inlined import names_of_constants
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class, Tokens

_AFTER_VALUES: Final = frozenset(("and", "annotation", "else", "elseif", "for", "if", "loop", "or", "then"))


def captured_names(library: Library, instances: Instances) -> Iterator[tuple[str, Class]]:
    """Yield what names would mean, and the base classes in which they stand."""
    parts = (part.classes[0] for part in instances.parts.values())
    packages = (one for one in library.classes() if one.kind == "package")
    for derived in {id(one): one for one in (*parts, *packages)}.values():
        with suppress(UnknownError):
            yield from _captured(library, derived)


def uses_of_replaceable_packages(
    model: LoweredModel, library: Library, instances: Instances
) -> Iterator[tuple[str, Class]]:
    """Yield the constants of replaceable packages that inner classes use, and these classes."""
    used = [owner for part in instances.parts.values() for owner in part.classes]
    used += [one for owner in used for one in owner.classes.values() if one.kind == "package"]
    for function in model.flat["functions"].values():
        span = function["span"]
        with suppress(UnknownError, KeyError):
            used.append(library.class_at(span["source"], model.offset(span)))
    for inner in {id(one): one for one in used}.values():
        for name in _outer_packages(library, inner):
            if _uses(inner.tokens, name) and model.classes.find([rf"{REDECLARE}package\s+{name}\b"]):
                what = f"{inner.name} uses a constant of the replaceable package {name} around it"
                yield f"{what}, which a component redeclares", inner


def constants_of_heirs(library: Library, instances: Instances) -> Iterator[tuple[str, Class]]:
    """Yield constants that rumoca may take from another heir of their package without a trace.

    These are Booleans, of which only the branch that they decide is left, and constants of packages that a
    class redeclares as an element.
    """
    for path, part in instances.parts.items():
        for owner in part.classes:
            yield from _booleans(library, instances, Scope(path, owner))
    for owner in library.classes():
        yield from _of_redeclared_packages(library, owner)


def _booleans(library: Library, instances: Instances, scope: Scope) -> Iterator[tuple[str, Class]]:
    values = (one.modifier.value for one in scope.around.components)
    for tokens in (*_texts(scope.around), *values):
        for name in names_of_constants(tokens):
            with suppress(UnknownError):
                if not instances.means_member(name, scope):
                    package, last = instances.place_of_constant(name, scope)
                    if _is_shared(library, package, last, "Boolean"):
                        yield f"the Boolean {name}", scope.around


def _of_redeclared_packages(library: Library, owner: Class) -> Iterator[tuple[str, Class]]:
    for one in owner.classes.values():
        if one.kind == "package" and "redeclare" in one.prefixes and one.is_short:
            with suppress(UnknownError):
                heirs = {id(base) for base in library.lineage(library.base(one, one.bases[0][0]))}
                is_used = any(_uses(base.tokens, one.name) for base in library.bases(owner))
                if heirs & library.changed and is_used:
                    yield f"constants of {one.name}", owner


def _is_shared(library: Library, package: Class, name: str, kind: str) -> bool:
    """Return whether a constant of this type stands in a base of which heirs have other constants."""
    around, component = library.components(package).get(name, (package, None))
    return component is not None and component.type == kind and id(around) in library.changed


def _outer_packages(library: Library, inner: Class) -> Iterator[str]:
    """Yield the names of the replaceable packages of the classes around."""
    own, around = inner.classes, inner.around
    while around is not None:
        with suppress(UnknownError):
            classes = (one for base in library.lineage(around) for one in base.classes.values())
            packages = (one for one in classes if one.kind == "package" and "replaceable" in one.prefixes)
            yield from (one.name for one in packages if one.name not in own)
        around = around.around


def _uses(tokens: Tokens, package: str) -> bool:
    """Return whether a class uses a constant of a package, and not only its classes and functions."""
    for place in range(len(tokens) - 3):
        is_first = not place or tokens[place - 1] != "."
        if is_first and tokens[place : place + 2] == (package, "."):
            after = tokens[place + 3]
            is_class = after == "(" or (after.isidentifier() and after not in _AFTER_VALUES)
            if not is_class:
                return True
    return False


def _captured(library: Library, derived: Class) -> Iterator[tuple[str, Class]]:
    own = library.components(derived)
    for base in library.lineage(derived):
        further = own.keys() - library.components(base).keys()
        for tokens in _texts(base) if further else ():
            for name in sorted(_first_names(tokens)):
                if name in further:
                    where = f"{base.name}, which {derived.name} inherits"
                    yield f"{name} in {where}, would mean the {name} of {derived.name}", base


def _texts(owner: Class) -> Iterator[Tokens]:
    """Yield the expressions of which the values are not compared otherwise."""
    yield from (section.tokens for section in owner.sections)
    for component in owner.components:
        yield from component.dimensions
        yield component.condition
        value = component.modifier.value
        if owner.kind == "package" or "for" in value or ":" in value:
            yield value


def _first_names(tokens: Tokens) -> Iterable[str]:
    """Return the names with which references begin; not those of functions, arguments and iterators."""
    depth = 0
    found, iterators = set(), set()
    for before, token, after in zip(("", *tokens), tokens, (*tokens[1:], ""), strict=False):
        depth += (token in ("(", "[", "{")) - (token in (")", "]", "}"))
        if after == "in":
            iterators.add(token)
        is_argument = after == "=" and before in ("(", ",") and depth > 0
        if token.isidentifier() and before != "." and after != "(" and not is_argument:
            found.add(token)
    return found - iterators
