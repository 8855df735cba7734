"""The variables of a model or package, what names mean in it, and the values that do not change."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass

from fmu_build.codegen.second_reading.arithmetic import Chosen, NotRandom, value_of
from fmu_build.codegen.second_reading.functions import function_of
from fmu_build.codegen.second_reading.gathered import gathered, sizes_of
from fmu_build.codegen.second_reading.givens import (
    NOWHERE,
    Given,
    Mistake,
    Scope,
    around,
    joined,
    nowhere,
    plain,
)
from fmu_build.codegen.second_reading.lookup import Lookup
from fmu_build.codegen.second_reading.operations import (
    ChangedError,
    UnknownError,
    Value,
    as_value,
    called,
    scalar,
)
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.syntax import Class, Tokens


@dataclass(frozen=True, slots=True)
class Leaf:
    """A variable of a predefined type."""

    given: Given
    prefixes: frozenset[str]
    kind: Class
    has_zero_start: bool
    """Whether its start value is zero unless it is given another one."""
    sizes: tuple[int, ...]

    @property
    def is_constant(self) -> bool:
        """Whether it is a parameter or a constant."""
        return bool(self.prefixes & {"parameter", "constant"})


@dataclass(frozen=True, slots=True)
class Part:
    """The model, or a component of it that is no variable: the classes with its equations, and its kind."""

    classes: tuple[Class, ...]
    kind: str


@dataclass(frozen=True, slots=True)
class _Names(NotRandom):
    """What names mean in a scope."""

    instances: Variables
    scope: Scope

    def value(self, reference: Chosen) -> Value:
        return self.instances.named(reference, self.scope)

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.instances.sizes_of(reference, self.scope)

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        raise UnknownError

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        library = self.instances.library
        if not library.is_class(name, self.scope.around):
            return None
        function = function_of(library, self.instances.lookup, name, self.scope)
        if not function.is_built_in or named or place:
            raise UnknownError
        return called(function.declared.name, arguments)


class Variables(ABC):
    """The variables of a model, which `Instances` finds.

    Attributes:
        leaves: by path, as ``a.b[2].c``; an array of a predefined type is one
        parts: the other components by path, with the subscripts of arrays; the path of the model is empty
        sizes: of all components, by path; the last name has no subscripts
        dimensions: the expressions of all sizes, also of those that are not known, with their scopes
        order: the names of the members of components in the order of their declaration, if it is known
        absent: the paths of components whose conditions are false
        mistakes: what is invalid in the modifiers, each with the name that it is about
        unknown: what rumoca may have lost without a trace, with the class in which it stands
        nowhere: the scope of what the model itself is given
        lookup: what names of classes and constants mean
    """

    def __init__(
        self,
        library: Library,
        owner: Class,
        packages: dict[int, Variables] | None = None,
        heir: Class | None = None,
    ) -> None:
        """Begin with no variables.

        Args:
            library: the classes
            owner: the model, function or package
            packages: those already read, by the identities of their classes
            heir: the package through which a function is called
        """
        self.leaves: dict[str, Leaf] = {}
        self.parts: dict[str, Part] = {}
        self.sizes: dict[str, tuple[int, ...]] = {}
        self.dimensions: dict[str, list[tuple[Tokens, Scope]]] = {}
        self.order: dict[str, list[str]] = {}
        self.absent: set[str] = set()
        self.mistakes: list[Mistake] = []
        self.unknown: list[tuple[str, Class]] = []
        self.library = library
        self.nowhere = nowhere(owner)
        self.lookup = Lookup(library)
        if heir is not None:
            self.lookup.heirs[""] = heir
        self._members: dict[str, set[str]] = {}
        self._packages = {} if packages is None else packages
        self._others: dict[tuple[int, int], Variables] = {}
        self._evaluating: set[str] = set()
        self._outer: set[str] = set()
        self._inner: set[str] = set()

    @abstractmethod
    def _read(self, other: Class, heir: Class | None) -> Variables:
        """Return the variables of another class."""

    def members(self, path: str) -> Set[str]:
        """Return the names of the variables and components in a component; none if they are not known."""
        return self._members.get(path, frozenset())

    def is_through_outer(self, path: str) -> bool:
        """Return whether a path without subscripts goes through an outer component."""
        return any(f"{path}.".startswith(f"{outer}.") for outer in self._outer)

    def may_be_outer(self, path: str) -> bool:
        """Return whether an outer component has the name of this one, which may be the inner one."""
        name = plain(path).rpartition(".")[2]
        return any(outer.rpartition(".")[2] == name for outer in self._outer)

    def means_member(self, name: str, scope: Scope) -> bool:
        """Return whether a name means a variable or component of the component in which it stands.

        Raises `UnknownError` if the bases of the class are not known.
        """
        first = name.partition(".")[0].partition("[")[0]
        return first in self.library.components(scope.around) and first in self.members(scope.path)

    def value(self, given: Given) -> Value:
        """Return the value that is given; raises `UnknownError` if it is not known."""
        if not given.value:
            raise UnknownError
        return given.chosen(self.value_of(given.value, given.scope or self.nowhere))

    def value_of(self, tokens: Tokens, scope: Scope, iterators: Mapping[str, float] | None = None) -> Value:
        """Return the value of an expression; raises `UnknownError` if it is not known."""
        return value_of(tokens, _Names(self, scope), iterators)

    def number(self, tokens: Tokens, scope: Scope, iterators: Mapping[str, float] | None = None) -> float:
        """Return the value of a scalar; raises `UnknownError` if it is not known."""
        return scalar(self.value_of(tokens, scope, iterators))

    def named(self, reference: Chosen, scope: Scope) -> Value:
        """Return the value of a parameter or constant; raises `UnknownError` if it is not known."""
        path = self.path_of(reference, scope)
        if path is not None:
            return gathered(self, path, reference, self.known)
        return self.of_constant(reference, scope)

    def known(self, path: str) -> Value:
        """Return the value of a parameter or constant with a path; raises `UnknownError` if not known."""
        leaf = self.leaves[path]
        if not leaf.is_constant or not leaf.given.value or path in self._evaluating:
            raise UnknownError
        self._evaluating.add(path)
        try:
            found = self.value_of(leaf.given.value, leaf.given.scope or self.nowhere)
        finally:
            self._evaluating.discard(path)
        return leaf.given.spread(found, leaf.sizes)

    def path_of(self, reference: Chosen, scope: Scope) -> str | None:
        """Return the path of the component in which a reference begins; None if it means no variable.

        It is that of the scope, or a component around with an inner component. Raises `UnknownError` if it is
        not known.
        """
        name = reference[0][0]
        if scope.path == NOWHERE:
            return None
        if self.means_member(name, scope):
            return scope.path
        if plain(joined(scope.path, name)) not in self._outer:
            return None
        for path in reversed(["", *around(scope.path)]):
            if joined(path, name) in self._inner:
                return path
        raise UnknownError

    def of_constant(self, reference: Chosen, scope: Scope) -> Value:
        """Return the value of a constant of a package, or of a member or elements of it.

        Raises `UnknownError` if it means something else, or the value is not known.
        """
        names = [name for name, _ in reference]
        for count in range(len(names), 0, -1):
            if any(one for _, one in reference[: count - 1]):
                continue
            try:
                owner, last = self.lookup.constant(".".join(names[:count]), scope)
                return self._of_package(owner, [(last, reference[count - 1][1]), *reference[count:]])
            except ChangedError:
                raise
            except UnknownError:
                continue  # Another name may be that of a record.
        raise UnknownError

    def _of_package(self, owner: Class, reference: Chosen) -> Value:
        """Return the value of a constant in a package, or of a literal of an enumeration."""
        last = reference[0][0]
        if last in owner.literals and len(reference) == 1:
            return as_value(owner.literals.index(last) + 1)
        if owner.kind != "package":
            raise UnknownError
        if id(owner) not in self._packages:
            self._packages[id(owner)] = self  # until it is read, nothing is known of it
            self._packages[id(owner)] = self._read(owner, None)
        package = self._packages[id(owner)]
        if package is self:
            raise UnknownError
        return gathered(package, "", reference, package.known)

    def sizes_of(self, reference: Chosen, scope: Scope) -> Sequence[int]:
        """Return the sizes of an array; raises `UnknownError` if they are not known."""
        path = self.path_of(reference, scope)
        if path is not None:
            return sizes_of(self, path, reference)
        return self.of_constant(reference, scope).shape

    def of_class(self, other: Class, heir: Class | None) -> Variables:
        """Return the variables of a function or record, with the package through which it is called."""
        key = (id(other), id(heir))
        if key not in self._others:
            self._others[key] = self._read(other, heir)
        return self._others[key]
