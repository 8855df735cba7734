"""Refuse tables of the Modelica Standard Library that the functions in `FmuBuildTables.mo` do not cover."""

from __future__ import annotations

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.start_values import StartValues

_LINEAR, _CONSTANT = 1, 3
"""Literals of the enumeration Smoothness."""


def reject_unsupported_tables(model: LoweredModel, starts: StartValues) -> None:
    """Raise `UnsupportedModelError` for a smooth table with two inputs, or one whose file was not read."""
    variables = {entry["name"]: entry for entry in model.dae["variables"] if entry["name"] in model.slots}
    for name, entry in variables.items():
        block, _, parameter = name.rpartition(".")
        if f"{block}.smoothness" not in variables or parameter not in ("smoothness", "tableOnFile"):
            continue
        value = starts.of(model.slots[name])
        span = entry["declaration"]["span"]
        if parameter == "smoothness":
            if f"{block}.leastStep2" in variables and value not in (_LINEAR, _CONSTANT):
                raise model.unsupported(
                    f"the smoothness of {block} is not supported: a table with two inputs can have "
                    "LinearSegments or ConstantSegments",
                    span,
                )
        elif value or name in model.computed_parameters:  # false if the build has read the file
            raise model.unsupported(
                f"tableOnFile of {block} is not the word true or false among the modifiers of the table; "
                "the build reads the file only where it is true there, beside tableName and fileName",
                span,
            )
