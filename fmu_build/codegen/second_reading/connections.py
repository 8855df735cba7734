"""Compare rumoca's equations of connections with the connections in the source.

Modelica 3.6, section 9.2: variables of connected connectors are equal, or if they are flows, sum to zero,
with a minus for connectors of the component itself ("outside"). A flow that nothing around its component
connects is zero.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Set
from typing import Any, Generic, TypeVar

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.givens import Mistake, Scope, around
from fmu_build.codegen.second_reading.known_variables import Leaf, Variables
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.references import Elements, elements, points
from fmu_build.codegen.second_reading.sections import Branches, Connection, Loop, Statement, statements

_T = TypeVar("_T")
Flow = tuple[str, int]
"""A flow and its sign: +1 inside, -1 outside."""


def mistaken_connections(model: LoweredModel, meant: Connections) -> Iterator[str]:
    """Yield the equations of connections that differ from those of the source."""
    flat = model.flat["equations"]
    if any(model.flat[key] for key in ("branches", "optional_edges", "definite_roots", "potential_roots")):
        return  # Some equations of overdetermined connectors are left out.
    equal: _Sets[str] = _Sets()
    flows: set[frozenset[Flow]] = set()
    for one in flat:
        if one["origin"].keys() & {"Connection", "FlowSum", "UnconnectedFlow"}:
            terms = list(_terms(one["residual"], 1))
            columns = (meant.scalars(name, places) for name, places, _ in terms)
            for column in zip(*columns, strict=False):  # If one is not known, nothing is concluded.
                if "Connection" in one["origin"]:
                    equal.join(*column)
                else:
                    flows.add(_positive(zip(column, (sign for _, _, sign in terms), strict=True)))
    yield from _other_flows(meant, flows)
    for group in sorted({*equal.sets()} ^ {*meant.equal.sets()}, key=sorted):
        if all(map(meant.is_known, group)):
            yield f"{', '.join(sorted(group))} are connected otherwise in the source"


def _other_flows(meant: Connections, flows: Set[frozenset[Flow]]) -> Iterator[str]:
    for one in sorted(flows ^ {_positive(one) for one in meant.flows()}, key=sorted):
        if all(meant.is_known(name) for name, _ in one):
            text = " + ".join(sorted(("-" if sign < 0 else "") + name for name, sign in one))
            yield f"the equation {text} = 0 of connections is {'wrong' if one in flows else 'lost'}"


def _terms(tree: Mapping[str, Any], sign: int) -> Iterator[tuple[str, tuple[int, ...], int]]:
    """Yield the variables in a sum with their subscripts and signs."""
    ((kind, content),) = tree.items()
    if kind == "Binary":
        yield from _terms(content["lhs"], sign)
        yield from _terms(content["rhs"], sign if content["op"] == "Add" else -sign)
    elif kind == "Unary":
        yield from _terms(content["rhs"], -sign)
    else:
        yield content["name"]["name"], tuple(one["Index"]["value"] for one in content["subscripts"]), sign


def _of_leaf(name: str, leaf: Leaf, first: tuple[int, ...] = ()) -> list[str]:
    """Return the paths of the scalars in a variable, or of those with these first subscripts."""
    rest = (range(1, size + 1) for size in leaf.sizes[len(first) :])
    places = [(*first, *one) for one in itertools.product(*rest)]
    return [f"{name}[{','.join(map(str, one))}]" if one else name for one in places]


def _positive(flows: Iterable[Flow]) -> frozenset[Flow]:
    """Return a sum, multiplied with -1 if the first name has a minus."""
    found = sorted(flows)
    return frozenset((name, sign * found[0][1]) for name, sign in found)


class _Sets(Generic[_T]):
    """Disjoint sets, joined one pair at a time."""

    def __init__(self) -> None:
        self._parents: dict[_T, _T] = {}

    def root(self, one: _T) -> _T:
        while (parent := self._parents.setdefault(one, one)) != one:
            one = parent
        return one

    def join(self, one: _T, other: _T) -> None:
        self._parents[self.root(one)] = self.root(other)

    def sets(self) -> Iterator[frozenset[_T]]:
        found = defaultdict(set)
        for one in list(self._parents):
            found[self.root(one)].add(one)
        yield from map(frozenset, found.values())


class Connections:
    """The connections of a model.

    Attributes:
        equal: sets of scalars that are equal
        mistakes: connections that are invalid, each with the name that it is about
    """

    def __init__(self, instances: Variables) -> None:
        self.equal: _Sets[str] = _Sets()
        self.mistakes: list[Mistake] = []
        self._flows: _Sets[Flow] = _Sets()
        self._instances = instances
        self._unclear: set[str] = set()
        self._scalars: dict[str, str] = {}
        self._below: dict[str, list[str]] = defaultdict(list)
        for name, leaf in instances.leaves.items():
            if leaf.prefixes & {"parameter", "constant", "stream"}:
                continue
            for scalar in _of_leaf(name, leaf):
                self._scalars[scalar] = name
            for part in around(name):
                self._below[part].append(name)
        self._find_flows()
        for path, one in instances.parts.items():
            try:
                for owner in one.classes:
                    self._class(Scope(path, owner))
            except (SyntaxError, UnknownError):
                self._unclear.add(path)

    def scalars(self, name: str, subscripts: tuple[int, ...]) -> list[str]:
        """Return the scalars of a variable with these first subscripts."""
        leaf = self._instances.leaves.get(name)
        return [name] if leaf is None else _of_leaf(name, leaf, subscripts)

    def flows(self) -> Iterator[frozenset[Flow]]:
        """Yield the sums of flows that are zero."""
        yield from self._flows.sets()

    def is_known(self, scalar: str) -> bool:
        """Return whether all connections of a scalar in a connector are known."""
        parts = self._instances.parts
        name = self._scalars.get(scalar)
        if name is None:
            return False
        outer = ["", *around(name)]
        if any(one not in parts or self._instances.may_be_outer(one) for one in outer):
            return False
        owners = [one for one in outer if parts[one].kind != "connector"]
        return not any(one in self._unclear for one in owners[-2:])

    def _find_flows(self) -> None:
        parts = self._instances.parts
        for name, leaf in self._instances.leaves.items():
            if "flow" in leaf.prefixes and any(
                one in parts and parts[one].kind == "connector" for one in around(name)
            ):
                for scalar in _of_leaf(name, leaf):
                    self._flows.root((scalar, 1))

    def _class(self, scope: Scope) -> None:
        for section in scope.around.sections:
            if not section.is_initial:
                for one in statements(section):
                    self._statement(scope, one, {})

    def _statement(self, scope: Scope, one: Statement, iterators: Mapping[str, float]) -> None:
        if isinstance(one, Connection):
            first = elements(self._instances, scope, one.first, iterators)
            second = elements(self._instances, scope, one.second, iterators)
            if first is not None and second is not None:
                self._connect(first, second)
        elif isinstance(one, Loop) and _has_connections(one):
            for point in points(self._instances, scope, one.iterators, iterators):
                for inner in one.body:
                    self._statement(scope, inner, point)
        elif isinstance(one, Branches) and _has_connections(one):
            for condition, body in one.branches:
                if not condition or self._instances.number(condition, scope, iterators):
                    for inner in body:
                        self._statement(scope, inner, iterators)
                    break

    def _connect(self, one: Elements, other: Elements) -> None:
        if one.shape != other.shape:
            raise UnknownError
        signs = [self._sign(side.first) for side in (one, other)]
        for pair in zip(one.paths, other.paths, strict=True):
            inner = [self._variables(connector) for connector in pair]
            if inner[0].keys() != inner[1].keys():
                if all(self._is_whole(connector) for connector in pair):
                    self.mistakes.append((f"{pair[0]} and {pair[1]} have different variables", "connect"))
                raise UnknownError
            for relative, first in inner[0].items():
                second = inner[1][relative]
                if "flow" in self._instances.leaves[self._scalars[first]].prefixes:
                    self._flows.join((first, signs[0]), (second, signs[1]))
                else:
                    self.equal.join(first, second)

    def _is_whole(self, connector: str) -> bool:
        """Return whether all variables of a connector are known."""
        members = self._instances.members(connector)
        return connector in self._scalars or all(
            f"{connector}.{name}" in self._instances.sizes for name in members
        )

    def _sign(self, first: str) -> int:
        part = self._instances.parts.get(first)
        return -1 if part is not None and part.kind == "connector" else 1

    def _variables(self, connector: str) -> dict[str, str]:
        """Return the scalars of a connector, or of a variable that is one, by their paths in it."""
        if connector in self._scalars:
            return {"": connector}
        if connector not in self._instances.parts:
            raise UnknownError
        leaves = self._instances.leaves
        scalars = [one for name in self._below[connector] for one in _of_leaf(name, leaves[name])]
        return {one.removeprefix(connector): one for one in scalars}


def _has_connections(one: Statement) -> bool:
    if isinstance(one, Branches):
        return any(_has_connections(inner) for _, body in one.branches for inner in body)
    return isinstance(one, Connection) or (isinstance(one, Loop) and any(map(_has_connections, one.body)))
