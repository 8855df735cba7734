"""Read register programs of the Solve IR as expressions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, MutableMapping, Sequence
from functools import reduce
from itertools import product
from typing import Any

from fmu_build.codegen import expression as ex
from fmu_build.codegen.expression import ONE, ZERO, Expression, binary
from fmu_build.codegen.lowered import LoweredModel

Operation = Mapping[str, Any]
Span = dict[str, int]
FunctionNames = Callable[[Mapping[str, Any], Span | None], str]
"""Maps a call site of the IR, and the span of its equation, to the name of the C function."""
Fields = Mapping[str, Any]
Registers = MutableMapping[int, Expression]


class ProgramReader:
    """Converts the programs of one model to expressions; raises an error for unknown operations."""

    def __init__(self, model: LoweredModel, function_name: FunctionNames) -> None:
        self._model = model
        self._function_name = function_name

    def read_rows(self, table: Mapping[str, Any]) -> dict[int, Expression]:
        """Return the outputs of a table (``programs`` and ``output_indices``) by output index."""
        spans = table.get("program_spans") or [None] * len(table["programs"])
        rows: dict[int, Expression] = {}
        position = 0
        for program, span in zip(table["programs"], spans, strict=True):
            for value in self.read(program, span):
                rows[table["output_indices"][position]] = value
                position += 1
        return rows

    def read(self, program: Sequence[Operation], span: Span | None = None) -> list[Expression]:
        """Return the outputs of one program in the order in which it stores them."""
        registers: dict[int, Expression] = {}
        outputs: list[Expression] = []
        self._run(program, registers, outputs, span)
        return outputs

    def _run(
        self,
        program: Sequence[Operation],
        registers: dict[int, Expression],
        outputs: list[Expression],
        span: Span | None,
    ) -> None:
        for operation in program:
            ((kind, fields),) = operation.items()
            match kind:
                case "StoreOutput":
                    outputs.append(registers[fields["src"]])
                case "StoreOutputRange":
                    outputs.extend(
                        registers[fields["start"] + i * fields["stride"]] for i in range(fields["count"])
                    )
                case "Move":
                    registers[fields["dst"]] = registers[fields["src"]]
                case "LoadIndexedRegister":
                    registers[fields["dst"]] = _element(fields, registers)
                case _ if kind in _TENSOR_OPERATIONS:
                    if fields.get("lanes", 1) != 1 or fields.get("input", "P") not in ("Y", "P"):
                        raise self._model.unsupported(f"this form of operation {kind} is not supported", span)
                    _TENSOR_OPERATIONS[kind](fields, registers)
                case "FunctionConditional":
                    self._conditional(fields, registers, span)
                case "PureCall":
                    self._call(fields, registers, span)
                case _:
                    registers[fields["dst"]] = self._scalar(kind, fields, registers, span)

    def _scalar(
        self, kind: str, fields: Mapping[str, Any], registers: Mapping[int, Expression], span: Span | None
    ) -> Expression:
        match kind:
            case "Const":
                return ex.number(fields["value"])
            case "LoadTime":
                return ex.TIME
            case "LoadY":
                return ex.y(fields["index"])
            case "LoadP":
                return ex.p(fields["index"])
            case "Unary" if fields["op"] in ex.UNARY:
                return ex.unary(fields["op"], registers[fields["arg"]])
            case "Binary" if fields["op"] in ex.BINARY:
                return ex.binary(fields["op"], registers[fields["lhs"]], registers[fields["rhs"]])
            case "Compare" if fields["op"] in ex.COMPARE:
                return Expression(fields["op"], (registers[fields["lhs"]], registers[fields["rhs"]]))
            case "Select":
                return ex.select(*(registers[fields[name]] for name in ("cond", "if_true", "if_false")))
        raise self._model.unsupported(_refusal(kind, fields), span)

    def _conditional(
        self, fields: Mapping[str, Any], registers: dict[int, Expression], span: Span | None
    ) -> None:
        """Read a chain of guarded alternatives (a lowered when-clause) as nested selects, one per result."""
        chain = fields["program"]
        start = fields["capture_start"]
        captures = {i: registers[start + i] for i in range(chain["capture_count"])}

        def part(program: Sequence[Operation]) -> list[Expression]:
            outputs: list[Expression] = []
            self._run(program, dict(captures), outputs, span)
            return outputs

        results = part(chain["fallback"])
        for arm in reversed(chain["arms"]):
            (condition,) = part(arm["condition"])
            results = [
                ex.select(condition, value, other)
                for value, other in zip(part(arm["result"]), results, strict=True)
            ]
        for i, result in enumerate(results):
            registers[fields["dst_start"] + i] = result

    def _call(self, fields: Mapping[str, Any], registers: dict[int, Expression], span: Span | None) -> None:
        site = fields["site"]
        arguments = tuple(
            registers[start + i]
            for start, value in zip(fields["input_starts"], site["inputs"], strict=True)
            for i in range(value["scalar_count"])
        )
        name = self._function_name(site, span)
        result = 0
        for output in site["outputs"]:
            for _ in range(output["value_type"]["scalar_count"]):
                registers[fields["dst_start"] + result] = Expression("call", arguments, (name, result))
                result += 1


def _refusal(kind: str, fields: Fields) -> str:
    """Describe an operation in Modelica's terms if they are known."""
    if kind.startswith("Table"):
        return "tables (CombiTable1Ds, CombiTimeTable) are not supported"
    if kind == "LinearSolveComponent":
        return (
            "equations that determine several derivatives together, such as der(x) + der(y) = 1 and "
            "der(x) - der(y) = 0, are not supported; write v = der(x) and w = der(y), and use v and w in them"
        )
    if "Function" in kind:
        return (
            "a function called here combines a loop, a sum() or the like with if-statements in a way that is "
            "not supported; write out the loop or the sum"
        )
    detail = f" {fields['op']}" if "op" in fields else ""
    return f"operation {kind}{detail} of the Solve IR is not supported"


# Operations on ranges of registers, expanded element by element.


def _load(fields: Fields, registers: Registers) -> None:
    """Load a range of y or p."""
    leaf = ex.y if fields["input"] == "Y" else ex.p
    for i in range(fields["count"]):
        registers[fields["dst_start"] + i] = leaf(fields["input_start"] + i)


def _elementwise(fields: Fields, registers: Registers) -> None:
    """Apply an operator to two arrays, or to an array and a scalar (stride 0)."""
    for i in range(fields["count"]):
        a = registers[fields["lhs_start"] + i * fields["lhs_stride"]]
        b = registers[fields["rhs_start"] + i * fields["rhs_stride"]]
        registers[fields["dst_start"] + i] = binary(fields["op"], a, b)


def _matrix_product(fields: Fields, registers: Registers) -> None:
    """Multiply two row-major matrices, rows by inner and inner by columns."""
    rows, inner, columns = fields["rows"], fields["inner"], fields["columns"]
    for i, j in product(range(rows), range(columns)):
        terms = (
            binary(
                "Mul",
                registers[fields["lhs_start"] + i * inner + k],
                registers[fields["rhs_start"] + k * columns + j],
            )
            for k in range(inner)
        )
        registers[fields["dst_start"] + i * columns + j] = reduce(
            lambda total, term: binary("Add", total, term), terms, ZERO
        )


def _transposed(fields: Fields, registers: Registers) -> None:
    """Transpose a row-major matrix whose elements have `element_width` scalars, to the shape in `fields`."""
    rows, columns, width = fields["rows"], fields["columns"], fields["element_width"]
    for i, j, k in product(range(rows), range(columns), range(width)):
        source = fields["src_start"] + (j * rows + i) * width + k
        registers[fields["dst_start"] + (i * columns + j) * width + k] = registers[source]


def _crossed(fields: Fields, registers: Registers) -> None:
    """Evaluate ``cross(a, b)`` of vectors with three elements."""
    a, b = ([registers[fields[side] + i] for i in range(3)] for side in ("lhs_start", "rhs_start"))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        registers[fields["dst_start"] + i] = binary(
            "Sub", binary("Mul", a[j], b[k]), binary("Mul", a[k], b[j])
        )


def _filled(fields: Fields, registers: Registers) -> None:
    """Evaluate ``fill(value, ...)``."""
    for i in range(fields["count"]):
        registers[fields["dst_start"] + i] = registers[fields["value_start"]]


def _identity(fields: Fields, registers: Registers) -> None:
    """Evaluate ``identity(size)``, row by row."""
    size = fields["size"]
    for row, column in product(range(size), repeat=2):
        registers[fields["dst_start"] + row * size + column] = ONE if row == column else ZERO


def _concatenated(fields: Fields, registers: Registers) -> None:
    """Evaluate ``cat(axis + 1, ...)`` of row-major arrays."""
    axis = fields["axis"]
    outer = math.prod(fields["dimensions"][:axis])
    position = fields["dst_start"]
    for i in range(outer):
        for source in fields["sources"]:
            length = math.prod(source["dimensions"][axis:])
            for k in range(length):
                registers[position] = registers[source["start"] + i * length + k]
                position += 1


def _element(fields: Fields, registers: Registers) -> Expression:
    """Return ``array[i, j, ...]``; NaN if an index that is known only at run time is out of bounds."""
    chosen = ex.number(math.nan)
    places = product(*(range(size) for size in fields["dimensions"]))
    for offset, place in reversed(list(enumerate(places))):
        here: Expression = ONE
        for index, position in zip(fields["indices"], place, strict=True):
            here = binary("And", here, _is_at(index, position, registers))
        chosen = ex.select(here, registers[fields["base"] + offset * fields["stride"]], chosen)
    return chosen


def _is_at(index: Fields, position: int, registers: Registers) -> Expression:
    """Return whether an index equals a zero-based position; run-time indices are one-based."""
    ((kind, value),) = index.items()
    if kind == "Runtime":
        return Expression("Eq", (registers[value], ex.number(position + 1)))
    return ONE if value == position else ZERO


_TENSOR_OPERATIONS: dict[str, Callable[[Fields, Registers], None]] = {
    "TensorLoad": _load,
    "TensorBinary": _elementwise,
    "MatrixMultiply": _matrix_product,
    "TensorTranspose": _transposed,
    "TensorCross": _crossed,
    "TensorFill": _filled,
    "TensorIdentity": _identity,
    "TensorConcatenate": _concatenated,
}
