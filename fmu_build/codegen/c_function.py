"""Bodies of generated C functions: straight-line code with a variable for every shared part."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, NewtonBlock, Step
from fmu_build.codegen.c_expression import Writer, shared_nodes
from fmu_build.codegen.expression import Expression, Slot


class FunctionBody:
    """Collects the lines of one function."""

    def __init__(
        self,
        slot_names: Mapping[Slot, str],
        result_counts: Mapping[str, int],
        expressions: Iterable[Expression],
    ) -> None:
        self.lines: list[str] = []
        self._slot_names = slot_names
        self._result_counts = result_counts
        self._shared = shared_nodes(expressions)
        self._names = _Names(slot_names)
        self._writer = Writer(self._names)
        self._temporaries = 0
        self._calls: dict[tuple[str, tuple[Expression, ...]], str] = {}

    def value(self, node: Expression) -> str:
        """The C text of a value, after the lines that compute what it shares with others."""
        for part in ex.walk(node):
            if part.operator == "call" and part not in self._names:
                self._name_call(part)
            elif part in self._shared and part not in self._names:
                self._declare(part)
        return self._writer.text(node)

    def _declare(self, node: Expression) -> None:
        self._temporaries += 1
        name = f"t{self._temporaries}"
        self.lines.append(f"const double {name} = {self._writer.text(node)};")
        self._names[node] = name

    def _name_call(self, node: Expression) -> None:
        """One C call gives all results of a Modelica function."""
        assert isinstance(node.payload, tuple)
        function, result = node.payload
        key = (function, node.arguments)
        if key not in self._calls:
            array = f"r{len(self._calls) + 1}"
            self._calls[key] = array
            arguments = ", ".join(self._writer.text(argument) for argument in node.arguments)
            self.lines.append(f"double {array}[{self._result_counts[function]}];")
            self.lines.append(f"{function}({', '.join(filter(None, (arguments, array)))});")
        self._names[node] = f"{self._calls[key]}[{result}]"

    def steps(
        self, steps: Sequence[Step], block_names: Mapping[NewtonBlock, str], stored: Callable[[int], bool]
    ) -> None:
        """Compute algebraic variables; those that are `stored` go into y, the others are local."""
        for step in steps:
            if isinstance(step, NewtonBlock):
                self.lines.append(f"if (!block_solve(&{block_names[step]}, time, y, p)) return false;")
                continue
            self._assign(step, stored(step.unknown))

    def _assign(self, step: Assignment, stored: bool) -> None:
        slot = self._slot_names[("y", step.unknown)]
        local = f"v{slot[1:]}"
        self.lines.append(f"const double {local} = {self.value(step.value)};")
        self._names[ex.y(step.unknown)] = local
        if stored:
            self.lines.append(f"y[{slot}] = {local};")


class _Names(dict[Expression, str]):
    """Names of nodes; a slot that has no local name is read from its array."""

    def __init__(self, slot_names: Mapping[Slot, str]) -> None:
        super().__init__({ex.TIME: "time"})
        for (store, index), name in slot_names.items():
            self[ex.y(index) if store == "y" else ex.p(index)] = f"{store}[{name}]"
