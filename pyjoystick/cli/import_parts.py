"""``pyjoystick import parts``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import laboratory
from pyjoystick.cli import options
from pyjoystick.cli.console import output, print_warnings, write_json
from pyjoystick.cli.parameter_updates import file_to_update, write_measured
from pyjoystick.cli.plausibility import require_plausible
from pyjoystick.support import check_outputs

EXAMPLES: Final = """
Examples:

    pyjoystick import parts parts.csv -p joystick.toml

The headings are part, mass (g), height (mm), inertia (g.cm2); optional are offset (mm), u_mass (g) and so on.
"""


def run(
    file: Annotated[Path, typer.Argument(metavar="PARTS.csv", help="One part per row.")],
    parameters: options.ParametersToUpdate = None,
    json: Annotated[Path | None, options.json("the values and their uncertainties")] = None,
) -> None:
    """Compute mass, center of mass and moment of inertia from the parts, by the parallel-axis theorem."""
    check_outputs(parameters, json)
    before = file_to_update(parameters)
    found = laboratory.from_parts(laboratory.read_parts(file))
    require_plausible({"m": found.m.value, "h": found.h.value, "J": found.J.value})
    print_warnings(file, found.notes)
    console = output()
    console.print()
    console.print(laboratory.estimates_report(found.estimates()), markup=False)
    if parameters is not None:
        write_measured(parameters, before, laboratory.measured_parts(found, f"parts {file.name}"))
    write_json(json, lambda notes: laboratory.parts_json(found, notes))
