"""Writing the live page of a joystick, for several commands."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pyjoystick import model, motion, reports
from pyjoystick.cli.console import progress_console, write
from pyjoystick.cli.fmus import FmuBuildError, found_or_built
from pyjoystick.support import write_text


def write_live_page(
    target: Path,
    file: model.ParameterFile,
    joystick: model.JoystickParameters,
    start: float,
    *,
    records: Sequence[motion.Record] = (),
    title: str = "",
) -> None:
    """Write the page and report it; raises FmuBuildError if the FMU or its module is missing."""
    fmu = found_or_built(reports.held_fmu(joystick))
    from fmu_build import BuildError  # takes long to load

    with progress_console().status("page"):
        try:
            text = reports.joystick_page(fmu, file, joystick, start, records=records, title=title)
        except BuildError as error:
            raise FmuBuildError(f"the page could not be made: {error}") from error
    write(target, lambda path: write_text(path, text), f", {len(text.encode()) / 1e3:.0f} kB")
