"""Write the constant tables of a model: `const Model model` and the arrays that it points to."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import NewtonBlock, needed
from fmu_build.codegen.c_expression import Writer
from fmu_build.codegen.c_function import c_string
from fmu_build.codegen.equations import Equations, EventSensitivities, watched_conditions
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.left_limits import left_limits
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.start_values import StartValues
from fmu_build.codegen.tangents import Tangents
from fmu_build.codegen.variables import StoredVariable
from fmu_build.support.description import Variable

_STORES = {
    "y": "STORE_STATE_OR_ALGEBRAIC",
    "p": "STORE_PARAMETER",
    "derivative": "STORE_DERIVATIVE",
    "time": "STORE_TIME",
}
_CAUSALITIES = {
    "parameter": "CAUSALITY_PARAMETER",
    "calculatedParameter": "CAUSALITY_CALCULATED_PARAMETER",
    "input": "CAUSALITY_INPUT",
    "output": "CAUSALITY_OUTPUT",
    "local": "CAUSALITY_LOCAL",
    "independent": "CAUSALITY_INDEPENDENT",
}
_TYPES = {
    "Real": "TYPE_REAL",
    "Integer": "TYPE_INTEGER",
    "Boolean": "TYPE_BOOLEAN",
    "Enumeration": "TYPE_ENUMERATION",
}


def tables(
    model: LoweredModel,
    equations: Equations,
    variables: Sequence[StoredVariable],
    starts: StartValues,
    names: Mapping[Slot, str],
    texts: Writer,
    nominals: Mapping[int, float],
    tangents: Tangents | None,
) -> str:
    """Return the C definition of `model` and its tables."""
    writer, e = _Tables(names), equations
    _write_arrays(writer, e, variables, starts, texts, nominals)
    sensitivities = _sensitivities(e.sensitivities, writer)
    n_blocks = sum(isinstance(step, NewtonBlock) for step in e.algebraics)
    writer.array("Block *const", "blocks", [f"&block_{number}" for number in range(n_blocks)])
    fields = [
        f".name = {c_string(model.name)}",
        ".token = MODEL_TOKEN",
        *(f".{field} = {count}" for field, count in _counts(e, len(variables), n_blocks).items()),
        *(f".{field} = {_bool(holds)}" for field, holds in _properties(e, variables).items()),
        f".initial_event_slot = {'NO_SLOT' if e.initial_event is None else names['p', e.initial_event]}",
        f".homotopy_slot = {'NO_SLOT' if e.homotopy is None else names['p', e.homotopy]}",
        f".has_tangents = {_bool(tangents is not None)}",
        f".has_initial_tangents = {_bool(tangents is not None and tangents.cover_initialization)}",
        *(f".{name} = {name}" for name in writer.defined),
        *sensitivities,
    ]
    return "\n".join(
        [*writer.parts, "const Model model = {", *(f"    {field}," for field in fields), "};", ""]
    )


def _write_arrays(
    writer: _Tables,
    e: Equations,
    variables: Sequence[StoredVariable],
    starts: StartValues,
    texts: Writer,
    nominals: Mapping[int, float],
) -> None:
    clocks = [
        [
            writer.slot(("p", c.activation)),
            *(repr(float(n)) for n in (*c.period, *c.phase)),
            _bool(c.from_start),
        ]
        for c in e.clocks
    ]
    initial = [f"{writer.place(slot)}, {c_string(texts.text(ex.leaf(slot)))}" for slot in e.initial_unknowns]
    writer.array("double", "y_start", [_number(starts.of(("y", i))) for i in range(e.n_y)])
    writer.array("double", "p_start", [_number(starts.of(("p", i))) for i in range(e.n_p)])
    writer.array("double", "state_nominal", [_number(nominals.get(i, 1.0)) for i in range(e.n_states)])
    writer.array("Variable", "variables", [_variable(stored, writer) for stored in variables])
    writer.array("Relation", "relations", _relations(e, writer))
    writer.array("size_t", "opposites", [str(position) for position in e.relations.opposites])
    writer.array(
        "PreBinding", "pre", [f"{{{writer.slot(('p', i))}, {writer.place(source)}}}" for i, source in e.pre]
    )
    discrete = [f"{{DISCRETE_{row.kind.upper()}, {writer.place(row.slot)}}}" for row in e.discrete]
    writer.array("DiscreteTarget", "discrete", discrete)
    writer.array("PeriodicClock", "clocks", [f"{{{', '.join(clock)}}}" for clock in clocks])
    writer.array("char *const", "root_texts", [c_string(texts.text(root)) for root in e.relations.roots])
    writer.array("ActionKind", "actions", [f"ACTION_{action.kind.upper()}" for action in e.actions])
    writer.array("InitialUnknown", "initial_unknowns", [f"{{{one}}}" for one in initial])


def _relations(e: Equations, writer: _Tables) -> list[str]:
    indicators = e.relations.indicators
    roots = [indicators[r.root, r.holds_at_zero] for r in e.relations.crossings]
    roots += [len(indicators) + e.relations.time_roots.index(r.root) for r in e.relations.of_time]
    return [
        f"{{{root}, {writer.slot(('p', r.memory))}, {_bool(r.holds_at_zero)}}}"
        for root, r in zip(roots, (*e.relations.crossings, *e.relations.of_time), strict=True)
    ]


def _counts(e: Equations, n_variables: int, n_blocks: int) -> dict[str, int]:
    return {
        "n_states": e.n_states,
        "n_y": e.n_y,
        "n_p": e.n_p,
        "n_variables": n_variables,
        "n_roots": len(e.relations.roots),
        "n_time_relations": len(e.relations.time_roots),
        "n_relations": len(e.relations.crossings) + len(e.relations.of_time),
        "n_pre": len(e.pre),
        "n_discrete": len(e.discrete),
        "n_clocks": len(e.clocks),
        "n_time_events": len(e.relations.event_times),
        "n_actions": len(e.actions),
        "n_initial_unknowns": len(e.initial_unknowns),
        "n_blocks": n_blocks,
    }


def _properties(e: Equations, variables: Sequence[StoredVariable]) -> dict[str, bool]:
    followed = _followed(e)
    continuous_inputs = {
        ex.p(s.index)
        for s in variables
        if s.variable.causality == "input" and s.variable.variability == "continuous"
    }
    return {
        "actions_follow_states": bool(watched_conditions(e)),
        "actions_read_algebraic": _read_algebraic(e, [action.condition for action in e.actions]),
        "discrete_reads_algebraic": bool(left_limits(e))
        or _read_algebraic(e, [row.value for row in e.discrete]),
        "has_left_limits": bool(left_limits(e)),
        "roots_follow_time": ex.TIME in followed,
        "roots_follow_inputs": not continuous_inputs.isdisjoint(followed),
    }


def _sensitivities(sensitivities: EventSensitivities | None, writer: _Tables) -> list[str]:
    """Write the table of sensitivities, if any; return the field of `model` that points to it."""
    if sensitivities is None:
        return []
    rows = [
        f"{{{writer.slot(('p', move))}, {writer.slot(('p', next_move))}}}"
        for move, next_move in zip(sensitivities.moves, sensitivities.next_moves, strict=True)
    ]
    writer.parts += [
        "static const EventMove event_moves[] = {",
        *(f"    {row}," for row in rows),
        "};",
        "",
        f"static const Sensitivities sensitivities = {{{sensitivities.n_states}, {len(rows)}, event_moves, "
        "root_rates};",
        "",
    ]
    return [".sensitivities = &sensitivities"]


def _followed(equations: Equations) -> set[Expression]:
    """Return the leaves that the zero crossings read, directly or through algebraic variables."""
    roots = equations.relations.roots
    steps = needed(equations.algebraics, roots)
    return set(ex.leaves(*roots, *(value for step in steps for value in step.expressions)))


def _read_algebraic(equations: Equations, expressions: Sequence[Expression]) -> bool:
    """Return whether any of the expressions reads an algebraic variable."""
    return max(ex.places("y", *expressions), default=-1) >= equations.n_states


class _Tables:
    """Collects static arrays; an empty one is omitted, so its pointer in `model` stays null."""

    def __init__(self, names: Mapping[Slot, str]) -> None:
        self.parts: list[str] = []
        self.defined: list[str] = []
        self._names = names

    def array(self, element: str, name: str, values: Sequence[str]) -> None:
        if values:
            self.parts += [
                f"static const {element} {name}[] = {{",
                *(f"    {value}," for value in values),
                "};",
                "",
            ]
            self.defined.append(name)

    def slot(self, slot: Slot) -> str:
        return self._names[slot]

    def place(self, slot: Slot) -> str:
        return f"{_STORES[slot[0]]}, {self._names[slot]}"


def _variable(stored: StoredVariable, writer: _Tables) -> str:
    variable = stored.variable
    index = str(stored.index)
    if stored.store == "y" or stored.store == "p":
        index = writer.slot((stored.store, stored.index))
    fields = [
        c_string(variable.name),
        _TYPES[variable.type],
        _STORES[stored.store],
        index,
        _CAUSALITIES[variable.causality],
        f"VARIABILITY_{variable.variability.upper()}",
        f"INITIAL_{(variable.initial or 'none').upper()}",
        *(_number(bound) for bound in _range(variable)),
    ]
    return "{" + ", ".join(fields) + "}"


def _range(variable: Variable) -> tuple[float, float]:
    low = -math.inf if variable.minimum is None else variable.minimum
    high = math.inf if variable.maximum is None else variable.maximum
    if variable.enumeration is not None:
        low, high = max(low, 1.0), min(high, float(len(variable.enumeration.literals)))
    return low, high


def _number(value: float) -> str:
    if math.isinf(value):
        return "INFINITY" if value > 0 else "-INFINITY"
    return repr(float(value))


def _bool(value: bool) -> str:
    return "true" if value else "false"
