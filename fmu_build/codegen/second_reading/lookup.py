"""What names of classes and constants mean in the components of a model (Modelica 3.6, section 5.3).

A component may redeclare classes of its class, and the package of which its class is an element, as
``Heir.Part part``, decides about the constants and classes that this finds around it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

from fmu_build.codegen.second_reading.givens import NOWHERE, Given, Scope, plain
from fmu_build.codegen.second_reading.operations import ChangedError, UnknownError
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class, Modifier


class Lookup:
    """Looks up names in scopes.

    Attributes:
        given: what the classes of a component are given, by its path and the identities of the classes
        heirs: the packages of which the classes of components are elements, by the plain paths of these
        of_bases: the packages by which base classes of these are named, with the identities of the bases
    """

    def __init__(self, library: Library) -> None:
        self.given: dict[tuple[str, int], Mapping[str, Given]] = {}
        self.heirs: dict[str, Class] = {}
        self.of_bases: dict[tuple[str, int], Class] = {}
        self._modified: dict[tuple[str, int, str], Class] = {}
        self._library = library

    def constant(self, name: str, scope: Scope) -> tuple[Class, str]:
        """Return the class in which a constant is, and its name there.

        Raises:
            ChangedError: heirs of the class may have other constants
            UnknownError: the name means something else, or is not known
        """
        *path, last = name.removeprefix(".").split(".")
        if name.startswith("."):
            return self._library.class_of(".".join(path)), last
        if path:
            return self.class_in(path, scope), last
        around: Class | None = scope.around
        while around is not None:
            if last in self._library.components(around):
                owner = self._heir(around, scope)
                if owner is None:
                    raise ChangedError
                return owner, last
            for known, qualified in around.imports:
                if known == last:
                    return self.constant(f".{qualified}", scope)
                if known == "*" and last in self._library.components(self._library.class_of(qualified)):
                    return self._library.class_of(qualified), last
            if "encapsulated" in around.prefixes:
                break
            around = around.around
        raise UnknownError

    def class_in(self, names: list[str], scope: Scope) -> Class:
        """Return the class that a qualified name means in a scope.

        Raises:
            ChangedError: heirs of the class in which it is found may have another class of this name
            UnknownError: it is not known
        """
        first, *rest = names
        if not first:
            return self._library.class_of(".".join(rest))
        given = self.given.get((scope.path, id(scope.around)))
        own = self._library.declaration(scope.around, first) if given is not None else None
        other = self.redeclared(first, scope)
        if other is not None:
            found = self._of_redeclaration(first, other, scope)
        elif own is not None:
            found = self._with_constraint(own)
        else:
            found = self._around(first, scope)
        return self._library.within(found, rest)

    def _of_redeclaration(self, name: str, other: Given, scope: Scope) -> Class:
        """Return the class that a component is given for one of this name, perhaps with modifiers.

        Those of the constraining clause hold, too (section 7.3.2). Raises `ChangedError` if it is not known.
        """
        if not other.type or other.type_scope is None:
            raise ChangedError
        found = self.class_in(other.type.split("."), other.type_scope)
        declared = self._library.declaration(scope.around, name)
        constraint = declared.constraint if declared is not None else None
        inner = {**(constraint.inner if constraint is not None else {})}
        if any(one.inner or _has_names(one) for one in inner.values()):
            raise ChangedError
        inner |= _modifiers(other, other.type_scope)
        if not inner:
            return found
        key = (scope.path, id(scope.around), name)
        short = self._short(key, found.kind, other.type_scope.around, other.type, inner)
        if self._library.base(short, other.type) is not found:
            raise ChangedError
        return short

    def _with_constraint(self, own: Class) -> Class:
        """Return a package or function with the modifiers of its constraining clause; components get them."""
        is_component = own.kind not in ("package", "function")
        if is_component or own.constraint is None or not own.constraint.inner:
            return own
        if not own.is_short or own.around is None:
            raise ChangedError
        ((base, modifier),) = own.bases
        inner = {**own.constraint.inner, **modifier.inner}
        return self._short(("", id(own), own.name), own.kind, own.around, base, inner)

    def _short(
        self, key: tuple[str, int, str], kind: str, around: Class, base: str, inner: Mapping[str, Modifier]
    ) -> Class:
        """Return a short class with modifiers, for a key always the same: classes are known by identity."""
        if key not in self._modified:
            bases = [(base, Modifier(inner=inner))]
            self._modified[key] = Class(key[-1], kind, around, bases=bases, is_short=True)
        return self._modified[key]

    def redeclared(self, name: str, scope: Scope) -> Given | None:
        """Return what the component of a scope is given for a class of this name; None if nothing."""
        return self.given.get((scope.path, id(scope.around)), {}).get(name)

    def around(self, name: str, scope: Scope) -> Class | None:
        """Return the class, or an heir of it, in which a class of this name is found; None if not known."""
        around: Class | None = scope.around
        while around is not None:
            if self._library.declaration(around, name) is not None:
                return self._heir(around, scope)
            around = around.around
        return None

    def _around(self, name: str, scope: Scope) -> Class:
        found = self._library.meaning(name, scope.around)
        heir = self._heir(found.around, scope) if found.around is not None else found.around
        if heir is found.around:
            return found
        if heir is not None:
            inherited = self._library.element(heir, name)
            if inherited is None:
                raise UnknownError
            return inherited
        if not self._library.changed[id(found.around)].isdisjoint((name, "*")):
            raise ChangedError
        return found

    def _heir(self, around: Class, scope: Scope) -> Class | None:
        """Return the heir of a class whose elements a scope means, perhaps itself; None if not known."""
        if id(around) not in self._library.changed:
            return around
        for heir in self._heirs(scope):
            with suppress(UnknownError):
                if any(one is around for one in self._library.lineage(heir)):
                    return heir
        return None

    def _heirs(self, scope: Scope) -> Iterator[Class]:
        """Yield the packages of the components around a scope, the innermost first."""
        path = "" if scope.path == NOWHERE else plain(scope.path)
        if scope.path != NOWHERE and (path, id(scope.around)) in self.of_bases:
            yield self.of_bases[path, id(scope.around)]
        while path:
            if path in self.heirs:
                yield self.heirs[path]
            path = path.rpartition(".")[0]
        if "" in self.heirs:
            yield self.heirs[""]


def _modifiers(given: Given, scope: Scope) -> dict[str, Modifier]:
    """Return what a redeclaration in a scope gives; raises `ChangedError` if others give some of it."""
    if any(one.scope != scope or one.type or one.redeclares for one in given.inner.values()):
        raise ChangedError
    return {
        name: Modifier(value=one.value, inner=_modifiers(one, scope), final=one.final)
        for name, one in given.inner.items()
    }


def _has_names(modifier: Modifier) -> bool:
    """Return whether a value depends on where it stands."""
    return any(token.isidentifier() for token in modifier.value) or bool(modifier.type)
