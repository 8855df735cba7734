"""FMUs of one joystick, with its parameters as start values."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from os import PathLike
from pathlib import Path
from typing import Final

from fmu_build import BuildError, FmiVersion, build_fmu
from pyjoystick.model import JoystickParameters, LawName, ParameterFile, fmu_values, inverse_torque
from pyjoystick.reports.export.fit_page import fit_page
from pyjoystick.reports.export.modelica_class import BASE_NAMES, Direction, check_name, modelica_class
from pyjoystick.support import PyJoystickError, temporary_folder, write_text

_TOOLS: Final = ("rumoca", "ziglang")
_SUFFIXES: Final[dict[Direction, str]] = {"forward": "", "inverse": "Inverse"}
_PUSH: Final = math.radians(10.0)


@dataclass(eq=False)
class FmuExportError(PyJoystickError):
    """The FMUs of a joystick cannot be built.

    Attributes:
        name: the FMU
        reason: why, and how to correct it
    """

    name: str
    reason: str
    _message = "the FMU {name} cannot be built: {reason}"


def default_name(file: ParameterFile) -> str:
    """Name of a joystick's FMUs, from its parameter file: ``left_stick.toml`` gives LeftStick.

    Names of the project's own FMUs, and names that do not begin with a letter, are prefixed with "My".
    """
    words = "".join(c if c.isascii() and c.isalnum() else " " for c in file.path.stem).split()
    name = "".join(word[0].upper() + word[1:] for word in words)
    return f"My{name}" if not name[:1].isalpha() or name in BASE_NAMES else name


def export_fmus(
    file: ParameterFile,
    folder: str | PathLike[str],
    *,
    name: str | None = None,
    law: LawName | None = None,
    directions: Sequence[Direction] = ("forward", "inverse"),
    fmi_version: FmiVersion = "2.0",
    platforms: Sequence[str] = (),
    fit: str | PathLike[str] | None = None,
    on_stage: Callable[[str], None] = lambda stage: None,
) -> list[Path]:
    """Build FMUs with the joystick's parameters as start values.

    These are the start values in modelDescription.xml and in the binary. Each FMU has its own documentation
    page, default experiment, reference results and figure.

    Args:
        file: the joystick
        folder: receives ``<name>.fmu`` and ``<name>Inverse.fmu``; created if missing
        name: name of the FMUs; by default from the file, see `default_name`
        law: damping law; by default that of the file
        directions: ``forward`` from torque to motion, ``inverse`` from motion to torque
        fmi_version: "2.0" or "3.0"
        platforms: as in `fmu_build.build_fmu`: by default this machine's, ``("all",)`` for all
        fit: ``fit.json`` of the fit that the values come from, for the page
        on_stage: called with a description of the current stage

    Returns:
        the FMUs, in the order of the directions

    Raises:
        ParameterError: the name cannot be that of an FMU
        SettingsError: the file has no parameters of that law
        InputFileError: the fit cannot be read, or is that of another joystick
        FmuExportError: there is no compiler, or it failed
    """
    name = check_name(name or default_name(file))
    values = fmu_values(file, law)
    law = law or file.law
    more = "" if fit is None else fit_page(fit, values)
    if not all(find_spec(tool) for tool in _TOOLS):
        raise FmuExportError(name, "no compiler is installed; pip install 'pyjoystick[build]' brings one")
    paths = []
    with temporary_folder() as temporary:
        for direction in directions:
            own = name + _SUFFIXES[direction]
            source = temporary / own / f"{own}.mo"
            text = modelica_class(own, values, direction=direction, law=law, title=file.title, more=more)
            write_text(source, text)
            inputs = _default_inputs(file.with_law(law), direction)
            write_text(source.parent / "Resources" / "Inputs" / f"{own}.csv", inputs)
            try:
                built = build_fmu(
                    own,
                    folder,
                    library=source,
                    fmi_version=fmi_version,
                    platforms=platforms,
                    on_stage=lambda stage, own=own: on_stage(f"{own}: {stage}"),  # type: ignore[misc]
                )
            except BuildError as error:
                raise FmuExportError(own, str(error)) from error
            paths.append(built.path)
    return paths


def _default_inputs(joystick: JoystickParameters, direction: Direction) -> str:
    """Inputs of the default experiment for fmu_build; values are constant from each row to the next.

    Forward: from rest, 0.2 s of the torque that holds the joystick at -10 degrees, then none. Inverse:
        several
    positions at rest, then velocities, then accelerations.
    """
    if direction == "forward":
        torque = float(inverse_torque(joystick, -_PUSH, 0.0, 0.0).T)
        return f"time,T\n0,0\n0.1,{torque:.3g}\n0.3,0\n"
    rows = [
        *((angle, 0, 0) for angle in (-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3)),
        *((0.1, velocity, 0) for velocity in (-4, -2, 2, 4)),
        *((0.1, 0, acceleration) for acceleration in (-100, -50, 50, 100)),
    ]
    lines = (f"{0.1 * i:.1f},{theta},{omega},{alpha}" for i, (theta, omega, alpha) in enumerate(rows))
    return "\n".join(("time,theta,omega,alpha", *lines)) + "\n"
