"""The arguments of calls, with the defaults of inputs, and the sizes of results."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from fmu_build.codegen.second_reading.arithmetic import Chosen, Names, NotRandom, value_of
from fmu_build.codegen.second_reading.functions import Function
from fmu_build.codegen.second_reading.gathered import indexed, leaves_in
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError, Value, whole
from fmu_build.codegen.second_reading.records import member_of
from fmu_build.codegen.second_reading.syntax import Class


def variables_of(instances: Variables, function: Function) -> Variables:
    """Return the variables of a function."""
    return instances.of_class(function.declared, function.heir)


def all_arguments(
    function: Function,
    variables: Variables,
    arguments: Sequence[Value],
    named: Mapping[str, Value],
    names_in: Callable[[Class], Names],
) -> list[Value]:
    """Return the arguments of a call with the defaults of the others.

    Args:
        function: the function
        variables: its variables
        arguments: the arguments without names
        named: those with names
        names_in: what names in a class mean, apart from the inputs

    Raises `UnknownError` if one is not known.
    """
    inputs = function.inputs
    if len(arguments) > len(inputs):
        raise UnknownError
    given = dict(zip(inputs, arguments, strict=False)) | dict(named)
    defaults = function.defaults if len(given) < len(inputs) else {}
    for name in inputs:
        if name not in given:
            if name not in defaults:
                raise UnknownError
            around, tokens = defaults[name]
            given[name] = value_of(tokens, _Names(variables, given, names_in(around)))
    return [given[name] for name in inputs]


def sizes_of_result(
    function: Function,
    variables: Variables,
    arguments: Sequence[Value],
    place: int,
    names_in: Callable[[Class], Names],
) -> tuple[int, ...]:
    """Return the sizes of a result, with arguments as above; that of a record is a vector.

    Raises `UnknownError` if they are not known.
    """
    if place >= len(function.outputs):
        raise UnknownError
    name = [*function.outputs][place]
    if name not in variables.leaves:
        return (sum(math.prod(variables.sizes[leaf]) for leaf in leaves_in(variables, name)),)
    given = dict(zip(function.inputs, arguments, strict=True))
    return tuple(
        whole(value_of(tokens, _Names(variables, given, names_in(scope.around))))
        for tokens, scope in variables.dimensions[name]
    )


@dataclass(frozen=True, slots=True)
class _Names(NotRandom):
    """What names mean in declarations of a function: its arguments, or what they mean otherwise."""

    variables: Variables
    given: Mapping[str, Value]
    others: Names

    def value(self, reference: Chosen) -> Value:
        ((name, subscripts), *further) = reference
        if name not in self.given:
            return self.others.value(reference)
        if not further:
            return indexed(self.given[name], subscripts)
        if subscripts or any(one for _, one in further):
            raise UnknownError
        return member_of(self.variables, name, self.given[name], [one for one, _ in further])

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.value(reference).shape

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        return self.others.member(name, result, members)

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        return self.others.called(name, arguments, named, place)
