"""FMI's ModelStructure: the dependencies of outputs, derivatives and initial unknowns, and their kinds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment
from fmu_build.codegen.differentiate import NotDifferentiableError, partial
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import TIME, ZERO, Expression
from fmu_build.codegen.variables import StoredVariable
from fmu_build.support.description import DependencyKind, Unknown

_TIME_SLOT = ("time", 0)


class Structure:
    """Dependencies of one model, derived from its equations."""

    def __init__(self, equations: Equations, variables: Sequence[StoredVariable]) -> None:
        self._equations = equations
        self._variables = variables
        self._steps = {u: step for step in equations.algebraics for u in step.unknowns}
        self._computed = dict(equations.dependent_parameters)
        self._discrete = {row.slot[1]: row.value for row in equations.discrete if row.slot[0] == "p"}
        self._values: dict[int, Expression] = {}
        self._tunable = {
            s.index for s in variables if s.store == "p" and s.variable.variability in ("tunable", "fixed")
        }

    def outputs(self) -> tuple[Unknown, ...]:
        """Return each output with its dependencies in continuous time."""
        return tuple(
            self._unknown(n, self._value(s))
            for n, s in enumerate(self._variables)
            if s.variable.causality == "output"
        )

    def derivatives(self) -> tuple[Unknown, ...]:
        """Return each derivative with its dependencies in continuous time."""
        return tuple(
            self._unknown(n, self._value(s))
            for n, s in enumerate(self._variables)
            if s.variable.derivative_of is not None
        )

    def initial_unknowns(self) -> tuple[Unknown, ...]:
        """Return the outputs, states, derivatives and calculated parameters that initialization computes."""
        found = []
        knowns = {
            (s.store, s.index): n
            for n, s in enumerate(self._variables)
            if (s.variable.initial == "exact" and s.variable.variability != "constant")
            or s.variable.causality in ("input", "independent")
        }
        states = set(range(self._equations.n_states))
        for n, s in enumerate(self._variables):
            is_state = s.store == "y" and s.index in states
            wanted = (
                s.variable.causality in ("output", "calculatedParameter")
                or is_state
                or s.variable.derivative_of is not None
            )
            if wanted and s.variable.initial in ("calculated", "approx"):
                reached = self._reach_initially(s)
                references = sorted({knowns[place] for place in reached if place in knowns} - {n})
                kinds: list[DependencyKind] = ["dependent" for _ in references]
                found.append(Unknown(n, tuple(references), tuple(kinds)))
        return tuple(found)

    def _value(self, stored: StoredVariable) -> Expression:
        if stored.store == "derivative":
            return self._equations.derivatives[stored.index]
        return ex.y(stored.index) if stored.store == "y" else ex.p(stored.index)

    def _unknown(self, reference: int, value: Expression) -> Unknown:
        """Return dependencies on states, inputs, parameters and time; explicit equations give their kind."""
        explicit, reached = self._expand(value)
        behind = self._parameters_behind(reached)
        dependencies: list[tuple[int, DependencyKind]] = []
        for n, s in enumerate(self._variables):
            leaf = _leaf(s)
            if s.variable.causality == "parameter" and leaf in behind:
                dependencies.append((n, "dependent"))
            elif self._is_known(s) and leaf in reached:
                dependencies.append((n, self._kind(explicit, leaf)))
        dependencies.sort()
        return Unknown(reference, tuple(n for n, _ in dependencies), tuple(k for _, k in dependencies))

    def _is_known(self, stored: StoredVariable) -> bool:
        is_state = stored.store == "y" and stored.index < self._equations.n_states
        return is_state or stored.variable.causality in ("input", "independent")

    def _parameters_behind(self, reached: Iterable[Expression]) -> set[Expression]:
        """Return the parameters among the leaves and, transitively, those that determine them."""
        found: set[Expression] = set()
        waiting = list(reached)
        while waiting:
            leaf = waiting.pop()
            if leaf not in found and leaf.operator == "p":
                found.add(leaf)
                if leaf.index in self._computed:
                    waiting.extend(ex.leaves(self._computed[leaf.index]))
        return found

    def _expand(self, value: Expression) -> tuple[Expression | None, frozenset[Expression]]:
        """Return the value in terms of states and p (None behind an algebraic loop), and its leaves."""
        reached: set[Expression] = set()
        replacements: dict[Expression, Expression] = {}
        explicit = True
        for leaf in ex.leaves(value):
            if leaf.operator == "y" and leaf.index >= self._equations.n_states:
                step = self._steps[leaf.index]
                if isinstance(step, Assignment):
                    inner, below = self._expand(step.value)
                    explicit = explicit and inner is not None
                    replacements[leaf] = inner if inner is not None else leaf
                else:
                    explicit = False
                    below = frozenset().union(
                        *(self._expand(part)[1] for part in _outside(step.residuals, step.unknowns))
                    )
                reached |= below
            else:
                reached.add(leaf)
        return (ex.substitute(value, replacements) if explicit else None), frozenset(reached)

    def _kind(self, explicit: Expression | None, leaf: Expression) -> DependencyKind:
        if explicit is None:
            return "dependent"
        try:
            slope = partial(explicit, leaf)
        except NotDifferentiableError:
            return "dependent"
        read = ex.leaves(slope)
        if slope == ZERO or any(item.operator != "p" for item in read):
            return "dependent"
        if not read:
            return "constant"
        return "fixed" if all(item.index in self._tunable for item in read) else "dependent"

    def _reach_initially(self, stored: StoredVariable) -> set[tuple[str, int]]:
        """Return all slots on which a value depends at initialization, through start values and equations."""
        starts: Mapping[ex.Slot, Expression] = dict(self._equations.start_values)
        seen: set[tuple[str, int]] = set()
        waiting = list(ex.leaves(self._value(stored)))
        while waiting:
            leaf = waiting.pop()
            if leaf == TIME:
                seen.add(_TIME_SLOT)
            if leaf == TIME or (leaf.operator, leaf.index) in seen:
                continue
            slot: ex.Slot = ("y" if leaf.operator == "y" else "p", leaf.index)
            seen.add(slot)
            sources: list[Expression] = []
            if slot in self._equations.initial_unknowns:
                sources.extend(self._equations.initial_residuals)
            elif slot in starts:
                sources.append(starts[slot])
            elif slot[0] == "p":
                sources.extend(
                    table[slot[1]] for table in (self._computed, self._discrete) if slot[1] in table
                )
            elif slot[1] in self._steps:
                sources.extend(self._steps[slot[1]].expressions)
            waiting.extend(ex.leaves(*sources))
        return seen


def _leaf(stored: StoredVariable) -> Expression | None:
    """Return the leaf that reads the variable in equations; None for derivatives, which are never read."""
    if stored.store == "time":
        return TIME
    return None if stored.store == "derivative" else ex.leaf((stored.store, stored.index))


def _outside(residuals: Sequence[Expression], unknowns: Sequence[int]) -> list[Expression]:
    """Return the leaves that an algebraic loop reads besides its own unknowns."""
    return [leaf for leaf in ex.leaves(*residuals) if leaf.operator != "y" or leaf.index not in unknowns]
