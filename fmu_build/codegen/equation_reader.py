"""Read the equations of a lowered model from the Solve IR."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import NewtonBlock, isolate, order
from fmu_build.codegen.clocks import periodic_clocks, ticks_of_slots
from fmu_build.codegen.equations import Action, ActionKind, DiscreteKind, DiscreteRow, Equations
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.guesses import derived_guesses
from fmu_build.codegen.homotopy import deformable
from fmu_build.codegen.lowered import LoweredModel, slot_of
from fmu_build.codegen.programs import FunctionNames, ProgramReader
from fmu_build.codegen.rejections import initial_spans
from fmu_build.codegen.relations import freeze_comparisons, read_relations
from fmu_build.codegen.start_values import StartValues, reject_late_starts, starts_from_parameters

_Starts = tuple[tuple[Slot, Expression], ...]


def read_equations(model: LoweredModel, function_name: FunctionNames) -> Equations:
    """Read the Solve IR of `model`; raises `UnsupportedModelError` for an unsupported construct."""
    return _Reader(model, function_name).equations()


class _Reader:
    def __init__(self, model: LoweredModel, function_name: FunctionNames) -> None:
        self.model = model
        self.solve = model.solve
        self.layout = model.solve["solve_layout"]
        self.programs = ProgramReader(model, function_name)
        self.homotopy = self.layout["initial_homotopy_parameter_index"]
        self.relations, self.unwatched = read_relations(
            model, self.programs, self.layout["compiled_parameter_len"]
        )

    def equations(self) -> Equations:
        if self.layout["terminal_event_parameter_index"] is not None:
            raise self.model.unsupported("terminal() is not supported")
        continuous = self.solve["continuous"]
        n_states = self.layout["state_scalar_count"]
        derivatives = self._frozen(self._rows(continuous["derivative_rhs"]))
        algebraics = order(
            self.model,
            self._frozen(self._rows(continuous["implicit_rhs"])),
            continuous["algebraic_projection_plan"],
        )
        unknowns, residuals = self._initial_equations()
        blocks = [step for step in algebraics if isinstance(step, NewtonBlock)]
        sought: set[Slot] = {("y", i) for block in blocks for i in block.unknowns} | set(unknowns)
        given = StartValues(self.model)
        dependent, starts, guesses = self._updates(given, n_states, sought)
        reject_late_starts(self.model, starts, dependent, unknowns)
        known = {slot for slot in sought if given.of(slot) != 0.0} | {slot for slot, _ in guesses}
        guesses += tuple(derived_guesses(blocks, known, n_states))
        actions = self._actions()
        discrete = self._discrete(n_states)
        self.relations.freeze_inside_roots(self.unwatched)  # when all relations are there
        return Equations(
            n_states=n_states,
            n_y=len(self.model.y_names),
            derivatives=tuple(derivatives[i] for i in range(n_states)),
            algebraics=algebraics,
            discrete=(*discrete, *self._steps()),
            clocks=periodic_clocks(self.model),
            pre=self._pre(),
            actions=actions,
            dependent_parameters=dependent,
            start_values=starts,
            guesses=guesses,
            initial_unknowns=unknowns,
            initial_residuals=residuals,
            initial_event=self.layout["initial_event_parameter_index"],
            homotopy=self.homotopy,
            relations=self.relations,
            n_p=self.relations.n_p,
        )

    def _rows(self, section: Mapping[str, Any]) -> dict[int, Expression]:
        """Return the rows of a section; raises `UnsupportedModelError` unless all are scalar programs."""
        if "scalar_programs" in section:
            return self._read_rows(section["scalar_programs"])
        rows: dict[int, Expression] = {}
        for node in section["nodes"]:
            ((kind, table),) = node.items()
            if kind != "ScalarPrograms":
                raise self.model.unsupported(f"equation node {kind} of the Solve IR is not supported")
            rows |= self._read_rows(table)
        return rows

    def _read_rows(self, table: Mapping[str, Any]) -> dict[int, Expression]:
        rows = self.programs.read_rows(table)
        return rows if self.homotopy is None else deformable(rows, self.homotopy)

    def _frozen(self, rows: dict[int, Expression]) -> dict[int, Expression]:
        """Return the rows with relations replaced by their memories."""
        memories = freeze_comparisons(rows.values(), self.relations, self.unwatched)
        return {number: ex.substitute(row, memories) for number, row in rows.items()}

    def _discrete(self, n_states: int) -> tuple[DiscreteRow, ...]:
        discrete = self.solve["discrete"]
        rows = self._frozen(self._read_rows(discrete["rhs"]))
        ticks = ticks_of_slots(self.model)
        conditions = self._condition_memories()
        result = []
        for number, target in enumerate(discrete["update_targets"]):
            slot = slot_of(target)
            if number not in rows:
                raise self.model.unsupported("a discrete equation without a right-hand side is not supported")
            kind: DiscreteKind = "assign"
            if slot[0] == "y":
                kind = "reinit"
                if slot[1] >= n_states:
                    raise self.model.unsupported("reinit() is supported for states only")
            elif slot[1] in conditions:
                kind = "condition"
            result.append(DiscreteRow(kind, slot, self._guarded_by_tick(rows[number], slot, ticks.get(slot))))
        self._reject_missing_rows({row.slot for row in result})
        return tuple(result)

    def _steps(self) -> Iterator[DiscreteRow]:
        """Yield the updates of the memories of floor(), ceil() and trunc().

        Relations in them are read from their memories too: those of time change only just after their event.
        """
        for value, memory in tuple(self.relations.floors.items()):
            memories = freeze_comparisons(value.arguments, self.relations, self.unwatched, is_inside=True)
            yield DiscreteRow("assign", ("p", memory), ex.substitute(value, memories))

    def _reject_missing_rows(self, slots: set[Slot]) -> None:
        """Reject discrete arrays with equations outside when-clauses: rumoca drops these equations."""
        for variable in self.model.dae["variables"]:
            own = {self.model.slots[name] for name in variable["scalar_names"] if name in self.model.slots}
            if variable["role"].startswith("discrete") and not own <= slots:
                raise self.model.unsupported(
                    f"the equation of the discrete array {variable['name']} is not supported; "
                    "write one for each element, without a loop",
                    variable["declaration"]["span"],
                )

    def _guarded_by_tick(self, value: Expression, slot: Slot, tick: int | None) -> Expression:
        """Add the guard of ``when sample(...)``, which rumoca omits from the equations of the clause."""
        if tick is None or ex.p(tick) in ex.leaves(value):
            return value
        return ex.select(ex.p(tick), value, ex.y(slot[1]) if slot[0] == "y" else ex.p(slot[1]))

    def _condition_memories(self) -> frozenset[int]:
        """Return the slots of condition memories: those behind named variables and unused pre() slots."""
        pre = [binding["dest_p_index"] for binding in self.layout["pre_param_bindings"]]
        other = {
            *self.layout["relation_memory_parameter_indices"],
            *self.solve["clocks"]["activation_parameter_indices"],
        }
        other |= {self.layout["initial_event_parameter_index"], self.layout["terminal_event_parameter_index"]}
        first = max((n_named_slots(self.model) - 1, *pre)) + 1
        return frozenset(range(first, self.layout["compiled_parameter_len"])) - other

    def _pre(self) -> tuple[tuple[int, Slot], ...]:
        bindings = self.layout["pre_param_bindings"]
        return tuple((binding["dest_p_index"], slot_of(binding["source"])) for binding in bindings)

    def _actions(self) -> tuple[Action, ...]:
        events = self.solve["events"]
        conditions = self._frozen(self._read_rows(events["action_conditions"]))
        kinds: dict[str, ActionKind] = {"Assert": "error", "Warning": "warning", "Terminate": "terminate"}
        actions = []
        for number, action in enumerate(events["actions"]):
            if action["kind"] not in kinds:
                raise self.model.unsupported(f"action {action['kind']} is not supported")
            message = tuple(self._message_part(part) for part in action["message"]["parts"])
            actions.append(Action(kinds[action["kind"]], conditions[number], message))
        return tuple(actions)

    def _message_part(self, part: Mapping[str, Any]) -> str | tuple[str, Expression]:
        ((kind, content),) = part.items()
        if kind == "Text":
            return str(content)
        if kind == "Conversion":
            (value,) = self.programs.read(content["value"])
            if self.homotopy is not None:
                value = deformable({0: value}, self.homotopy)[0]
            return (content["source"], value)
        raise self.model.unsupported(f"message part {kind} is not supported")

    def _updates(
        self, given: StartValues, n_states: int, sought: set[Slot]
    ) -> tuple[tuple[tuple[int, Expression], ...], _Starts, _Starts]:
        """Return computed parameters, start values that depend on parameters, and guesses for `sought`."""
        initialization = self.solve["initialization"]
        rows = self._read_rows(initialization["update_rhs"])
        targets = [slot_of(target) for target in initialization["update_targets"]]
        n_parameters = self.layout["parameter_count"]
        dependent: list[tuple[int, Expression]] = []
        starts: list[tuple[Slot, Expression]] = []
        sources: dict[Slot, Slot] = {("p", slot): source for slot, source in self._pre()}
        for number, slot in enumerate(targets):
            if sources.get(slot) in targets:
                continue  # pre(v) takes its value from v
            if slot[0] == "p" and slot[1] < n_parameters:
                dependent.append((slot[1], rows[number]))
            else:
                starts.append((slot, rows[number]))
        others = starts_from_parameters(self.model, given, n_states, sought, without=targets)
        guesses = tuple((slot, value) for slot, value in others if slot in sought)
        starts += [(slot, value) for slot, value in others if slot not in sought]
        return tuple(dependent), (*starts, *self._previous_values(sought)), guesses

    def _previous_values(self, sought: set[Slot]) -> Iterator[tuple[Slot, Expression]]:
        """Yield the start values of discrete variables given by initial equations ``pre(v) = ...``."""
        initialization = self.solve["initialization"]
        rows = self._rows(initialization["residual"])
        sources = {ex.p(slot): source for slot, source in self._pre()}
        given = {ex.p(slot) for slot in range(self.layout["parameter_count"])}
        given |= {ex.y(state) for state in range(self.layout["state_scalar_count"])}
        given -= {ex.leaf(slot) for slot in sought}
        for row, role in enumerate(initialization["row_roles"]):
            if not isinstance(role, dict) or "UnownedCoordinate" not in role:
                continue
            read = ex.leaves(rows[row])
            previous = [leaf for leaf in read if leaf in sources]
            value = isolate(rows[row], previous[0]) if len(previous) == 1 else None
            if value is None or not given.issuperset(leaf for leaf in read if leaf != previous[0]):
                raise self.model.unsupported(
                    "an initial equation with a discrete variable, here or in what it needs, is supported "
                    "only as pre(v) = ... of parameters and fixed states; give a fixed start value instead, "
                    "or write the condition in the place of the Boolean",
                    initial_spans(self.model).get(row),
                )
            yield sources[previous[0]], value

    def _initial_equations(self) -> tuple[tuple[Slot, ...], tuple[Expression, ...]]:
        initialization = self.solve["initialization"]
        rows = self._frozen(self._rows(initialization["residual"]))
        unknowns: list[Slot] = []
        residuals: list[Expression] = []
        for block in initialization["projection_plan"]["blocks"]:
            unknowns += [slot_of(unknown) for unknown in block["unknowns"]]
            residuals += [rows[row] for row in block["rows"]]
        if len(unknowns) != len(residuals):
            raise self.model.unsupported(
                f"{len(residuals)} initial equations for {len(unknowns)} unknowns of the initialization"
            )
        return tuple(unknowns), tuple(residuals)


def n_named_slots(model: LoweredModel) -> int:
    """Return the number of leading slots of p, which hold parameters, inputs and discrete variables."""
    return max((place for store, place in model.slots.values() if store == "p"), default=-1) + 1
