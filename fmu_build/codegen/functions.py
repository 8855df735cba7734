"""Modelica functions as C functions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fmu_build.codegen.lowered import LoweredModel


@dataclass(frozen=True, slots=True)
class FunctionSources:
    """The Modelica functions of a model as C, and how many scalars each returns."""

    source: str = ""
    result_counts: Mapping[str, int] = field(default_factory=dict)


class FunctionLibrary:
    """The functions that the equations of one model call."""

    def __init__(self, model: LoweredModel) -> None:
        self._model = model

    def name_of(self, site: Mapping[str, Any], span: dict[str, int] | None) -> str:
        """The C function for a call site of the Solve IR in an equation at `span`."""
        raise self._model.refuse("a call of a function that is not inlined is not supported", span)

    def sources(self) -> FunctionSources:
        """C source of the functions that `name_of` was asked for, and of those that they call."""
        return FunctionSources()
