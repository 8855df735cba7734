"""Write the algorithm of a Modelica function as a C function.

rumoca provides algorithms in static single assignment form: every assignment is a new definition, and every
read names its definition. Here all definitions of a variable share one C variable; each read is checked
against the definition whose value the C variable holds at that point.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from fmu_build.codegen.functions.assignments import Assignment, AssignmentWriter
from fmu_build.codegen.functions.code import FunctionCode, twin
from fmu_build.codegen.functions.dae import FunctionDae
from fmu_build.codegen.functions.definitions import Statement, flattened, live_definitions, reads
from fmu_build.codegen.functions.expressions import Callees, FunctionExpressions
from fmu_build.codegen.functions.index import Index, LoopVariable, positions
from fmu_build.codegen.functions.signature import FunctionSignature
from fmu_build.codegen.lowered import LoweredModel


def write_function(
    model: LoweredModel,
    function: Mapping[str, Any],
    signature: FunctionSignature,
    callees: Callees,
    is_tangent: bool = False,
) -> str:
    """Return the C source of a function, or of the function that computes the tangents of its results.

    Raises `UnsupportedModelError` for an unsupported construct.
    """
    code = FunctionCode(with_tangents=is_tangent)
    return _FunctionWriter(FunctionDae(model, function), function, signature, callees, code).write()


class _FunctionWriter:
    def __init__(
        self,
        dae: FunctionDae,
        function: Mapping[str, Any],
        signature: FunctionSignature,
        callees: Callees,
        code: FunctionCode,
    ) -> None:
        self._dae = dae
        self._function = function
        self._signature = signature
        self._code = code
        self._expressions = FunctionExpressions(dae, self._code, callees)
        self._assignments = AssignmentWriter(dae, self._expressions, self._code)
        self._definitions = function["definitions"]
        self._live = live_definitions(function, dae.by_id)
        self._dimensions: dict[int, tuple[int, ...]] = {}
        self._records = self._record_results()
        self._declared: set[int] = set()
        self._n_stored = 0

    def write(self) -> str:
        parameters = dict(self._parameter(parameter) for parameter in self._function["parameters"])
        if self._code.with_tangents:
            parameters |= {twin(name): self._twin_parameter(text, name) for name, text in parameters.items()}
        for value in self._function["values"]:
            if value["ordinal"] in self._records:
                continue
            self._dimensions[value["ordinal"]] = self._dae.declared_dimensions(value)
            self._expressions.variables[value["ordinal"]] = self._code.name(value["name"])
        self._reject_lost_values()
        self._statements(self._function["statements"], is_outermost=True)
        self._results()
        code = self._code.lines
        body = "\n".join(code)
        unused = [f"(void){name};" for name in parameters if not re.search(rf"\b{name}\b", body)]
        lines = [f"    {line}" for line in (*unused, *code)]
        return "\n".join([self._head(list(parameters.values())), "{", *lines, "}", ""])

    def _reject_lost_values(self) -> None:
        """Raise an error if something reads a number that rumoca has put in the place of an earlier value.

        It does so where a loop assigns a variable, even if the loop does not come first.
        """
        for number in sorted(self._live):
            earlier: int | None = number
            while earlier is not None and self._is_made_up(earlier):
                earlier = self._definitions[earlier]["previous_target_definition"]
            if earlier not in (None, number):
                name = self._function["values"][self._definitions[number]["target"]]["name"]
                advice = f"assign its first value in a statement, not in the declaration of {name}"
                raise self._dae.unsupported(f"reading {name} before a loop that assigns it ({advice})")

    def _is_made_up(self, number: int) -> bool:
        """Return whether the value of a definition is a number of which the source has no trace."""
        definition = self._definitions[number]
        is_generated = definition["provenance"]["origin"] == {"generated": "function_aggregate_lowering"}
        return is_generated and not reads(self._dae.by_id, [definition["rhs"]])

    def _head(self, parameters: Sequence[str]) -> str:
        if self._signature.returns_value:
            return f"static double {self._signature.name}({', '.join(parameters) or 'void'})"
        result = f"double result[{self._signature.n_results}]"
        return f"static void {self._signature.name}({', '.join([*parameters, result])})"

    def _parameter(self, parameter: Mapping[str, Any]) -> tuple[str, str]:
        """Return the C name of a parameter and its declaration."""
        dimensions = self._dae.declared_dimensions(parameter)
        name = self._code.name(parameter["name"])
        self._expressions.parameters[parameter["ordinal"]] = name
        return name, f"const double {name}[{math.prod(dimensions)}]" if dimensions else f"double {name}"

    def _twin_parameter(self, declaration: str, name: str) -> str:
        return re.sub(rf"\b{name}\b", twin(name), declaration)

    def _statements(self, statements: Sequence[Statement], is_outermost: bool = False) -> None:
        for statement in statements:
            self._code.new_statement()
            match statement["kind"]:
                case "assignment":
                    self._group([statement["definition"]], is_outermost)
                case "assignment_group":
                    self._group([inner["definition"] for inner in statement["statements"]], is_outermost)
                case "for":
                    self._for(statement)
                case "assertion" if is_outermost:
                    place = self._signature.n_results - self._n_assertions() + self._n_stored
                    self._code.result(str(place), self._expressions.scalar(statement["condition"]))
                    self._n_stored += 1
                case kind:
                    where = statement.get("provenance", self._function["declaration"])
                    raise self._dae.unsupported(f"a statement of kind {kind} in a loop", where)

    def _group(self, definitions: Sequence[int], is_outermost: bool) -> None:
        """Write a group of assignments that all read the values from before the group."""
        live = [
            d for d in definitions if d in self._live and self._definitions[d]["target"] not in self._records
        ]
        pending = [Assignment(self._definitions[d]["target"], self._definitions[d]["rhs"]) for d in live]
        if len(pending) == 1 and is_outermost and self._is_declaration(pending[0]):
            self._declare_with_value(pending[0])
        else:
            for assignment in pending:
                self._declare(assignment.target)
            self._assignments.write(pending)
        for definition in live:
            self._expressions.current[self._definitions[definition]["target"]] = definition

    def _for(self, statement: Statement) -> None:
        """Write a loop; its fold names the definitions of the carried values before, inside and after it."""
        fold = self._function["folds"][statement["fold"]]
        inner = [s["definition"] for s in flattened(statement["statements"]) if s["kind"] == "assignment"]
        targets = [
            self._definitions[definition]["target"] for definition in inner if definition in self._live
        ]
        if not targets:
            return
        for target in targets:
            self._declare(target)
        self._carry(fold, "initial_definitions", "parameter_definitions")
        loops = self._dae.loops(fold["domain"])
        names = [self._open_loop((fold["domain"], ordinal), loop) for ordinal, loop in enumerate(loops)]
        self._statements(statement["statements"])
        for name in names:
            self._code.close()
            self._code.release(name)
        self._carry(fold, "update_definitions", "output_definitions")

    def _carry(self, fold: Mapping[str, Any], before: str, after: str) -> None:
        """Rename the definitions of carried variables, whose C variables keep their values."""
        for target, old, new in zip(fold["targets"], fold[before], fold[after], strict=True):
            if new in self._live:
                if self._expressions.current.get(target) != old:
                    raise self._dae.unsupported(
                        "a loop that starts from a variable's earlier value", fold["provenance"]
                    )
                self._expressions.current[target] = new

    def _open_loop(self, binder: tuple[int, int], loop: Mapping[str, Any]) -> str:
        lower, upper, step = loop["lower"], loop["upper"], loop["step"]
        name = self._code.name(loop["display_name"])
        variable = LoopVariable(name, min(lower, upper), max(lower, upper))
        self._expressions.subscripts.binders[binder] = Index.of(variable)
        advance = {1: f"++{name}", -1: f"--{name}"}.get(step, f"{name} += {step}")
        self._code.open(f"for (int {name} = {lower}; {name} {'<=' if step > 0 else '>='} {upper}; {advance})")
        return name

    def _is_declaration(self, assignment: Assignment) -> bool:
        """Return whether an assignment can be the initializer of its variable's declaration."""
        if assignment.target in self._declared or self._assignments.is_if(assignment):
            return False
        return not self._dimensions[assignment.target] or self._expressions.is_list(assignment.rhs)

    def _declare_with_value(self, assignment: Assignment) -> None:
        self._declared.add(assignment.target)
        name = self._expressions.variables[assignment.target]
        definitions = [d for d in self._live if self._definitions[d]["target"] == assignment.target]
        if self._dimensions[assignment.target]:
            self._code.define_array(name, self._expressions.elements(assignment.rhs), len(definitions) == 1)
        else:
            self._code.define(name, self._expressions.scalar(assignment.rhs), len(definitions) == 1)

    def _declare(self, target: int) -> None:
        if target in self._declared:
            return
        self._declared.add(target)
        dimensions = self._dimensions[target]
        self._code.declare(self._expressions.variables[target], math.prod(dimensions) if dimensions else None)

    def _n_assertions(self) -> int:
        return sum(s["kind"] == "assertion" for s in flattened(self._function["statements"]))

    def _record_results(self) -> dict[int, list[int]]:
        """Return the outputs that are records, with the expressions of their fields."""
        records = {}
        for definition in self._function["results"]:
            operation = self._dae.operation(self._definitions[definition]["rhs"])
            if operation["kind"] == "record":
                records[self._definitions[definition]["target"]] = operation["fields"]
        return records

    def _results(self) -> None:
        offset = 0
        for definition in self._function["results"]:
            target = self._definitions[definition]["target"]
            if target in self._records:
                for number in self._records[target]:
                    offset = self._store_result(number, offset)
                continue
            name = self._expressions.variables[target]
            if self._expressions.current.get(target) != definition:
                raise self._dae.unsupported(
                    f"an earlier value of {name} as result", self._function["declaration"]
                )
            if self._signature.returns_value:
                self._code.line(f"return {twin(name) if self._code.with_tangents else name};")
            else:
                offset = self._store_array(name, self._dimensions[target], offset)

    def _store_result(self, number: int, offset: int) -> int:
        """Store the elements of an expression from `offset` on; return the offset after them."""
        dimensions = self._dae.dimensions(number)
        for place, at in enumerate(positions(dimensions)):
            self._code.result(str(offset + place), self._expressions.element(number, at))
        return offset + math.prod(dimensions)

    def _store_array(self, name: str, dimensions: tuple[int, ...], offset: int) -> int:
        def store(at: tuple[Index, ...]) -> None:
            element = self._code.variable(f"{name}[{at[0].text()}]")
            self._code.result((at[0] + offset).text(), element)

        if dimensions:
            self._expressions.loops.for_each((math.prod(dimensions),), store)
        else:
            self._code.result(str(offset), self._code.variable(name))
        return offset + math.prod(dimensions)
