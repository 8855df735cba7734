"""Extend a model with the sensitivities of its solution: derivatives by parameters, exact through events."""

from fmu_build.codegen.sensitivities.extension import Extended, extend
from fmu_build.codegen.sensitivities.wanted import Wanted, find_wanted

__all__ = ["Extended", "Wanted", "extend", "find_wanted"]
