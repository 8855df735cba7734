"""The expressions of the DAE as one function sees them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.support.errors import UnsupportedModelError

_TYPES = ("real", "integer", "boolean", "enumeration")


Operation = Mapping[str, Any]
"""What an expression of the DAE does: its kind and what it applies to."""


class FunctionDae:
    """Looks up expressions, types and loops by their ids, and refuses what `function` may not have."""

    def __init__(self, model: LoweredModel, function: Mapping[str, Any]) -> None:
        self._model = model
        self._function = function
        self.by_id: dict[int, dict[str, Any]] = {entry["id"]: entry for entry in model.dae["expressions"]}
        self.functions: dict[int, dict[str, Any]] = {entry["id"]: entry for entry in model.dae["functions"]}
        self._domains = {domain["id"]: domain["domain"]["binders"] for domain in model.dae["domains"]}
        self._types = [entry["value_type"] for entry in model.dae["value_types"]]

    def operation(self, number: int) -> dict[str, Any]:
        """What the expression with this id does."""
        operation: dict[str, Any] = self.by_id[number]["operation"]
        return operation

    def dimensions(self, number: int) -> tuple[int, ...]:
        """The array sizes of an expression, empty for a scalar."""
        return tuple(self.by_id[number]["value_type"]["dimensions"])

    def size(self, number: int) -> int:
        """How many scalars an expression has."""
        return math.prod(self.dimensions(number))

    def dimensions_of_type(self, kind: int) -> tuple[int, ...]:
        """The array sizes of a type."""
        return tuple(self._types[kind]["dimensions"])

    def loops(self, domain: int) -> list[dict[str, Any]]:
        """The loops of a domain: name, first and last value and step, which are all numbers."""
        binders: list[dict[str, Any]] = self._domains[domain]
        return binders

    def is_generated(self, number: int) -> bool:
        """Whether rumoca made a conditional expression from an if-statement."""
        origin = self.by_id[number]["provenance"]["origin"]
        return bool(origin == {"generated": "function_condition_lowering"})

    def declared_dimensions(self, declared: Mapping[str, Any]) -> tuple[int, ...]:
        """The array sizes of a parameter or variable; refuses records, strings and empty arrays."""
        kind = self._types[declared["value_type"]]
        dimensions = tuple(kind["dimensions"])
        if kind["scalar"] not in _TYPES:
            raise self.unsupported(f"the {kind['scalar']} {declared['name']}", declared["declaration"])
        if 0 in dimensions:
            raise self.unsupported(f"the array {declared['name']} of size zero", declared["declaration"])
        return dimensions

    def unsupported(self, what: str, where: Mapping[str, Any] | int | None = None) -> UnsupportedModelError:
        """The error for a construct at an expression or a provenance of the DAE."""
        provenance = self.by_id[where]["provenance"] if isinstance(where, int) else where
        span = (provenance or self._function["declaration"])["span"]
        return self._model.unsupported(f"{what} in function {self._function['name']} is not supported", span)
