"""Check that the results of an FMU fulfil the equations of its source.

All other checks compare texts and the compiler's readings of them. This one sees whatever went wrong after
these: each equation that can be computed is evaluated with the values that the FMU gives at some times.
"""

from __future__ import annotations

import json
import re
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Final

import numpy as np

from fmu_build.codegen.second_reading.arithmetic import results_of, value_of
from fmu_build.codegen.second_reading.carried_out import Algorithm
from fmu_build.codegen.second_reading.connections import Connections
from fmu_build.codegen.second_reading.givens import Scope, as_written, joined
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.known_variables import Leaf
from fmu_build.codegen.second_reading.moments import Moment, names_at
from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value, scalar
from fmu_build.codegen.second_reading.references import points
from fmu_build.codegen.second_reading.scopes import PREDEFINED, Library
from fmu_build.codegen.second_reading.sections import Branches, Equation, Loop, Statement, statements
from fmu_build.codegen.second_reading.syntax import Section, Tokens

#: Part of a variable's largest value by which it is disturbed, and the multiple of what this changes in an
#: equation that counts as its error: 1e-5 of its largest term.
_DISTURBANCE: Final = 1e-9
_ALLOWED: Final = 1e4
_DISTURBED: Final = 4
_ROUNDING: Final = 1e-9
#: Values of variables that may be what is left of zero, as at a double root of a loop.
_NOISE: Final = 1e-7
_LONGEST: Final = 60

#: What may change variables at the start.
_AT_THE_START: Final = frozenset(("change", "edge", "pre", "reinit", "sample", "when"))

#: Numbers of type Real, which are no sizes or subscripts.
_REAL: Final = re.compile(r"(\d+\.\d*|\.\d+|\d+(?=[eE]))([eE][+-]?\d+)?")

Residual = Callable[[Moment], Sequence[tuple[Value, Value]]]
"""Pairs of values that must be equal; raises `UnknownError` where they are not known."""
Row = tuple[float, Mapping[str, float]]
"""A time, and the values of variables by their names in FMI."""


def kept_texts(texts: Sequence[str]) -> bytes:
    """Return the source texts of a model as `mistaken_results` takes them."""
    return zlib.compress(json.dumps(texts).encode())


def mistaken_results(kept: bytes, model: str, rows: Sequence[Row]) -> Iterator[str]:
    """Yield the equations and values of a model's source that the results of its FMU do not fulfil.

    Args:
        kept: the source texts
        model: the qualified name of the model
        rows: the values at some times, of which the first is the start
    """
    library = Library(dict(enumerate(json.loads(zlib.decompress(kept)))))
    try:
        instances = Instances(library, library.class_of(model))
    except UnknownError:
        return
    moments = [Moment(instances, *row) for row in rows]
    scales = _scales(moments)
    disturbed = [[one.disturbed(scales, number + 1) for number in range(_DISTURBED)] for one in moments]
    for text, residual in _equations(instances):
        pairs = zip(moments, disturbed, strict=True)
        wrong = [one.time for one, others in pairs if _differs(residual, one, others)]
        # A relation may be in doubt at one time.
        if len(wrong) > 1 or (wrong and len(moments) == 1):
            yield f"at time {wrong[0]:g}, the result of the FMU does not fulfil {text}"
    yield from _other_constants(moments[0], disturbed[0])
    if not _is_changed_at_the_start(instances):
        yield from _other_starts(moments[0])
        for text, residual in _equations_of_sections(instances, is_initial=True):
            if _differs(residual, moments[0], disturbed[0]):
                yield f"the start of the FMU does not fulfil {text}"


def _scales(moments: Sequence[Moment]) -> dict[str, float]:
    """Return by how much the Real variables and parameters are disturbed, by name, and the time."""
    leaves = moments[0].instances.leaves
    found = {"time": _DISTURBANCE * ((moments[-1].time - moments[0].time) or 1.0)}
    for name in moments[0].values:
        whole = name.removeprefix("der(").removesuffix(")") if name.startswith("der(") else name
        leaf = leaves.get(whole) or leaves.get(whole.rpartition("[")[0])
        if leaf is not None and leaf.kind is PREDEFINED["Real"]:
            largest = max(abs(one.values[name]) for one in moments)
            found[name] = _DISTURBANCE * (largest if leaf.is_constant or largest > _NOISE else 1.0)
    return found


def _differs(residual: Residual, moment: Moment, disturbed: Sequence[Moment]) -> bool:
    try:
        pairs = residual(moment)
        others = [residual(one) for one in disturbed]
    except UnknownError:
        return False
    for place, (left, right) in enumerate(pairs):
        if left.shape != right.shape or not all(len(one) == len(pairs) for one in others):
            return False
        error = np.abs(left - right)
        changes = [np.abs((one[place][0] - one[place][1]) - (left - right)) for one in others]
        if any(one.shape != error.shape for one in changes):
            return False
        most = np.max([np.nan_to_num(one, posinf=0.0) for one in changes], axis=0)
        allowed = _ALLOWED * most + _ROUNDING * (np.abs(left) + np.abs(right))
        if (np.isfinite(error) & (error > allowed)).any():
            return True
    return False


def _equations(instances: Instances) -> Iterator[tuple[str, Residual]]:
    """Yield the equations of declarations, sections and connections, each with its text."""
    for path, leaf in instances.leaves.items():
        if leaf.given.value and not leaf.is_constant and leaf.given.scope is not None:
            text = f"{path} = {as_written(leaf.given.value)}"
            yield text, _declared(path, leaf)
    yield from _equations_of_sections(instances, is_initial=False)
    yield from _connected(Connections(instances))


def _equations_of_sections(instances: Instances, *, is_initial: bool) -> Iterator[tuple[str, Residual]]:
    for path, part in instances.parts.items():
        where = f" of {path}" if path else ""
        for owner in part.classes:
            scope = Scope(path, owner)
            for section in owner.sections:
                if section.is_initial == is_initial:
                    yield from _of_section(scope, section, where)
            for section in owner.algorithms:
                if section.is_initial == is_initial:
                    text = f"the algorithm {as_written(section.tokens)[:_LONGEST]}...{where}"
                    yield text, _carried_out(scope, section)


def _declared(path: str, leaf: Leaf) -> Residual:
    given, variants = leaf.given, _variants(leaf.given.value)

    def pairs(moment: Moment) -> Sequence[tuple[Value, Value]]:
        scope = given.scope or moment.instances.nowhere
        meant = given.spread(value_of(variants[moment.number], names_at(moment, scope)), leaf.sizes)
        return [(moment.of(path), meant)]

    return pairs


def _of_section(scope: Scope, section: Section, where: str) -> Iterator[tuple[str, Residual]]:
    try:
        variants = [statements(replace(section, tokens=tokens)) for tokens in _variants(section.tokens)]
    except SyntaxError:
        return
    for those in zip(*variants, strict=True):
        first = those[0]
        if isinstance(first, Equation | Branches | Loop):
            words = as_written(section.between(first.start, first.end)).removesuffix(";")
            yield f"the equation {words}{where}", _stated(those, scope)


def _stated(variants: Sequence[Statement], scope: Scope) -> Residual:
    return lambda moment: _pairs(variants[moment.number], moment, scope, {})


def _variants(tokens: Tokens) -> list[Tokens]:
    """Return a text, and what it is at the disturbed moments: with other Real numbers, but no other sizes."""
    random = np.random.default_rng(1).uniform(-_DISTURBANCE, _DISTURBANCE, (_DISTURBED, len(tokens)))
    places = [place for place, token in enumerate(tokens) if _REAL.fullmatch(token)]
    found = [[*tokens] for _ in range(_DISTURBED)]
    for changes, one in zip(random, found, strict=True):
        for place in places:
            one[place] = repr(float(tokens[place]) * (1.0 + float(changes[place])))
    return [tokens, *map(tuple, found)]


def _pairs(
    one: Statement, moment: Moment, scope: Scope, iterators: Mapping[str, float]
) -> list[tuple[Value, Value]]:
    """Return the sides of the equations that hold; those of clauses and connections are left out."""
    names = names_at(moment, scope)
    if isinstance(one, Equation):
        results = one.results
        if results:
            left = [value_of(side, names, iterators) for side in results.values()]
            return [*zip(left, results_of(one.right, results, names, iterators), strict=True)]
        return [(value_of(one.left, names, iterators), value_of(one.right, names, iterators))]
    if isinstance(one, Loop):
        passes = points(moment.instances, scope, one.iterators, iterators)
        return [pair for inner in passes for each in one.body for pair in _pairs(each, moment, scope, inner)]
    if isinstance(one, Branches):
        for condition, body in one.branches:
            if not condition or scalar(value_of(condition, names, iterators)):
                return [pair for each in body for pair in _pairs(each, moment, scope, iterators)]
    return []


def _carried_out(scope: Scope, section: Section) -> Residual:
    names = _assigned(section)

    def pairs(moment: Moment) -> Sequence[tuple[Value, Value]]:
        leaves = moment.instances.leaves
        paths = {name: joined(scope.path, name) for name in names}
        assigned = {name for name, path in paths.items() if path in leaves}
        arrays = {name: np.full(leaves[paths[name]].sizes, np.nan) for name in assigned}
        algorithm = Algorithm(
            {name: value for name, value in arrays.items() if value.ndim},
            assigned,
            lambda around, values: names_at(moment, Scope(scope.path, around), assigned, values),
        )
        algorithm.carry_out(section, scope.around)
        return [(moment.of(paths[name]), value) for name, value in algorithm.values.items()]

    return pairs


def _assigned(section: Section) -> set[str]:
    """Return the names before ``:=``, and all names in parentheses before it."""
    found: set[str] = set()
    before: list[str] = []
    for token in section.tokens:
        if token == ":=":
            found.update(one for one in before if one.isidentifier())
        before = [] if token in (";", "then", "loop", "else", ":=") else [*before, token]
    return found


def _connected(connections: Connections) -> Iterator[tuple[str, Residual]]:
    for group in sorted(connections.equal.sets(), key=sorted):
        names = sorted(group)
        if len(names) > 1 and all(map(connections.is_known, names)):
            yield f"the connection of {', '.join(names)}", _equal(names)
    for flows in sorted(connections.flows(), key=sorted):
        if all(connections.is_known(name) for name, _ in flows):
            text = " + ".join(sorted(("-" if sign < 0 else "") + name for name, sign in flows))
            yield f"the equation {text} = 0 of connections", _zero_sum(sorted(flows))


def _equal(names: Sequence[str]) -> Residual:
    def pairs(moment: Moment) -> Sequence[tuple[Value, Value]]:
        values = [as_value(moment.values[name]) for name in names if name in moment.values]
        return [(values[0], one) for one in values[1:]]

    return pairs


def _zero_sum(flows: Sequence[tuple[str, int]]) -> Residual:
    def pairs(moment: Moment) -> Sequence[tuple[Value, Value]]:
        if any(name not in moment.values for name, _ in flows):
            raise UnknownError
        return [(as_value(sum(sign * moment.values[name] for name, sign in flows)), as_value(0.0))]

    return pairs


def _other_constants(moment: Moment, disturbed: Sequence[Moment]) -> Iterator[str]:
    """Yield the parameters and constants that have other values at the start."""
    for path, leaf in moment.instances.leaves.items():
        if not leaf.is_constant or not leaf.given.value or leaf.kind is PREDEFINED["String"]:
            continue
        residual = _declared(path, leaf)
        if _differs(residual, moment, disturbed):
            ((found, meant),) = residual(moment)
            yield f"{path} is {_text(found)} in the FMU, and {_text(meant)} in the source"


def _is_changed_at_the_start(instances: Instances) -> bool:
    """Return whether an event at the start may change what initial equations and fixed values have given."""
    owners = {id(owner): owner for part in instances.parts.values() for owner in part.classes}
    return any(_AT_THE_START & {*owner.tokens} for owner in owners.values())


def _other_starts(moment: Moment) -> Iterator[str]:
    """Yield the states that have other values at the start than those that are fixed.

    The start of a discrete variable is that of ``pre()``; an equation may give it another value at once.
    """
    instances = moment.instances
    for path, leaf in instances.leaves.items():
        fixed, start = leaf.given.inner.get("fixed"), leaf.given.inner.get("start")
        if leaf.is_constant or leaf.kind is PREDEFINED["String"] or fixed is None or start is None:
            continue
        with suppress(UnknownError):
            scope = start.scope or instances.nowhere
            meant = start.spread(value_of(start.value, names_at(moment, scope)), leaf.sizes)
            moment.of(path, "der")  # of a state
            found, is_fixed = moment.of(path), fixed.spread(instances.value(fixed), leaf.sizes)
            allowed = _ROUNDING * (1.0 + np.abs(meant))
            if meant.shape == found.shape and (is_fixed * np.abs(found - meant) > allowed).any():
                yield f"{path} starts at {_text(found)} in the FMU, and at {_text(meant)} in the source"


def _text(value: Value) -> str:
    return np.array2string(value, separator=", ", threshold=6)
