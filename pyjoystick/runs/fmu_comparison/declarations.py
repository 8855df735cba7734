"""Comparison of two FMUs' declarations: common variables, others, and different attributes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from pyjoystick.fmu import INTEGERS, FmuDescription, Variable

# Tools write decimal fractions with 15 to 17 digits.
_SAME_NUMBER = 1e-12


@dataclass(frozen=True, slots=True)
class AttributeDifference:
    """An attribute that two FMUs declare differently for a variable; empty if not declared.

    Attributes:
        variable: name of the variable
        attribute: ``type``, ``unit``, ``causality``, ``start``, ``min`` or ``max``
        first, second: values in the FMUs
    """

    variable: str
    attribute: str
    first: str
    second: str


@dataclass(frozen=True, slots=True)
class Declarations:
    """Comparison of the variables of two FMUs, each group in the order of the FMU it comes from.

    Attributes:
        shared: names of common variables
        only_first, only_second: names of inputs, outputs and parameters in only one FMU
        internal_only_first, internal_only_second: the same for local variables and calculated parameters,
            which depend on the tool
        differences: differing attributes of shared variables
    """

    shared: tuple[str, ...]
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]
    internal_only_first: tuple[str, ...]
    internal_only_second: tuple[str, ...]
    differences: tuple[AttributeDifference, ...]


def compare_declarations(first: FmuDescription, second: FmuDescription) -> Declarations:
    """Compare the variables of two FMUs."""
    shared = tuple(name for name in first.variables if name in second.variables)
    only_first = tuple(_alone(first, second, internal=False))
    only_second = tuple(_alone(second, first, internal=False))
    differences = tuple(
        difference
        for name in shared
        for difference in _differences(first.variables[name], second.variables[name])
    )
    internal = tuple(_alone(first, second, internal=True)), tuple(_alone(second, first, internal=True))
    return Declarations(shared, only_first, only_second, *internal, differences)


def _alone(one: FmuDescription, other: FmuDescription, *, internal: bool) -> Iterator[str]:
    for name, variable in one.variables.items():
        # Tools may or may not list time among the variables.
        if name in other.variables or variable.causality == "independent":
            continue
        if _is_internal(variable) is internal:
            yield name


def _differences(first: Variable, second: Variable) -> Iterator[AttributeDifference]:
    pairs = {
        "type": (first.type, second.type),
        "unit": (first.unit, second.unit),
        "min": (_text(first.minimum), _text(second.minimum)),
        "max": (_text(first.maximum), _text(second.maximum)),
    }
    if not (_is_internal(first) and _is_internal(second)):
        pairs["causality"] = (first.causality, second.causality)
    # Other start values are only guesses or results.
    if all(one.settable_at_start or one.causality == "input" for one in (first, second)):
        pairs["start"] = (first.start or "", second.start or "")
    for attribute, (mine, others) in pairs.items():
        if not _same(mine, others, first.type):
            yield AttributeDifference(first.name, attribute, mine, others)


def _is_internal(variable: Variable) -> bool:
    return variable.causality in ("local", "calculatedParameter")


def _text(bound: float | None) -> str:
    return "" if bound is None else repr(bound)


def _same(first: str, second: str, kind: str) -> bool:
    if first == second:
        return True
    if kind == "Boolean":
        true = ("true", "1")
        return bool(first) and bool(second) and (first in true) == (second in true)
    try:
        if kind in INTEGERS:
            return int(first) == int(second)
        return math.isclose(float(first), float(second), rel_tol=_SAME_NUMBER)
    except ValueError:
        return False
