"""Finding the FMUs that commands run, or building them if the tools are installed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Final

import typer

from pyjoystick import fmu, model, runs
from pyjoystick.cli.console import print_progress, progress_console
from pyjoystick.cli.joystick_choice import joystick_of, parameter_file
from pyjoystick.cli.parsing import parse_assignments
from pyjoystick.support import PyJoystickError

_TOOLS: Final = ("fmu_build", "rumoca", "ziglang")


class FmuBuildError(PyJoystickError):
    """A missing FMU could not be built."""


@contextmanager
def opened(
    law: model.LawName | None, name: str | None, assignments: list[str] | None, parameters: Path | None = None
) -> Iterator[tuple[fmu.Fmu, model.JoystickParameters]]:
    """Open the FMU of --damping or --fmu with the joystick of --parameters and --set.

    Without --parameters, the joystick of --fmu is given by the FMU's start values.

    Raises:
        BadParameter: both --damping and --fmu are given
        UnsupportedFmuError: the FMU of --fmu is not a joystick
        PyJoystickError: the FMU or a parameter cannot be used
    """
    file = parameter_file(parameters)
    changes = parse_assignments(assignments, "--set")
    if law is not None and name is not None:
        raise typer.BadParameter("use --damping or --fmu, not both: an FMU has its own damping law")
    if name is None:
        joystick = joystick_of(law, changes, file)
        with fmu.Fmu(found_or_built(runs.fmu_of_joystick(joystick))) as one:
            yield one, joystick
    else:
        with fmu.Fmu(found_or_built(name)) as one:
            own = None if parameters is not None else runs.joystick_of_fmu(one.description)
            joystick = joystick_of(runs.law_of_fmu(one.description), changes, file, own)
            yield one, joystick


def found_or_built(name: str) -> Path:
    """Path of an FMU given by name or path; a missing one of this project is built.

    Raises:
        FmuNotFoundError: there is no such file, and it cannot be built here
        FmuBuildError: building it failed
    """
    try:
        return fmu.find_fmu(name)
    except fmu.FmuNotFoundError:
        folder = fmu.build_folder()
        if name not in fmu.MODELS or folder is None or not all(find_spec(tool) for tool in _TOOLS):
            raise
        return _build(fmu.MODELS[name], folder)


def _build(model_name: str, folder: Path) -> Path:
    from fmu_build import BuildError, build_fmu  # needs packages that only builds need

    with progress_console().status(f"building the FMU of {model_name}") as status:
        try:
            result = build_fmu(
                model_name, folder, on_stage=lambda stage: status.update(f"{model_name}: {stage}")
            )
        except BuildError as error:
            raise FmuBuildError(f"the FMU of {model_name} could not be built: {error}") from error
    print_progress(f"built {result.path} in {result.seconds:.1f} s, as it was missing")
    return result.path
