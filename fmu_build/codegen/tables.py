"""Refuse tables of the Modelica Standard Library that the functions in `FmuBuildTables.mo` do not cover."""

from __future__ import annotations

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.start_values import StartValues

_LINEAR, _CONSTANT = 1, 3
"""Literals of the enumeration Smoothness."""


def reject_unsupported_tables(model: LoweredModel, starts: StartValues) -> None:
    """Raise `UnsupportedModelError` for a table that is smooth in two inputs, or left in a file."""
    bindings = model.solve["layout"]["bindings"]
    variables = {variable["name"]: variable for variable in model.dae["variables"]}
    for name, variable in variables.items():
        block, _, parameter = name.rpartition(".")
        if f"{block}.tableOnFile" not in variables or parameter not in ("smoothness", "tableOnFile"):
            continue
        value = starts.of(("p", bindings[name]["P"]["index"])) if name in bindings else 0.0
        span = variable["declaration"]["span"]
        if parameter == "tableOnFile" and value and not variables[f"{block}.table"]["scalar_names"]:
            raise model.unsupported(
                f"the table of {block} is in a file that the build does not read: beside tableOnFile = true, "
                "tableName must be a string, and fileName a string or loadResource() of a string",
                span,
            )
        is_surface = f"{block}.leastStep2" in variables
        if is_surface and parameter == "smoothness" and value not in (_LINEAR, _CONSTANT):
            raise model.unsupported(
                f"the smoothness of {block} is not supported: a table with two inputs can have "
                "LinearSegments or ConstantSegments",
                span,
            )
