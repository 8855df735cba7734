"""The classes of a model's libraries by name, and the class that a name means where it stands."""

from __future__ import annotations

import bisect
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Set
from contextlib import suppress
from functools import cached_property
from typing import Final

from fmu_build.codegen.second_reading.operations import ChangedError, UnknownError
from fmu_build.codegen.second_reading.syntax import Class, Component, Modifier, read_classes

PREDEFINED: Final = {
    name: Class(name, "type", None) for name in ("Real", "Integer", "Boolean", "String", "Clock")
}


class NotFoundError(UnknownError):
    """No class has the name."""


class Library:
    """All classes of some source texts; `unread` says why the files with these numbers cannot be read."""

    def __init__(self, texts: Mapping[int, str]) -> None:
        """Read the classes in texts, given by the numbers of their files."""
        self.unread: dict[int, str] = {}
        self._root = Class("", "package", None)
        found: list[tuple[str, Class]] = []
        for number, text in texts.items():
            try:
                found += read_classes(text, number)
            except SyntaxError as error:
                self.unread[number] = str(error)
        for within, one in sorted(found, key=lambda pair: pair[0].count(".") + bool(pair[0])):
            around = self._root
            for part in filter(None, within.split(".")):
                around = around.classes.setdefault(part, Class(part, "package", around, is_certain=False))
            one.around = around
            around.classes[one.name] = one
        self._short: dict[tuple[int, str], Class] = {}
        self._components: dict[int, Mapping[str, tuple[Class, Component]]] = {}

    def class_of(self, qualified: str) -> Class:
        """Return the class with a qualified name; raises `UnknownError` if there is none."""
        found = self._root
        for part in qualified.split("."):
            if part not in found.classes:
                raise UnknownError
            found = found.classes[part]
        return found

    def classes(self) -> Iterator[Class]:
        """Yield all classes."""
        inner = [*self._root.classes.values()]
        while inner:
            found = inner.pop()
            yield found
            inner += found.classes.values()

    def class_at(self, file: int, offset: int) -> Class:
        """Return the innermost class around an offset into a file; raises `UnknownError` if there is none."""
        starts, classes = self._places.get(file, ([], []))
        place = bisect.bisect_right(starts, offset) - 1
        found = classes[place] if place >= 0 else None
        while found is not None and not found.start <= offset < found.end:
            found = found.around
        if found is None:
            raise UnknownError
        return found

    @cached_property
    def _places(self) -> Mapping[int, tuple[list[int], list[Class]]]:
        """The classes of each file in the order in which they begin, with their offsets."""
        found = defaultdict(list)
        for one in self.classes():
            found[one.file].append(one)
        for classes in found.values():
            classes.sort(key=lambda one: one.start)
        return {file: ([one.start for one in classes], classes) for file, classes in found.items()}

    def meaning(self, name: str, scope: Class) -> Class:
        """Return the class that a name means in a class.

        Raises:
            UnknownError: it is not known, or a redeclaration may replace it
        """
        if name in PREDEFINED:
            return PREDEFINED[name]
        if name.startswith("."):
            return self.class_of(name[1:])
        first, *rest = name.split(".")
        return self.within(self._first(first, scope), rest)

    def default(self, name: str, scope: Class) -> Class:
        """Return the class that a name means in a class if nothing is redeclared.

        Raises `UnknownError` if it is not known.
        """
        first, *rest = name.split(".")
        around: Class | None = scope
        while around is not None:
            found = self.declaration(around, first)
            if found is not None:
                for part in rest:
                    found = self.declaration(found, part)
                    if found is None:
                        raise UnknownError
                return found
            around = around.around
        return self.meaning(name, scope)

    def _first(self, name: str, scope: Class, *, inherited: bool = True) -> Class:
        found: Class | None = None
        around: Class | None = scope
        while around is not None and found is None:
            found = self.element(around, name) if inherited else around.classes.get(name)
            found = found or self._imported(around, name)
            if "encapsulated" in around.prefixes and found is None:
                raise UnknownError
            around, inherited = around.around, True
        if found is None:
            raise NotFoundError
        return _certain(found)

    def within(self, found: Class, names: Iterable[str]) -> Class:
        """Return a class inside of another one; raises `UnknownError` where it is not known."""
        for name in names:
            found = _certain(self.element(found, name))
        return found

    def declaration(self, owner: Class, name: str) -> Class | None:
        """Return the class that a class or a base of it declares, whatever modifiers make of it."""
        for one in self.lineage(owner):
            if name in one.classes:
                return one.classes[name]
        return None

    def element(self, owner: Class, name: str) -> Class | None:
        """Return the class that a class or a base of it declares, even if it is replaceable.

        Raises:
            ChangedError: a base has modifiers for this class, other than another function for a function
            UnknownError: a base is not known
        """
        if name in owner.classes:
            return owner.classes[name]
        for base, modifier in owner.bases:
            found = self.element(self.base(owner, base), name)
            given = modifier.inner.get(name)
            if found is not None and given is not None:
                if found.kind != "function" or not given.type or given.redeclares:
                    raise ChangedError
                return self._redeclared(owner, name, given)
            if found is not None:
                return found
        return None

    def _redeclared(self, owner: Class, name: str, given: Modifier) -> Class:
        """Return the short class that ``extends P(redeclare function f = g(k = 2))`` means in its class.

        It is always the same one, because classes are known by their identities.
        """
        key = (id(owner), name)
        if key not in self._short:
            bases = [(given.type, Modifier(inner=given.inner))]
            self._short[key] = Class(name, "function", owner, bases=bases, is_short=True)
        return self._short[key]

    def bases(self, owner: Class) -> Iterator[Class]:
        """Yield the base classes of a class; raises `UnknownError` where one is not known."""
        for name, _ in owner.bases:
            yield self.base(owner, name)

    def components(self, owner: Class) -> Mapping[str, tuple[Class, Component]]:
        """Return the components of a class by name, each with the class that declares it, perhaps a base.

        Inherited ones stand in the place of their extends clause (section 5.6.1).

        Raises `UnknownError` if a base is not known.
        """
        if id(owner) not in self._components:
            if not owner.is_certain:
                raise UnknownError
            found: dict[str, tuple[Class, Component]] = {}
            own = [(component.name, (owner, component)) for component in owner.components]
            for place, base in enumerate(self.bases(owner)):
                found |= dict(own[: owner.first[place]] if owner.first else ())
                found |= self.components(base)
            found |= dict(own)
            self._components[id(owner)] = found
        return self._components[id(owner)]

    def is_class(self, name: str, scope: Class) -> bool:
        """Return whether a name means a class, or may mean one."""
        try:
            self.meaning(name, scope)
        except NotFoundError:
            return False
        except UnknownError:
            return True
        return True

    @cached_property
    def changed(self) -> Mapping[int, Set[str]]:
        """The classes that others inherit with other values, with the names of these; "*" for any."""
        found: dict[int, set[str]] = defaultdict(set)
        for heir in self.classes():
            redeclared = {one.name for one in heir.components if "redeclare" in one.prefixes}
            redeclared |= {name for name, one in heir.classes.items() if "redeclare" in one.prefixes}
            unknown = set() if heir.is_certain else {"*"}
            for name, modifier in heir.bases:
                names = modifier.inner.keys() | redeclared | unknown
                with suppress(UnknownError):
                    for one in self.lineage(self.base(heir, name)) if names else ():
                        found[id(one)] |= names
            for one in heir.classes.values():
                if one.kind == "package" and one.constraint is not None and one.constraint.inner:
                    with suppress(UnknownError):
                        for base in self.lineage(one):
                            found[id(base)] |= one.constraint.inner.keys()
            for modifier in _redeclarations(heir):
                with suppress(UnknownError):
                    package = self.default(modifier.type, heir)
                    for one in self.lineage(package) if package.kind == "package" else ():
                        found[id(one)] |= modifier.inner.keys()
        return found

    def lineage(self, owner: Class) -> Iterator[Class]:
        """Yield a class and all its bases; raises `UnknownError` where one is not known."""
        if not owner.is_certain:
            raise UnknownError
        yield owner
        for base in self.bases(owner):
            yield from self.lineage(base)

    def base(self, owner: Class, name: str) -> Class:
        """Return the base class of this name, which is not searched among what is inherited."""
        if name in PREDEFINED:
            return PREDEFINED[name]
        if name.startswith("."):
            return self.class_of(name[1:])
        first, *rest = name.split(".")
        scope = owner.around if owner.is_short else owner
        if scope is None:
            raise UnknownError
        if name == owner.name and not owner.is_short:
            return self._extended(owner)
        return self.within(self._first(first, scope, inherited=owner.is_short), rest)

    def _extended(self, owner: Class) -> Class:
        """Return the inherited class that ``redeclare function extends f`` extends."""
        for base in self.bases(owner.around) if owner.around is not None else ():
            found = self.element(base, owner.name)
            if found is not None:
                return found
        raise UnknownError

    def _imported(self, scope: Class, name: str) -> Class | None:
        for known, qualified in scope.imports:
            if known == name:
                return self.class_of(qualified)
            if known == "*":
                found = self.class_of(qualified).classes.get(name)
                if found is not None:
                    return found
        return None


def _certain(found: Class | None) -> Class:
    if found is None:
        raise UnknownError
    if "replaceable" in found.prefixes:
        raise ChangedError
    return found


def _redeclarations(owner: Class) -> Iterator[Modifier]:
    """Yield the redeclarations with modifiers in a class, as ``redeclare package P = Q(k = 2)``."""
    waiting = [modifier for _, modifier in owner.bases]
    waiting += [one.modifier for one in owner.components]
    for modifier in waiting:
        waiting += modifier.inner.values()
        if modifier.type and modifier.inner:
            yield modifier
