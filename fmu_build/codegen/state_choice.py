"""Refuse models whose motion after a reinit() depends on the choice of states.

Of ``v_1``, ``v_2`` and ``v_rel = v_2 - v_1``, any two may be the states, with the same motion. At
``reinit(v_1, 0)``, however, the other state, ``v_2`` or ``v_rel``, keeps its value. The attribute stateSelect
decides which of them is a state, and rumoca does not always obey it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from fmu_build.codegen.equations import Equations
from fmu_build.codegen.expression import places
from fmu_build.codegen.lowered import LoweredModel

#: In ascending order of precedence, in rumoca's spelling.
_SELECTIONS = ("Never", "Avoid", "Default", "Prefer", "Always")
_DEFAULT = _SELECTIONS.index("Default")


def reject_other_states(model: LoweredModel, equations: Equations) -> None:
    """Refuse a model in which a reinit() preserves a state where another variable has precedence as state.

    Raises:
        UnsupportedModelError: names both variables and the reinitialized state
    """
    reinitialized = {row.slot[1] for row in equations.discrete if row.kind == "reinit"}
    if not reinitialized:
        return
    names = model.y_names
    ranks = {index: _SELECTIONS.index(select) for index, select in _selections(model)}
    reached = _states_behind(equations)
    for place, rank in ranks.items():
        behind = reached.get(place, frozenset())
        lower = sorted(state for state in behind - reinitialized if ranks.get(state, _DEFAULT) < rank)
        if lower and behind & reinitialized:
            kept, changed = lower[0], min(behind & reinitialized)
            select = _SELECTIONS[rank].lower()
            raise model.unsupported(
                f"reinit() of {names[changed]} would keep {names[kept]}, the state that rumoca has chosen, "
                f"and not {names[place]}, which has precedence (stateSelect = {select}): give "
                f"{names[kept]} the higher stateSelect, or write the model with {names[place]} alone"
            )


def _selections(model: LoweredModel) -> Iterator[tuple[int, str]]:
    """Yield the place in y of each continuous Real variable, and its stateSelect."""
    for entry in model.dae["variables"]:
        if entry["role"] in ("state", "algebraic", "output"):
            for name in entry["scalar_names"]:
                slot = model.slots.get(name)
                if slot is not None and slot[0] == "y":
                    yield slot[1], entry["attributes"]["state_select"]


def _states_behind(equations: Equations) -> Mapping[int, frozenset[int]]:
    """Return the states from which each algebraic variable is computed."""
    states = frozenset(range(equations.n_states))
    behind: dict[int, frozenset[int]] = {}

    def of(indices: Iterable[int]) -> frozenset[int]:
        return frozenset().union(*(behind.get(i, frozenset((i,)) & states) for i in indices))

    for step in equations.algebraics:
        found = of(places("y", *step.expressions) - set(step.unknowns))
        behind.update(dict.fromkeys(step.unknowns, found))
    return behind
