"""Refuse tables of the Modelica Standard Library that the functions in `FmuBuildTables.mo` do not cover."""

from __future__ import annotations

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.start_values import StartValues

_LINEAR, _CONSTANT = 1, 3
"""Literals of the enumeration Smoothness."""


def reject_unsupported_tables(model: LoweredModel, starts: StartValues) -> None:
    """Raise `UnsupportedModelError` for a table that is smooth in two inputs."""
    bindings = model.solve["layout"]["bindings"]
    variables = {variable["name"]: variable for variable in model.dae["variables"]}
    for name, variable in variables.items():
        block, _, parameter = name.rpartition(".")
        if parameter != "smoothness" or f"{block}.leastStep2" not in variables or name not in bindings:
            continue
        if starts.of(("p", bindings[name]["P"]["index"])) not in (_LINEAR, _CONSTANT):
            raise model.unsupported(
                f"the smoothness of {block} is not supported: a table with two inputs can have "
                "LinearSegments or ConstantSegments",
                variable["declaration"]["span"],
            )
