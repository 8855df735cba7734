"""The functions that names mean, with the defaults that short classes and heirs give (Modelica 3.6, 12.1).

A function of a package has the constants of the heir through which it is called.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from fmu_build.codegen.second_reading.givens import Given, Scope
from fmu_build.codegen.second_reading.lookup import Lookup
from fmu_build.codegen.second_reading.operations import ChangedError, UnknownError, is_built_in
from fmu_build.codegen.second_reading.scopes import PREDEFINED, Library
from fmu_build.codegen.second_reading.syntax import Class, Component, Modifier, Tokens

Defaults: TypeAlias = Mapping[str, tuple[Class, Tokens]]
"""Values for inputs, each with the class in which it stands."""


@dataclass(frozen=True, slots=True)
class Function:
    """A function.

    Attributes:
        library: the classes
        declared: its class
        heir: the package through which it is called, if others inherit it with other values
        given: the values that short classes which stand for it give to its inputs
    """

    library: Library
    declared: Class
    heir: Class | None
    given: Defaults = field(default_factory=dict)

    @property
    def key(self) -> str:
        """A text that no other function has."""
        heir = f"{self.heir.qualified} " if self.heir is not None else ""
        return f"{heir}{self.declared.file} {self.declared.start}"

    @property
    def inputs(self) -> Mapping[str, tuple[Class, Component]]:
        """Its inputs in the order of their declaration, each with the class that declares it."""
        return self._with("input")

    @property
    def outputs(self) -> Mapping[str, tuple[Class, Component]]:
        """Its results, likewise."""
        return self._with("output")

    @property
    def defaults(self) -> Defaults:
        """The values of inputs that are no arguments; raises `UnknownError` if they are not known."""
        found = self.given
        for one in self.library.lineage(self.declared):
            for _, modifier in one.bases:
                found = {**_values(modifier, one), **found}
        declared = {name: (one, component.modifier.value) for name, (one, component) in self.inputs.items()}
        return {**{name: one for name, one in declared.items() if one[1]}, **found}

    @property
    def is_built_in(self) -> bool:
        """Whether it only calls the built-in function of its name, as in Modelica.Math."""
        name = self.declared.name
        calls = (":=", name, "(", *" , ".join(self.inputs).split(), ")", ";")
        end = 1 + len(calls)
        return is_built_in(name) and any(
            one.tokens[1:end] == calls and one.tokens[end : end + 1] in ((), ("annotation",))
            for one in self.declared.algorithms
        )

    def _with(self, prefix: str) -> dict[str, tuple[Class, Component]]:
        components = self.library.components(self.declared).items()
        return {name: found for name, found in components if prefix in found[1].prefixes}


def function_of(library: Library, lookup: Lookup, name: str, scope: Scope) -> Function:
    """Return the function that a name means in a scope; raises `UnknownError` if it is not known."""
    *path, last = name.split(".")
    if path == [""]:
        return plain_function(library, library.class_of(last), None)
    if path:
        package = lookup.class_in(path, scope)
        return plain_function(library, library.element(package, last), package)
    other = lookup.redeclared(name, scope)
    if other is None:
        around = lookup.around(name, scope)
        if around is None or around.kind != "package":
            return plain_function(library, lookup.class_in([name], scope), around)
        # Nothing redeclares what is in a known package, as a component may do for a model.
        return plain_function(library, library.element(around, name), around)
    if not other.type or other.type_scope is None:
        raise ChangedError
    found = function_of(library, lookup, other.type, other.type_scope)
    declared = library.declaration(scope.around, name)
    constraint = declared.constraint if declared is not None else None
    constrained = _values(constraint, scope.around) if constraint is not None else {}
    given = {key: (_around(one), one.value) for key, one in other.inner.items()}
    return replace(found, given={**found.given, **constrained, **given})


def _around(given: Given) -> Class:
    if given.scope is None or not given.value or given.inner:
        raise ChangedError
    return given.scope.around


def plain_function(library: Library, found: Class | None, package: Class | None) -> Function:
    """Return the function for which a class stands; raises `UnknownError` if it is not known."""
    declared, given = _declared(library, found)
    if declared.kind != "function" or declared.is_short:
        raise UnknownError
    if declared.around is None or id(declared.around) not in library.changed:
        return Function(library, declared, None, given)
    if package is None:
        raise ChangedError
    heir, given_to_heir = _declared(library, package)
    return Function(library, declared, package if given_to_heir else heir, given)


def _declared(library: Library, found: Class | None) -> tuple[Class, Defaults]:
    """Return the class for which short classes stand, and what they give to it."""
    given: Defaults = {}
    while found is not None and found.is_short and found not in PREDEFINED.values():
        base, modifier = found.bases[0]
        if found.around is None:
            raise UnknownError
        given = {**_values(modifier, found.around), **given}
        found = library.base(found, base)
    if found is None:
        raise UnknownError
    return found, given


def _values(modifier: Modifier, around: Class) -> Defaults:
    if any(one.inner or one.redeclares or one.type for one in modifier.inner.values()):
        raise ChangedError
    return {name: (around, one.value) for name, one in modifier.inner.items()}
