"""Relations: a change of their value switches the branch of an expression, which requires an event.

Between events an equation reads the memory of a relation instead of the relation itself, so that the branch
is frozen while the integrator passes the kink and locates it. rumoca gives most relations a memory. A
comparison left without one is matched to its zero crossing, recognized as a time event, or gets a crossing if
it reads a discrete variable; it remains a comparison only inside noEvent() or if it is constant between
events. floor(), ceil() and trunc() get a memory for their value, and two zero crossings at which the value
changes. The same holds for what is inside of another comparison.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Any

from fmu_build.codegen import expression as ex
from fmu_build.codegen.differentiate import linear_root
from fmu_build.codegen.expression import TIME, ZERO, Expression, binary, negate
from fmu_build.codegen.lowered import LoweredModel, slot_of
from fmu_build.codegen.no_event import comparisons_with_discrete, inner_comparisons, literal_comparisons
from fmu_build.codegen.programs import ProgramReader

_STEPS = ("Floor", "Ceil", "Trunc")


@dataclass(frozen=True, slots=True)
class Relation:
    """``p[memory]`` is 1 where ``root < 0``, and also where ``root == 0`` if `holds_at_zero`."""

    root: Expression
    memory: int
    holds_at_zero: bool


@dataclass
class Relations:
    """All relations of a model; the lists grow while its equations are read."""

    n_p: int
    """Length of p, including the memories added here."""
    crossings: list[Relation] = field(default_factory=list)
    """Relations monitored for zero crossings during integration."""
    of_time: list[Relation] = field(default_factory=list)
    """Relations that change only at time events."""
    event_times: list[Expression] = field(default_factory=list)
    """The time of each time event, in terms of p."""
    floors: dict[Expression, int] = field(default_factory=dict)
    """Calls of floor(), ceil() and trunc() with a continuous argument, and the slot of their value."""
    literal: frozenset[Expression] = frozenset()
    """Comparisons of time that trigger no event."""
    watches_inner: bool = False
    """Comparisons inside of others trigger events too."""
    discrete: frozenset[Expression] = frozenset()
    """Values of discrete variables and their pre(); empty if comparisons with them trigger no events."""
    inputs: frozenset[Expression] = frozenset()
    """Continuous inputs."""

    @property
    def indicators(self) -> dict[tuple[Expression, bool], int]:
        """The number of each distinct zero crossing, in the model's order.

        ``<`` and ``<=`` of the same root have separate crossings, because they differ at zero.
        """
        sides = dict.fromkeys((relation.root, relation.holds_at_zero) for relation in self.crossings)
        return {side: number for number, side in enumerate(sides)}

    @property
    def roots(self) -> tuple[Expression, ...]:
        """The root of each zero crossing."""
        return tuple(root for root, _ in self.indicators)

    @property
    def opposites(self) -> tuple[int, ...]:
        """For each relation, the position of the one with the negated root if both are false at zero.

        The number of relations means none; the tuple is empty if no relation has an opposite.
        """
        strict = {r.root: position for position, r in enumerate(self.crossings) if not r.holds_at_zero}
        everything = (*self.crossings, *self.of_time)
        none = len(everything)
        found = tuple(none if r.holds_at_zero else strict.get(negate(r.root), none) for r in everything)
        return found if any(position < none for position in found) else ()

    @property
    def time_roots(self) -> tuple[Expression, ...]:
        """The distinct roots of relations in time alone, in the model's order."""
        return tuple(dict.fromkeys(relation.root for relation in self.of_time))

    def _add(self, to: list[Relation], root: Expression, holds_at_zero: bool) -> int:
        memory = self.n_p
        self.n_p += 1
        to.append(Relation(root, memory, holds_at_zero))
        return memory

    def freeze_step(self, node: Expression) -> Expression:
        """Return the memory of floor(u), ceil(u) or trunc(u), adding it and its crossings if needed."""
        if node not in self.floors:
            memory = ex.p(self.n_p)
            self.floors[node] = self.n_p
            self.n_p += 1
            for root, holds_at_zero in _departures(node.operator, node.arguments[0], memory):
                self._add(self.crossings, root, holds_at_zero)
        return ex.p(self.floors[node])

    def freeze_inside_roots(self, unwatched: frozenset[tuple[Expression, bool]]) -> None:
        """Make relations read memories where they contain floor(), ceil(), trunc() or other comparisons.

        Where these jump, the root jumps too, perhaps to the other side of zero and back soon after.
        """
        for position, relation in enumerate(self.crossings):  # which grows
            memories = freeze_comparisons((relation.root,), self, unwatched, is_inside=True)
            self.crossings[position] = replace(relation, root=ex.substitute(relation.root, memories))

    def freeze(
        self, node: Expression, unwatched: frozenset[tuple[Expression, bool]], *, is_inside: bool = False
    ) -> Expression | None:
        """Return the memory that replaces a comparison, adding it if needed; None if the comparison stays.

        `is_inside`: the comparison is part of another one.
        """
        root, holds_at_zero, negated = _as_root(node)
        for relation in (*self.crossings, *self.of_time):
            if relation.root == root and relation.holds_at_zero == holds_at_zero:
                return _memory(relation.memory, negated)
        when = None if node in self.literal else _event_time(root)
        if when is not None:
            if when not in self.event_times:
                self.event_times.append(when)
            return _memory(self._add(self.of_time, root, holds_at_zero), negated)
        read = ex.leaves(root)
        varies = ex.varies(root) or not self.inputs.isdisjoint(read)
        is_watched = varies and ((is_inside and self.watches_inner) or not self.discrete.isdisjoint(read))
        if is_watched or (root, holds_at_zero) in unwatched:
            return _memory(self._add(self.crossings, root, holds_at_zero), negated)
        return None


def _memory(index: int, negated: bool) -> Expression:
    memory = ex.p(index)
    return ex.unary("Not", memory) if negated else memory


def _departures(operator: str, u: Expression, value: Expression) -> list[tuple[Expression, bool]]:
    """Return roots that turn negative where floor, ceil or trunc of u changes, and whether zero is outside.

    The interval of trunc(u) starts at its value and ends, without it, at the next integer away from zero.
    """
    above, below = binary("Add", value, ex.ONE), binary("Sub", value, ex.ONE)
    if operator == "Floor":
        return [(binary("Sub", u, value), False), (binary("Sub", above, u), True)]
    if operator == "Ceil":
        return [(binary("Sub", u, below), True), (binary("Sub", value, u), False)]
    is_above, is_below = Expression("Gt", (value, ZERO)), Expression("Lt", (value, ZERO))
    return [
        (ex.select(is_above, binary("Sub", u, value), ex.ONE), False),
        (ex.select(is_above, ex.ONE, binary("Sub", u, below)), True),
        (ex.select(is_below, binary("Sub", value, u), ex.ONE), False),
        (ex.select(is_below, ex.ONE, binary("Sub", above, u)), True),
    ]


def _as_root(node: Expression) -> tuple[Expression, bool, bool]:
    """Return (root, holds at zero, is negated) of an order comparison."""
    a, b = node.arguments
    match node.operator:
        case "Lt":
            return binary("Sub", a, b), False, False
        case "Le":
            return binary("Sub", a, b), True, False
        case "Gt":
            return binary("Sub", b, a), False, False
        case "Ge":
            return binary("Sub", b, a), True, False
    raise ValueError(node.operator)


def _event_time(root: Expression) -> Expression | None:
    """Return the time at which `root` is zero if it is linear in time and otherwise discrete; else None."""
    read = ex.leaves(root)
    if TIME not in read or any(leaf.operator == "y" for leaf in read):
        return None
    return linear_root(root, TIME)


def read_relations(
    model: LoweredModel, reader: ProgramReader, n_p: int
) -> tuple[Relations, frozenset[tuple[Expression, bool]]]:
    """Return the relations with a memory from rumoca, and the zero crossings that it monitors without one."""
    events = model.solve["events"]
    rows = reader.read_rows(events["root_conditions"])
    watched, literal = inner_comparisons(model)
    if watched and literal:
        raise model.unsupported(
            "relations inside of other relations are supported with noEvent() or without it, not both in one "
            "model; introduce a variable for each inner value"
        )
    relations = Relations(
        n_p,
        literal=literal_comparisons(model),
        watches_inner=watched,
        discrete=_discrete_values(model),
        inputs=_values(
            model, lambda variable: variable["role"] == "input" and variable["variability"] == "continuous"
        ),
    )
    unwatched: set[tuple[Expression, bool]] = set()
    for number, target in enumerate(events["root_relation_memory_targets"]):
        if _is_step_crossing(rows[number]):
            continue  # see Relations.freeze_step
        holds_at_zero = _holds_at_zero(model, rows[number], number)
        if target is None:
            unwatched.add((rows[number], holds_at_zero))
        else:
            relations.crossings.append(Relation(rows[number], target["P"]["index"], holds_at_zero))
    return relations, frozenset(unwatched)


def _discrete_values(model: LoweredModel) -> frozenset[Expression]:
    """Return what `Relations.discrete` holds: nothing without sample(), as then no crossing is left out."""
    if not model.solve["clocks"]["activation_parameter_indices"]:
        return frozenset()
    watched, literal = comparisons_with_discrete(model)
    values = (
        _values(model, lambda variable: variable["role"].startswith("discrete")) if watched else frozenset()
    )
    before = {
        ex.p(binding["dest_p_index"])
        for binding in model.solve["solve_layout"]["pre_param_bindings"]
        if ex.leaf(slot_of(binding["source"])) in values
    }
    if literal and values:
        raise model.unsupported(
            "relations between continuous and discrete variables are supported with noEvent() or without it, "
            "not both in one model; introduce a continuous variable for the difference"
        )
    return values | before


def _values(model: LoweredModel, wanted: Callable[[dict[str, Any]], bool]) -> frozenset[Expression]:
    """Return the values of the variables that are wanted."""
    names = [name for one in model.dae["variables"] if wanted(one) for name in one["scalar_names"]]
    return frozenset(ex.leaf(model.slots[name]) for name in names if name in model.slots)


def _is_step_crossing(root: Expression) -> bool:
    """Return whether this is rumoca's root for the steps of floor(u): -sin(pi*u)."""
    if root.operator != "Neg" or root.arguments[0].operator != "Sin":
        return False
    argument = root.arguments[0].arguments[0]
    return argument.operator == "Mul" and argument.arguments[0] == ex.number(math.pi)


def _no_zero_side(source: str) -> str:
    """Say what is unsupported where rumoca does not know on which side of zero a relation holds."""
    if source.startswith("assert"):
        return (
            "an assert() in a function whose arguments change during the simulation is not supported; "
            "put it into the model"
        )
    if source.isidentifier():
        return (
            f"{source} depends on a variable of the function that is set in some branches of an if only, "
            "which is not supported; give it a value before the if"
        )
    return (
        "an equality or inequality (==, <>) of values that relations decide is not supported; "
        "introduce a variable for each value"
    )


def _holds_at_zero(model: LoweredModel, root: Expression, number: int) -> bool:
    events = model.solve["events"]
    domain: str = events["root_zero_domains"][number]
    if domain == "Previous" and not ex.varies(_with_steps_frozen(root)):
        return False  # an equality of discrete values, written as a root of -1 or 1
    if domain not in ("NonPositive", "Positive"):
        spans = events["root_conditions"]["program_spans"]
        span = spans[number] if number < len(spans) else None
        raise model.unsupported(_no_zero_side(model.text(span) if span is not None else ""), span)
    return domain == "NonPositive"


def _with_steps_frozen(root: Expression) -> Expression:
    """Return the expression with a parameter for each floor(), ceil() and trunc(), which change at events."""
    return ex.substitute(root, {node: ex.p(0) for node in ex.walk(root) if node.operator in _STEPS})


def freeze_comparisons(
    roots: Iterable[Expression],
    relations: Relations,
    unwatched: frozenset[tuple[Expression, bool]],
    *,
    is_inside: bool = False,
) -> dict[Expression, Expression]:
    """Return the substitutions that make expressions read memories instead of comparing directly.

    `is_inside`: the expressions are parts of comparisons.
    """
    replacements: dict[Expression, Expression] = {}
    for node in ex.walk(*roots):
        if node.operator in _STEPS and ex.varies(node):
            replacements[node] = relations.freeze_step(node)
        if node.operator in ("Lt", "Le", "Gt", "Ge"):
            memory = relations.freeze(node, unwatched, is_inside=is_inside)
            if memory is not None:
                replacements[node] = memory
    return replacements
