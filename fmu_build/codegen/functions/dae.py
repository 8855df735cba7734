"""The expressions of the DAE as one function sees them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.support.errors import UnsupportedModelError

_TYPES = ("real", "integer", "boolean", "enumeration")


Operation = Mapping[str, Any]
"""The operation of a DAE expression: its kind and its operands."""


class FunctionDae:
    """Looks up expressions, types and loops by id; rejects what is not supported in `function`."""

    def __init__(self, model: LoweredModel, function: Mapping[str, Any]) -> None:
        self._model = model
        self._function = function
        self.by_id: dict[int, dict[str, Any]] = {entry["id"]: entry for entry in model.dae["expressions"]}
        self.functions: dict[int, dict[str, Any]] = {entry["id"]: entry for entry in model.dae["functions"]}
        self._domains = {domain["id"]: domain["domain"]["binders"] for domain in model.dae["domains"]}
        self._types = [entry["value_type"] for entry in model.dae["value_types"]]

    def operation(self, number: int) -> dict[str, Any]:
        """Return the operation of the expression with this id."""
        operation: dict[str, Any] = self.by_id[number]["operation"]
        return operation

    def dimensions(self, number: int) -> tuple[int, ...]:
        """Return the array sizes of an expression; empty for a scalar."""
        return tuple(self.by_id[number]["value_type"]["dimensions"])

    def size(self, number: int) -> int:
        """Return the number of scalars of an expression."""
        return math.prod(self.dimensions(number))

    def dimensions_of_type(self, kind: int) -> tuple[int, ...]:
        """Return the array sizes of a type."""
        return tuple(self._types[kind]["dimensions"])

    def loops(self, domain: int) -> list[dict[str, Any]]:
        """Return the loops of a domain: name, and first value, last value and step as numbers."""
        binders: list[dict[str, Any]] = self._domains[domain]
        return binders

    def is_generated(self, number: int) -> bool:
        """Return whether rumoca has generated a conditional expression from an if-statement."""
        origin = self.by_id[number]["provenance"]["origin"]
        return bool(origin == {"generated": "function_condition_lowering"})

    def declared_dimensions(self, declared: Mapping[str, Any]) -> tuple[int, ...]:
        """Return the array sizes of a parameter or variable.

        Raises `UnsupportedModelError` for records, strings and empty arrays.
        """
        kind = self._types[declared["value_type"]]
        dimensions = tuple(kind["dimensions"])
        if kind["scalar"] not in _TYPES:
            raise self.unsupported(f"the {kind['scalar']} {declared['name']}", declared["declaration"])
        if 0 in dimensions:
            raise self.unsupported(f"the array {declared['name']} of size zero", declared["declaration"])
        return dimensions

    def unsupported(self, what: str, where: Mapping[str, Any] | int | None = None) -> UnsupportedModelError:
        """Return the error for an unsupported construct at an expression or a provenance of the DAE."""
        provenance = self.by_id[where]["provenance"] if isinstance(where, int) else where
        span = (provenance or self._function["declaration"])["span"]
        return self._model.unsupported(f"{what} in function {self._function['name']} is not supported", span)
