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
from fmu_build.codegen.second_reading.givens import Scope, Text, joined, nowhere
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import ChangedError, UnknownError
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class, Component, Tokens

_DEEPEST: Final = 20
_AFTER_VALUES: Final = frozenset(("and", "annotation", "else", "elseif", "for", "if", "loop", "or", "then"))


def captured_names(instances: Variables, texts: Iterable[Text]) -> Iterator[tuple[str, Class]]:
    """Yield what names in texts would mean, and the base classes in which they stand."""
    for text in texts:
        part = instances.parts.get(text.scope.path)
        if part is not None:
            yield from _captured(instances.library, part.classes[0], text.scope.around, [text.tokens])


def captured_in_packages(library: Library) -> Iterator[tuple[str, Class]]:
    """Yield the same for names in the declarations of packages."""
    for derived in library.classes():
        if derived.kind == "package":
            with suppress(UnknownError):
                for base in library.lineage(derived):
                    for component in base.components:
                        texts = (*component.dimensions, component.condition, component.modifier.value)
                        yield from _captured(library, derived, base, texts)


def unknown_declarations(instances: Variables) -> Iterator[Text]:
    """Yield the sizes and conditions of components of which nothing is known."""
    for scope, component in _unknown_components(instances):
        for tokens in (*component.dimensions, component.condition):
            yield Text(scope, tokens)


def unknown_components(instances: Variables) -> Iterator[Text]:
    """Yield the names of these components; those of outer ones mean others, no value needs a StateSelect."""
    for scope, component in _unknown_components(instances):
        if "outer" not in component.prefixes and component.type != "StateSelect":
            yield Text(scope, (component.name,))


def _unknown_components(instances: Variables) -> Iterator[tuple[Scope, Component]]:
    for path, part in instances.parts.items():
        for owner in part.classes:
            for component in owner.components:
                name = joined(path, component.name)
                if name not in instances.sizes and name not in instances.absent:
                    yield Scope(path, owner), component


def uses_of_replaceable_packages(
    model: LoweredModel, library: Library, instances: Variables, unknown: Iterable[Text]
) -> Iterator[tuple[str, Class]]:
    """Yield the constants of replaceable packages that inner classes use, and these classes."""
    used = [(text.scope.around, text.tokens) for text in unknown]
    owners = {id(owner): owner for part in instances.parts.values() for owner in part.classes}
    for owner in owners.values():
        used += [(one, one.tokens) for one in owner.classes.values() if one.kind == "package"]
    for inner, tokens in used:
        for name in _outer_packages(library, inner):
            if _uses(tokens, name) and model.classes.find([rf"{REDECLARE}package\s+{name}\b"]):
                what = f"{inner.name} uses a constant of the replaceable package {name} around it"
                yield f"{what}, which a component redeclares", inner


def constants_of_heirs(
    library: Library, instances: Variables, unknown: Iterable[Text]
) -> Iterator[tuple[str, Class]]:
    """Yield constants in unknown texts that rumoca may take from another heir of their package."""
    for text in unknown:
        for name in _names_of_constants(text.tokens):
            if _is_of_heirs(library, instances, name, text.scope, 0):
                yield f"the constant {name}", text.scope.around


def _is_of_heirs(library: Library, instances: Variables, name: str, scope: Scope, depth: int) -> bool:
    """Return whether a constant, or one that its value needs, stands in a package whose heirs have others."""
    try:
        if instances.means_member(name, scope):
            return False
        package, last = instances.lookup.constant(name, scope)
        around, component = library.components(package)[last]
    except ChangedError:
        return True
    except (KeyError, UnknownError):
        return False
    if "constant" not in component.prefixes:
        return False
    if id(around) in library.changed or depth > _DEEPEST:
        return True
    inner = _names_of_constants(component.modifier.value)
    return any(_is_of_heirs(library, instances, one, nowhere(around), depth + 1) for one in inner)


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
    for place in range(len(tokens) - 2):
        is_first = not place or tokens[place - 1] != "."
        if is_first and tokens[place : place + 2] == (package, "."):
            after = tokens[place + 3] if place + 3 < len(tokens) else ""
            is_class = after == "(" or (after.isidentifier() and after not in _AFTER_VALUES)
            if not is_class:
                return True
    return False


def _captured(
    library: Library, derived: Class, base: Class, texts: Iterable[Tokens]
) -> Iterator[tuple[str, Class]]:
    with suppress(UnknownError):
        further = library.components(derived).keys() - library.components(base).keys()
        for tokens in texts if further else ():
            for name in sorted(_first_names(tokens)):
                if name in further:
                    where = f"{base.name}, which {derived.name} inherits"
                    yield f"{name} in {where}, would mean the {name} of {derived.name}", base


def _names_of_constants(tokens: Tokens) -> Iterator[str]:
    """Yield the qualified names in an expression, but not those of functions."""
    name = ""
    for token, after in zip(tokens, (*tokens[1:], ""), strict=False):
        if token == "." or (token.isidentifier() and (not name or name.endswith("."))):
            name += token
        if name and after != "." and not name.endswith("."):
            if after not in ("(", "="):
                yield name
            name = ""


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
