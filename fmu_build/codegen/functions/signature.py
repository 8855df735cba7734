"""The signature of the C function of a Modelica function."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FunctionSignature:
    """A C function that takes scalars as ``double`` and arrays as ``const double *``, in row-major order.

    `inputs` holds the number of elements of each array input, None for a scalar. A function with one scalar
    result and no assertions returns it; others store all results contiguously in their last argument.
    """

    name: str
    inputs: tuple[int | None, ...]
    n_results: int
    returns_value: bool

    @property
    def tangent(self) -> FunctionSignature:
        """The signature of the function that maps inputs and their tangents to tangents of results."""
        return FunctionSignature(f"d{self.name}", self.inputs * 2, self.n_results, self.returns_value)

    def call(self, arguments: Sequence[str], results: str = "") -> str:
        """Return the C text of a call; `results` names the array for results that are not returned."""
        return f"{self.name}({', '.join(filter(None, (*arguments, results)))})"
