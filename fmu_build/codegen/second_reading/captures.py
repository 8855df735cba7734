"""Names in a base class that rumoca takes for elements of a class that inherits it.

Modelica looks up a name where it is written: in the class that contains it, in the bases of that, and then in
the classes around. An inheriting class may declare an element with the name of a constant that its base finds
outside, as in ``package P constant Real k = 2; model B Real y; equation y = k; end B; end P;`` with
``model M extends P.B; parameter Real k = 3; end M;``. rumoca takes ``k`` for that element.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress

from fmu_build.codegen.second_reading.arithmetic import UnknownError
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class, Tokens


def captured_names(library: Library, instances: Instances) -> Iterator[tuple[str, Class]]:
    """Yield what names would mean, and the base classes in which they stand."""
    parts = (part.classes[0] for part in instances.parts.values())
    packages = (one for one in library.classes() if one.kind == "package")
    for derived in {id(one): one for one in (*parts, *packages)}.values():
        with suppress(UnknownError):
            yield from _captured(library, derived)


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
