"""Write the C file of a model for the runtime's model.h."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, NewtonBlock, Step, in_order, needed
from fmu_build.codegen.c_expression import Writer
from fmu_build.codegen.c_function import FunctionBody, c_function, c_string, message_call
from fmu_build.codegen.c_tables import tables
from fmu_build.codegen.c_tangents import tangent_functions
from fmu_build.codegen.equations import Equations, watched_conditions, written_slots
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.functions import FunctionSources
from fmu_build.codegen.half_angle import SOURCES as HALF_ANGLES, from_half
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.names import modelica_texts, slot_names
from fmu_build.codegen.right_hand_side import RightHandSide, arrange, with_parts
from fmu_build.codegen.start_values import StartValues
from fmu_build.codegen.tangents import Tangents
from fmu_build.codegen.variables import StoredVariable, nominals

_HELPERS = {
    "sign": "static double sign(double a) { return (a > 0.0) - (a < 0.0); }",
    **HALF_ANGLES,
}


def write_model(
    model: LoweredModel,
    equations: Equations,
    variables: Sequence[StoredVariable],
    starts: StartValues,
    functions: FunctionSources,
    tangents: Tangents | None,
) -> str:
    """Return C11 source that defines all of model.h; without `tangents`, its tangent functions are empty."""
    inputs = {s.index for s in variables if s.store == "p" and s.variable.causality == "input"}
    side = arrange(equations, inputs | written_slots(equations))
    equations = with_parts(equations, side.parts)
    names = slot_names(model, equations, side.parts)
    texts = modelica_texts(model, equations)
    sizes = nominals(model)
    code = _Code(equations, side, names, functions, texts, sizes)
    derivatives = code.tangents(tangents)
    equations_code = [*code.blocks(), *code.functions()]
    read_first = functions.tangents_for("\n".join(equations_code))
    others = [each for each in functions.tangents_for("\n".join(derivatives)) if each not in read_first]
    body = [*read_first, *equations_code, *others, *derivatives]
    helpers = [
        source
        for name, source in _HELPERS.items()
        if any(re.search(rf"\b{name}\(", part) for part in (functions.source, *body))
    ]
    parts = [
        f"/* {model.name}: generated from Modelica; edit the Modelica source instead. */",
        '#include "model.h"',
        '#include "block.h"',
        '#include "token.h"',
        "",
        "#include <math.h>",
        "#include <stdio.h>",
        "",
        _enumeration(names, "y"),
        _enumeration(names, "p"),
        *(f"{source}\n" for source in helpers),
        *([functions.source] if functions.source else []),
        *body,
        tables(model, equations, variables, starts, names, texts, sizes, tangents),
    ]
    return "\n".join(parts)


def _enumeration(names: Mapping[Slot, str], store: str) -> str:
    members = [name for (kind, _), name in sorted(names.items(), key=lambda item: item[0]) if kind == store]
    if not members:
        return ""
    return "enum {\n" + "".join(f"    {name},\n" for name in members) + "};\n"


class _Code:
    """Writes the functions of one model."""

    def __init__(
        self,
        equations: Equations,
        side: RightHandSide,
        names: Mapping[Slot, str],
        functions: FunctionSources,
        texts: Writer,
        nominals: Mapping[int, float],
    ) -> None:
        self._texts = texts
        self._nominals = nominals
        self._equations = equations
        self._side = side
        self._names = names
        self._signatures = functions.signatures
        blocks = [step for step in equations.algebraics if isinstance(step, NewtonBlock)]
        self._halves = from_half(
            [*_parts(equations.algebraics), *equations.derivatives, *equations.relations.roots]
        )
        self._block_names = {block: f"block_{number}" for number, block in enumerate(blocks)}
        self._parts = {part: ex.p(slot) for part, slot in side.parts.items()}

    def _body(
        self, expressions: Iterable[Expression], known: Mapping[Expression, Expression] | None = None
    ) -> FunctionBody:
        known = self._parts if known is None else known
        return FunctionBody(self._names, self._signatures, expressions, self._halves, known)

    def blocks(self) -> list[str]:
        """Return residual, Jacobian and table of each algebraic loop that Newton's method solves."""
        parts = []
        for block, name in self._block_names.items():
            signature = (
                f"static void {name}_{{}}(double time, const double *y, const double *p, double *{{}})"
            )
            entries = [entry for row in block.jacobian for entry in row]
            for what, values in (("residual", block.residuals), ("jacobian", entries)):
                parts.append(c_function(signature.format(what, what), self._stores(what, values)))
            unknowns = "".join(
                f"    {{{self._names['y', index]}, {c_string(_shown(self._texts.text(ex.y(index))))}, "
                f"{self._nominals.get(index, 1.0)!r}}},\n"
                for index in block.unknowns
            )
            parts.append(
                f"static const BlockUnknown {name}_unknowns[] = {{\n{unknowns}}};\n"
                f"static const Block {name} = {{{len(block.unknowns)}, {name}_unknowns, "
                f"{'true' if block.is_linear else 'false'}, {name}_residual, {name}_jacobian}};\n"
            )
        return parts

    def functions(self) -> list[str]:
        """Return the functions that model.h declares, in the same order."""
        e = self._equations
        read_y = "double time, const double *y, const double *p"
        return [
            self._derivatives(),
            self._algebraics(),
            self._evaluation("model_roots", "double *root", e.relations.roots, "root"),
            c_function(
                "void model_time_relations(double time, const double *p, double *root)",
                self._stores("root", e.relations.time_roots),
            ),
            c_function("void model_dependent_parameters(double *p)", self._dependent_parameters()),
            c_function("void model_start_values(double time, double *y, double *p)", self._start_values()),
            c_function(
                f"void model_initial_residual({read_y}, double *residual)",
                self._stores("residual", e.initial_residuals),
            ),
            self._watched_actions(),
            c_function(
                f"void model_discrete({read_y}, double *value)",
                self._stores("value", [row.value for row in e.discrete]),
            ),
            c_function(
                "void model_time_events(const double *p, double *when)",
                self._stores("when", e.relations.event_times),
            ),
            c_function(
                f"void model_actions({read_y}, bool *active)",
                self._stores("active", [action.condition for action in e.actions], as_truth=True),
            ),
            c_function(
                f"void model_action_message(size_t action, {read_y}, char *text, size_t size)",
                self._messages(),
            ),
            *self._root_rates(),
        ]

    def _root_rates(self) -> list[str]:
        """Return the function for the table of sensitivities, or nothing if the model has none."""
        found = self._equations.sensitivities
        if found is None:
            return []
        code = self._evaluation("root_rates", "double *rate", found.root_rates, "rate")
        return [f"static {code}"]

    def tangents(self, tangents: Tangents | None) -> list[str]:
        """Return the directional derivatives; these functions expect up-to-date algebraic variables in y."""
        steps = [step for step in self._equations.algebraics if isinstance(step, Assignment)]
        computed = {step.value: ex.y(step.unknown) for step in reversed(steps) if step.value.arguments}

        def body(expressions: Iterable[Expression]) -> FunctionBody:
            return self._body(expressions, known=computed | self._parts)

        return tangent_functions(tangents, self._names, self._block_names, body, self._body)

    def _stores(self, array: str, values: Sequence[Expression], as_truth: bool = False) -> list[str]:
        body = self._body(values)
        self._store(body, array, values, as_truth)
        return body.lines

    def _store(self, body: FunctionBody, array: str, values: Sequence[Expression], as_truth: bool) -> None:
        for number, value in enumerate(values):
            text = body.value(value)
            body.lines.append(f"{array}[{number}] = {f'({text}) != 0.0' if as_truth else text};")

    def _evaluation(
        self, name: str, output: str, values: Sequence[Expression], array: str, as_truth: bool = False
    ) -> str:
        """Return a function that computes the algebraic variables it needs, then its values."""
        steps = needed(self._equations.algebraics, values)
        in_blocks = _read_by_blocks(steps)
        body = self._body([*_parts(steps), *values])
        body.steps(steps, self._block_names, stored=lambda unknown: unknown in in_blocks)
        self._store(body, array, values, as_truth)
        body.lines.append("return true;")
        return c_function(f"bool {name}(double time, double *y, const double *p, {output})", body.lines)

    def _derivatives(self) -> str:
        """Return `model_derivatives`, with optional roots, which need mostly the same algebraic variables."""
        side, roots = self._side, self._equations.relations.roots
        steps = (*side.for_derivatives, *side.for_roots)
        in_blocks = _read_by_blocks(steps)
        body = self._body([*_parts(steps), *side.derivatives, *roots])
        body.steps(side.for_derivatives, self._block_names, stored=lambda unknown: unknown in in_blocks)
        self._store(body, "der", side.derivatives, as_truth=False)
        if roots:
            before, body.lines = body.lines, []
            body.steps(side.for_roots, self._block_names, stored=lambda unknown: unknown in in_blocks)
            self._store(body, "root", roots, as_truth=False)
            body.lines = [*before, "if (root != NULL) {", *(f"    {line}" for line in body.lines), "}"]
        body.lines.append("return true;")
        parameters = "double time, double *y, const double *p, double *der, double *root"
        return c_function(f"bool model_derivatives({parameters})", body.lines)

    def _watched_actions(self) -> str:
        conditions = watched_conditions(self._equations)
        due = reduce(lambda a, b: ex.binary("Or", a, b), conditions, ex.ZERO)
        return self._evaluation("model_watched_actions", "bool *due", [due], "due", as_truth=True)

    def _algebraics(self) -> str:
        steps = self._equations.algebraics
        body = self._body(_parts(steps))
        body.steps(steps, self._block_names, stored=lambda unknown: True)
        body.lines.append("return true;")
        return c_function("bool model_algebraics(double time, double *y, const double *p)", body.lines)

    def _dependent_parameters(self) -> list[str]:
        """Assign parameters in topological order: later ones read earlier ones from p."""
        rows = in_order(self._equations.dependent_parameters)
        return self._sequence((("p", index), value) for index, value in rows)

    def _start_values(self) -> list[str]:
        return self._sequence((*self._equations.start_values, *self._equations.guesses))

    def _sequence(self, rows: Iterable[tuple[Slot, Expression]]) -> list[str]:
        lines: list[str] = []
        for slot, value in rows:
            body = self._body([value], known={})
            text = body.value(value)
            assignment = f"{slot[0]}[{self._names[slot]}] = {text};"
            lines += (
                ["{", *(f"    {line}" for line in (*body.lines, assignment)), "}"]
                if body.lines
                else [assignment]
            )
        return lines

    def _messages(self) -> list[str]:
        lines = ["switch (action) {"]
        for number, action in enumerate(self._equations.actions):
            call, body = message_call(
                action, self._body([part[1] for part in action.message if not isinstance(part, str)])
            )
            lines += [f"case {number}: {{", *(f"    {line}" for line in (*body, call, "break;")), "}"]
        return (
            [*lines, "default:", "    text[0] = '\\0';", "}"]
            if self._equations.actions
            else ["if (size > 0) text[0] = '\\0';"]
        )


def _shown(name: str) -> str:
    """The name of an unknown in messages; rumoca writes ``$derivative.x`` for ``der(x)``."""
    return f"der({state})" if (state := name.removeprefix("$derivative.")) != name else name


def _parts(steps: Iterable[Step]) -> list[Expression]:
    return [e for step in steps if not isinstance(step, NewtonBlock) for e in step.expressions]


def _read_by_blocks(steps: Iterable[Step]) -> set[int]:
    return ex.places("y", *(e for step in steps if isinstance(step, NewtonBlock) for e in step.expressions))
