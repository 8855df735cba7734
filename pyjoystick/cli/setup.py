"""From the options of a command to an open FMU and its parameters."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.options import DampingLaw, joystick_of, law_of, parameter_file, parse_assignments
from pyjoystick.model import JoystickParameters

if TYPE_CHECKING:
    from pyjoystick.fmu import Fmu


@contextmanager
def opened(
    law: DampingLaw | None, fmu: str | None, assignments: list[str] | None, parameters: Path | None = None
) -> Iterator[tuple[Fmu, JoystickParameters]]:
    """The FMU that the options name, and the joystick that it is to be: a file's or the paper's, changed."""
    # What runs FMUs takes a while to load, which help need not wait for.
    from pyjoystick.fmu import Fmu
    from pyjoystick.runs import fmu_of_damping

    file = parameter_file(parameters)
    changes = parse_assignments(assignments or [], "--set")
    if law is not None and fmu is not None:
        raise typer.BadParameter("give --damping or --fmu: the damping law of a given FMU is its own")
    if fmu is None:
        joystick = joystick_of(law, changes, file)
        with Fmu(found_or_built(fmu_of_damping(joystick.damping))) as opened_fmu:
            yield opened_fmu, joystick
    else:
        with Fmu(found_or_built(fmu)) as opened_fmu:
            yield opened_fmu, joystick_of(law_of(opened_fmu.description), changes, file)
