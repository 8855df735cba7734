"""Positions in arrays as affine functions of loop variables, such as ``3*i + j - 4``."""

from __future__ import annotations

from dataclasses import dataclass

from fmu_build.codegen.expression import Expression


@dataclass(frozen=True, slots=True)
class LoopVariable:
    """An int of the C code with its smallest and its largest value."""

    name: str
    minimum: int
    maximum: int


@dataclass(frozen=True, slots=True)
class Index:
    """``constant + sum of factor * loop variable``; zero-based if it is a position."""

    constant: int
    terms: tuple[tuple[LoopVariable, int], ...] = ()

    @staticmethod
    def of(variable: LoopVariable) -> Index:
        """Return the index equal to a loop variable."""
        return Index(0, ((variable, 1),))

    @property
    def is_constant(self) -> bool:
        """Whether the value is independent of loop variables."""
        return not self.terms

    def __add__(self, other: Index | int) -> Index:
        if isinstance(other, int):
            return Index(self.constant + other, self.terms)
        factors = dict(self.terms)
        for variable, factor in other.terms:
            factors[variable] = factors.get(variable, 0) + factor
        terms = tuple((variable, factor) for variable, factor in factors.items() if factor)
        return Index(self.constant + other.constant, terms)

    def __mul__(self, factor: int) -> Index:
        return Index(
            self.constant * factor, tuple((variable, f * factor) for variable, f in self.terms if factor)
        )

    def lies_in(self, size: int) -> bool:
        """Return whether the value is in 0 ... size - 1 for all values of the loop variables."""
        ends = [(f * v.minimum, f * v.maximum) for v, f in self.terms]
        lowest = self.constant + sum(min(pair) for pair in ends)
        highest = self.constant + sum(max(pair) for pair in ends)
        return lowest >= 0 and highest < size

    def text(self) -> str:
        """Return the C expression, of type int."""
        text = ""
        for variable, factor in self.terms:
            sign = " - " if factor < 0 else " + "
            magnitude = variable.name if abs(factor) == 1 else f"{abs(factor)} * {variable.name}"
            text = f"{text}{sign}{magnitude}" if text else f"{'-' if factor < 0 else ''}{magnitude}"
        if not text:
            return str(self.constant)
        if self.constant:
            text += f" {'-' if self.constant < 0 else '+'} {abs(self.constant)}"
        return text


Position = Index | Expression
"""The position of an element: a zero-based `Index` inside the bounds or, if it is known only at run time, a
one-based expression, as in Modelica."""


def flat(positions: tuple[Index, ...], dimensions: tuple[int, ...]) -> Index:
    """Return the row-major offset of an element."""
    result = Index(0)
    for position, dimension in zip(positions, dimensions, strict=True):
        result = result * dimension + position
    return result


def positions(dimensions: tuple[int, ...]) -> list[tuple[Index, ...]]:
    """Return every position in an array in row-major order."""
    found: list[tuple[Index, ...]] = [()]
    for dimension in dimensions:
        found = [(*position, Index(i)) for position in found for i in range(dimension)]
    return found
