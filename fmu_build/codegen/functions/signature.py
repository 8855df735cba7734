"""How the C function of a Modelica function is called."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FunctionSignature:
    """Scalars are passed as ``double``, arrays as ``const double *``, element by element in row-major order.

    `inputs` has the number of elements of every array input, None for a scalar. A function with one scalar
    result returns it. Others store all results, one behind the other, in the array that they get as last
    argument.
    """

    name: str
    inputs: tuple[int | None, ...]
    n_results: int
    returns_value: bool

    @property
    def tangent(self) -> FunctionSignature:
        """The function from the inputs and, after them, their tangents to the tangents of the results."""
        return FunctionSignature(f"d{self.name}", self.inputs * 2, self.n_results, self.returns_value)

    def call(self, arguments: Sequence[str], results: str = "") -> str:
        """The C text of a call; `results` is the array for the results of a function that returns none."""
        return f"{self.name}({', '.join(filter(None, (*arguments, results)))})"
