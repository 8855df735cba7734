"""The values of all variables of an FMU at one time, and what names in the source mean with them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Final

import numpy as np

from fmu_build.codegen.second_reading.arithmetic import Chosen, Names, NotRandom
from fmu_build.codegen.second_reading.carried_out import member_of_result, result_of_call
from fmu_build.codegen.second_reading.gathered import gathered, indexed
from fmu_build.codegen.second_reading.givens import Scope
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value

#: Operators that depend on more than the present values.
_OF_EVENTS: Final = frozenset(("delay", "initial", "sample", "semiLinear", "terminal"))


@dataclass(frozen=True, slots=True)
class Moment:
    """The variables of a model at one time.

    Attributes:
        instances: what the source says of the variables
        time: the time
        values: by the names of FMI, with those of derivatives, as ``der(a.x[2])``
        number: 0, or that of a disturbed moment, from 1
    """

    instances: Variables
    time: float
    values: Mapping[str, float]
    number: int = 0

    def of(self, path: str, operator: str = "") -> Value:
        """Return the value of a variable; raises `UnknownError` if the FMU does not show it."""
        leaf = self.instances.leaves[path]
        names = [f"{operator}({one})" if operator else one for one in scalars(path, leaf.sizes)]
        if all(one in self.values for one in names):
            return as_value([self.values[one] for one in names]).reshape(leaf.sizes)
        if operator or not leaf.is_constant:
            raise UnknownError
        return self.instances.known(path)

    def disturbed(self, scales: Mapping[str, float], number: int) -> Moment:
        """Return a moment with a number at which variables with scales differ by random parts of these."""
        random = np.random.default_rng(number).uniform(-1.0, 1.0, len(scales))
        changes = zip(scales.items(), random, strict=True)
        before = {"time": self.time, **self.values}
        changed = {name: before[name] + scale * float(one) for (name, scale), one in changes}
        return Moment(self.instances, changed["time"], {**self.values, **changed}, number)


def scalars(path: str, sizes: Sequence[int]) -> Iterator[str]:
    """Yield the names of the elements of a variable, the last subscript first to change."""
    if not sizes:
        yield path
        return
    if math.prod(sizes) > 0:
        for places in itertools.product(*(range(1, size + 1) for size in sizes)):
            yield f"{path}[{','.join(map(str, places))}]"


def names_at(
    moment: Moment, scope: Scope, assigned: Set[str] = frozenset(), values: Mapping[str, Value] | None = None
) -> Names:
    """Return what names mean in a scope at a moment.

    Args:
        moment: the moment
        scope: the scope
        assigned: names of variables that an algorithm assigns
        values: those of them that it has assigned already
    """
    return _Names(moment, scope, assigned, values or {})


@dataclass(frozen=True, slots=True)
class _Names(NotRandom):
    moment: Moment
    scope: Scope
    assigned: Set[str]
    values: Mapping[str, Value]

    def value(self, reference: Chosen) -> Value:
        instances = self.moment.instances
        ((name, subscripts), *further) = reference
        if name in self.assigned:
            if name not in self.values or further:
                raise UnknownError
            return indexed(self.values[name], subscripts)
        path = instances.path_of(reference, self.scope)
        if path is not None:
            return gathered(instances, path, reference, self.moment.of)
        if [name for name, _ in reference] == ["time"]:
            return as_value(self.moment.time)
        return instances.of_constant(reference, self.scope)

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.moment.instances.sizes_of(reference, self.scope)

    def applied(self, operator: str, reference: Chosen) -> Value:
        instances = self.moment.instances
        path = instances.path_of(reference, self.scope)
        if operator != "der" or path is None:
            raise UnknownError
        return gathered(instances, path, reference, lambda leaf: self.moment.of(leaf, operator))

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        if name in _OF_EVENTS:
            raise UnknownError
        return result_of_call(self.moment.instances, self.scope, name, arguments, named, place)

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        return member_of_result(self.moment.instances, self.scope, name, result, members)
