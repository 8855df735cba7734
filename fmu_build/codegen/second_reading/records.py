"""Constructors of records, and the members of records that functions return (Modelica 3.6, section 12.6).

The value of a record is a vector of the values of its members.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fmu_build.codegen.second_reading.gathered import flattened, leaves_in
from fmu_build.codegen.second_reading.givens import Scope, joined
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import ChangedError, UnknownError, Value
from fmu_build.codegen.second_reading.record_values import argument_names
from fmu_build.codegen.second_reading.syntax import Class


@dataclass(frozen=True, slots=True)
class Constructor:
    """The constructor of a record: its variables, and the names of its arguments."""

    variables: Variables
    names: Sequence[str]

    def given(self, arguments: Sequence[Value], named: Mapping[str, Value]) -> dict[str, Value]:
        """Return the values of variables that follow from arguments.

        Raises `UnknownError` if these do not fit.
        """
        if len(arguments) > len(self.names):
            raise UnknownError
        values = dict(zip(self.names, arguments, strict=False)) | dict(named)
        found = {}
        for name, value in values.items():
            leaves = [name] if name in self.variables.leaves else [*leaves_in(self.variables, name)]
            found.update(_split(self.variables, leaves, value))
        return found


def constructor_of(instances: Variables, name: str, scope: Scope) -> Constructor | None:
    """Return the constructor that a name means in a scope; None if it means something else.

    Raises `UnknownError` if it is not known.
    """
    *path, last = name.split(".")
    found = instances.lookup.class_in([*path, last], scope)
    around = instances.lookup.class_in(path, scope) if any(path) else instances.lookup.around(last, scope)
    return constructor(instances, found, around)


def constructor(instances: Variables, found: Class, package: Class | None) -> Constructor | None:
    """Return the constructor of a class in a package or class; None if it is no record."""
    library, declared = instances.library, found
    is_changed = False
    while declared.is_short:
        is_changed |= id(declared.around) in library.changed
        declared = library.base(declared, declared.bases[0][0])
    is_changed |= id(declared.around) in library.changed
    if declared.kind != "record":
        return None
    if is_changed and package is None:
        raise ChangedError
    variables = instances.of_class(found, package if is_changed else None)
    final = {name for name, leaf in variables.leaves.items() if leaf.given.final}
    return Constructor(variables, [one for one in argument_names(library, declared) if one not in final])


def member_of(variables: Variables, path: str, record: Value, names: Sequence[str]) -> Value:
    """Return a member, of which the names are nested, of a component that is a record.

    Raises `UnknownError` if there is none.
    """
    leaves = [*leaves_in(variables, path)]
    member = path
    for name in names:
        member = joined(member, name)
    own = [leaf for leaf in leaves if leaf == member or leaf.startswith((f"{member}.", f"{member}["))]
    values = _split(variables, leaves, record)
    if not own:
        raise UnknownError
    return values[member] if own == [member] else flattened(values[leaf] for leaf in own)


def _split(variables: Variables, leaves: Sequence[str], value: Value) -> dict[str, Value]:
    """Return the values of variables from the vector of all."""
    if len(leaves) == 1:
        sizes = variables.sizes[leaves[0]]
        if value.size != math.prod(sizes):
            raise UnknownError
        return {leaves[0]: value.reshape(sizes)}
    counts = [math.prod(variables.sizes[leaf]) for leaf in leaves]
    if value.ndim != 1 or value.size != sum(counts):
        raise UnknownError
    found, first = {}, 0
    for leaf, count in zip(leaves, counts, strict=True):
        found[leaf] = value[first : first + count].reshape(variables.sizes[leaf])
        first += count
    return found
