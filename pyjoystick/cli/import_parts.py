"""``pyjoystick import parts``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick import laboratory, model
from pyjoystick.cli import options
from pyjoystick.cli.console import print_notes
from pyjoystick.cli.import_swing import print_estimates
from pyjoystick.cli.parameter_updates import file_to_update, write_update
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
) -> None:
    """Compute mass, center of mass and moment of inertia from the parts, by the parallel-axis theorem."""
    check_outputs(parameters)
    before = file_to_update(parameters)
    found = laboratory.from_parts(laboratory.read_parts(file))
    require_plausible({"m": found.m.value, "h": found.h.value, "J": found.J.value})
    print_notes(file, found.notes)
    estimates = {"m (kg)": found.m, "h (m)": found.h, "J (kg m2)": found.J}
    print_estimates(estimates)
    if parameters is not None:
        by_name = {name.split()[0]: one for name, one in estimates.items()}
        values = {name: model.rounded(one.value, one.uncertainty) for name, one in by_name.items()}
        errors = {f"body.{name}": one.uncertainty for name, one in by_name.items() if one.uncertainty > 0.0}
        write_update(parameters, before.joystick.replace(values), errors, {"body": f"parts {file.name}"})
