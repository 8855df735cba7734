"""Invalid elements of classes: modifiers of what does not exist, and differing declarations of one name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from contextlib import suppress

from fmu_build.codegen.second_reading.givens import Given, Mistake, joined
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class, Component


def unknown_names(
    library: Library, path: str, owner: Class, given: Mapping[str, Given], members: Set[str]
) -> Iterator[Mistake]:
    """Yield what a component of a class is given that has no such element."""
    with suppress(UnknownError):
        for name in sorted(given.keys() - members):
            if not _has_class(library, owner, name):
                yield f"{owner.name} has no element {name}, which {path} is given", name


def _has_class(library: Library, owner: Class, name: str) -> bool:
    return name in owner.classes or any(_has_class(library, base, name) for base in library.bases(owner))


def repeated_components(path: str, components: Iterable[tuple[Component, Class]]) -> Iterator[Mistake]:
    """Yield components, each given with its class, that two classes declare differently."""
    first: dict[str, tuple[Component, Class]] = {}
    for component, around in components:
        other, other_around = first.setdefault(component.name, (component, around))
        if other.modifier != component.modifier and around is not other_around:
            name = joined(path, component.name)
            what = f"{name} is declared in {other_around.name} and in {around.name}, differently"
            yield what, component.name


def repeated_classes(library: Library, owner: Class) -> Iterator[Mistake]:
    """Yield classes of one name that a class declares or inherits, and that differ."""
    first: dict[str, Class] = {}
    with suppress(UnknownError):
        for around in library.lineage(owner):
            for name, one in around.classes.items():
                other = first.setdefault(name, one)
                if other.tokens != one.tokens and "redeclare" not in other.prefixes:
                    what = f"{owner.name} has two classes {name} that differ: one of {around.name}, which"
                    yield f"{what} it inherits", name
