"""The functions that names mean, the defaults of their inputs and the sizes of their results.

A function of a package has the constants of the heir through which it is called.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fmu_build.codegen.second_reading.arithmetic import Chosen, value_of
from fmu_build.codegen.second_reading.givens import NOWHERE, Scope
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.operations import UnknownError, Value, is_built_in, whole
from fmu_build.codegen.second_reading.scopes import PREDEFINED, Library
from fmu_build.codegen.second_reading.syntax import Class, Component, Tokens


@dataclass(frozen=True, slots=True)
class Function:
    """A function, and the package through which it is called, if others inherit it with other values."""

    library: Library
    declared: Class
    heir: Class | None

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
    def is_built_in(self) -> bool:
        """Whether it only calls the built-in function of its name, as in Modelica.Math."""
        name = self.declared.name
        calls = (":=", name, "(", *" , ".join(self.inputs).split(), ")", ";")
        end = 1 + len(calls)
        return is_built_in(name) and any(
            one.tokens[1:end] == calls and one.tokens[end : end + 1] in ((), ("annotation",))
            for one in self.declared.algorithms
        )

    def all_arguments(self, arguments: Sequence[Value], named: Mapping[str, Value]) -> list[Value]:
        """Return the arguments of a call with the defaults of the others."""
        if len(arguments) > len(self.inputs):
            raise UnknownError
        given = dict(zip(self.inputs, arguments, strict=False)) | dict(named)
        bases = (base for one in self.library.lineage(self.declared) for base in one.bases)
        if len(given) < len(self.inputs) and any(modifier.inner for _, modifier in bases):
            raise UnknownError  # They may change defaults.
        for name, (around, one) in self.inputs.items():
            if name not in given:
                given[name] = self._value(one.modifier.value, around, given)
        return [given[name] for name in self.inputs]

    def sizes(self, arguments: Sequence[Value]) -> tuple[int, ...]:
        """Return the sizes of the result, which must be a single one of a predefined type."""
        outputs = [*self._with("output").values()]
        if len(outputs) != 1 or len(self.inputs) != len(arguments):
            raise UnknownError
        ((around, output),) = outputs
        if output.type not in PREDEFINED:
            raise UnknownError
        given = dict(zip(self.inputs, arguments, strict=True))
        return tuple(whole(self._value(tokens, around, given)) for tokens in output.dimensions)

    def instances(self) -> Instances:
        """Return its variables."""
        return Instances(self.library, self.declared, heir=self.heir)

    def _with(self, prefix: str) -> dict[str, tuple[Class, Component]]:
        components = self.library.components(self.declared).items()
        return {name: found for name, found in components if prefix in found[1].prefixes}

    def _value(self, tokens: Tokens, around: Class, given: Mapping[str, Value]) -> Value:
        return value_of(tokens, _Names(self.instances(), around, given))


@dataclass(frozen=True, slots=True)
class _Names:
    """What names mean in declarations of a function."""

    instances: Instances
    around: Class
    given: Mapping[str, Value]
    is_smooth: bool = False

    def is_random(self, reference: Chosen) -> bool:
        del reference
        return False

    def value(self, reference: Chosen) -> Value:
        ((name, subscripts), *further) = reference
        if name in self.given and not subscripts and not further:
            return self.given[name]
        return self.instances.of_constant(reference, Scope(NOWHERE, self.around))

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.value(reference).shape

    def applied(self, operator: str, reference: Chosen) -> Value:
        raise UnknownError

    def called(self, name: str, arguments: Sequence[Value], named: Mapping[str, Value]) -> Value | None:
        if self.instances.library.is_class(name, self.around):
            raise UnknownError
        return None


def function_of(instances: Instances, name: str, scope: Scope) -> Function:
    """Return the function that a name means in a scope; raises `UnknownError` if it is not known."""
    library = instances.library
    *path, last = name.split(".")
    if path == [""]:
        return plain_function(library, library.class_of(last), None)
    if not path:
        return plain_function(
            library, library.meaning(name, scope.around), instances.lookup.around(name, scope)
        )
    package = instances.lookup.class_in(path, scope)
    return plain_function(library, library.element(package, last), package)


def plain_function(library: Library, found: Class | None, package: Class | None) -> Function:
    """Return the function for which a class stands; raises `UnknownError` if it is not known."""
    declared = _plain(library, found)
    if declared is None or declared.kind != "function" or declared.is_short:
        raise UnknownError
    if declared.around is None or id(declared.around) not in library.changed:
        return Function(library, declared, None)
    heir = _plain(library, package)
    if heir is None:
        raise UnknownError
    return Function(library, declared, heir)


def _plain(library: Library, found: Class | None) -> Class | None:
    """Return the class for which a short class without modifiers stands."""
    while found is not None and found.is_short and found not in PREDEFINED.values():
        base, modifier = found.bases[0]
        if modifier.inner:
            break
        found = library.base(found, base)
    return found
