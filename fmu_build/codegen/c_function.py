"""Bodies of generated C functions: straight-line code with a variable for each common subexpression."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence

from fmu_build.codegen import expression as ex
from fmu_build.codegen.algebraics import Assignment, NewtonBlock, Step
from fmu_build.codegen.c_expression import Writer, shared_nodes
from fmu_build.codegen.equations import Action
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.functions import FunctionSignature
from fmu_build.codegen.half_angle import NAMES as FROM_HALF


class FunctionBody:
    """The lines of one C function, collected in order."""

    def __init__(
        self,
        slot_names: Mapping[Slot, str],
        signatures: Mapping[str, FunctionSignature],
        expressions: Iterable[Expression],
        halves: Mapping[Expression, Expression],
        known: Mapping[Expression, Expression],
    ) -> None:
        """`known` maps a value that need not be computed again to the slot that holds it."""
        self.lines: list[str] = []
        self._slot_names = slot_names
        self._signatures = signatures
        expressions = tuple(expressions)
        self._halves = halves
        self._shared = shared_nodes(expressions) | {halves[e] for e in ex.walk(*expressions) if e in halves}
        self._names = _Names(slot_names)
        self._names.update((value, self._names[leaf]) for value, leaf in known.items())
        self._writer = Writer(self._names)
        self._temporaries = 0
        self._calls: dict[tuple[str, tuple[Expression, ...]], str] = {}

    def value(self, node: Expression) -> str:
        """Return the C text of a value, after appending the lines that compute its common subexpressions."""
        self._prepare(node)
        return self._writer.text(node)

    def _prepare(self, *nodes: Expression) -> None:
        """Append the lines that compute the common subexpressions of the nodes."""
        for part in ex.walk(*nodes, closed=self._names):
            if part in self._names:
                continue
            if part.operator == "call":
                self._name_call(part)
                continue
            if part in self._halves:
                self._names[part] = f"{FROM_HALF[part.operator]}({self.value(self._halves[part])})"
            if part in self._shared:
                self._declare(part)

    def _declare(self, node: Expression) -> None:
        self._temporaries += 1
        name = f"t{self._temporaries}"
        self.lines.append(f"const double {name} = {self._writer.text(node)};")
        self._names[node] = name

    def _name_call(self, node: Expression) -> None:
        """Name a result of a Modelica function; one C call computes all its results."""
        assert isinstance(node.payload, tuple)
        function, result = node.payload
        signature = self._signatures[function]
        key = (function, node.arguments)
        if key not in self._calls:
            name = f"r{len(self._calls) + 1}"
            self._calls[key] = name
            arguments = self._arguments(signature, node.arguments)
            if signature.returns_value:
                self.lines.append(f"const double {name} = {signature.call(arguments)};")
            else:
                self.lines.append(f"double {name}[{signature.n_results}];")
                self.lines.append(f"{signature.call(arguments, name)};")
        self._names[node] = self._calls[key] if signature.returns_value else f"{self._calls[key]}[{result}]"

    def _arguments(self, signature: FunctionSignature, scalars: Sequence[Expression]) -> list[str]:
        """Return the C arguments: scalars, gathered into an array wherever the function takes one."""
        arguments = []
        rest = list(scalars)
        for size in signature.inputs:
            passed, rest = rest[: size or 1], rest[size or 1 :]
            if size is None:
                arguments.append(self._writer.text(passed[0]))
            elif _is_stretch(passed):
                arguments.append(f"&{self._writer.text(passed[0])}")
            else:
                elements = ", ".join(self._writer.text(element) for element in passed)
                arguments.append(f"(const double[]){{{elements}}}")
        return arguments

    def steps(
        self, steps: Sequence[Step], block_names: Mapping[NewtonBlock, str], stored: Callable[[int], bool]
    ) -> None:
        """Compute algebraic variables: those for which `stored` is true go into y, the others stay local."""
        for step in steps:
            if isinstance(step, NewtonBlock):
                self.lines.append(f"if (!block_solve(&{block_names[step]}, time, y, p)) return false;")
                continue
            self._assign(step, stored(step.unknown))

    def _assign(self, step: Assignment, stored: bool) -> None:
        slot = self._slot_names[("y", step.unknown)]
        local = f"v{slot[1:]}"
        value = step.value
        if value in self._names or value.operator == "call" or value in self._halves:
            text = self.value(value)
        else:
            self._prepare(*value.arguments)
            text = self._writer.text(value)
        self.lines.append(f"const double {local} = {text};")
        self._names[ex.y(step.unknown)] = local
        # Later uses of the same value read this variable instead of a new temporary.
        self._names.setdefault(value, local)
        if stored:
            self.lines.append(f"y[{slot}] = {local};")


def _is_stretch(elements: Sequence[Expression]) -> bool:
    """Return whether the elements are contiguous in p, or their tangents in dp."""
    first = elements[0]
    return first.operator in ("p", "dp") and all(
        e.operator == first.operator and e.index == first.index + i for i, e in enumerate(elements)
    )


class _Names(dict[Expression, str]):
    """Names of nodes; a slot without a local name is read from its array."""

    def __init__(self, slot_names: Mapping[Slot, str]) -> None:
        super().__init__({ex.TIME: "time", ex.DTIME: "dtime"})
        for slot, name in slot_names.items():
            self[ex.leaf(slot)] = f"{slot[0]}[{name}]"
            self[ex.tangent_leaf(slot)] = f"d{slot[0]}[{name}]"


def c_function(signature: str, lines: Sequence[str]) -> str:
    """Return a C function; parameters that its lines do not mention are marked as unused."""
    names = [
        part.replace("*", " ").split()[-1] for part in signature[signature.index("(") + 1 : -1].split(",")
    ]
    text = "\n".join(lines)
    unused = [f"(void){name};" for name in names if not _mentions(text, name)]
    return "\n".join([signature, "{", *(f"    {line}" for line in (*unused, *lines)), "}", ""])


def _mentions(text: str, name: str) -> bool:
    return re.search(rf"\b{name}\b", text) is not None


_FORMATS = {"Real": "%.6g", "Integer": "%.0f", "Enumeration": "%.0f", "Boolean": "%s"}
"""``String()`` writes a Real with six significant digits (Modelica 3.4, section 3.7.1.1)."""


def message_call(action: Action, body: FunctionBody) -> tuple[str, list[str]]:
    """Return the statement that formats the message, and the lines that must precede it."""
    text = ""
    values: list[str] = []
    for part in action.message:
        if isinstance(part, str):
            text += part.replace("%", "%%")
            continue
        kind, value = part
        text += _FORMATS.get(kind, "%.6g")
        written = body.value(value)
        values.append(f'({written}) != 0.0 ? "true" : "false"' if kind == "Boolean" else written)
    arguments = ", ".join([c_string(text), *values])
    return f"snprintf(text, size, {arguments});", body.lines


def c_string(text: str) -> str:
    """Return a C string literal of the UTF-8 text; bytes other than printable ASCII are octal escapes."""
    escaped = ""
    for byte in text.encode():
        character = chr(byte)
        if character in '"\\':
            escaped += "\\" + character
        elif 32 <= byte < 127:
            escaped += character
        else:
            escaped += f"\\{byte:03o}"
    return f'"{escaped}"'
