"""Locating FMUs: by name in the installed package or the checkout, or by path."""

from __future__ import annotations

from importlib import resources
from os import PathLike
from pathlib import Path
from types import MappingProxyType

from pyjoystick.fmu.errors import FmuNotFoundError

#: Modelica class of each FMU of this project, by name.
MODELS = MappingProxyType(
    {
        name: f"PreloadedSprings.{package}.{name}"
        for package, name in (
            ("Joystick", "Joystick"),
            ("Joystick", "JoystickPowerLaw"),
            ("Joystick", "JoystickFriction"),
            ("Joystick", "JoystickFrictionPowerLaw"),
            ("Joystick", "JoystickInverse"),
            ("Joystick", "JoystickInversePowerLaw"),
            ("Operator", "Operator"),
            ("Operator", "HeldJoystick"),
            ("Operator", "HeldJoystickPowerLaw"),
            ("Operator", "MountedJoystick"),
            ("Operator", "MountedJoystickPowerLaw"),
            ("Examples", "OperatedJoystick"),
        )
    }
)


def find_fmu(fmu: str | PathLike[str]) -> Path:
    """Find the file of an FMU.

    Args:
        fmu: one of the names in `MODELS`, or the path of any .fmu file. A name is looked up in the installed
            package, then in the checkout's ``build/fmi2``.

    Raises:
        FmuNotFoundError: there is no such file; the message explains how to build it
    """
    if fmu in MODELS:
        return _find_by_name(str(fmu))
    path = Path(fmu)
    if not path.is_file():
        what = "it is a folder" if path.is_dir() else "the file does not exist"
        raise FmuNotFoundError(str(path), f"{what}; known by name are {', '.join(MODELS)}")
    return path


def build_folder() -> Path | None:
    """``build/fmi2`` of the checkout that this package runs from; None if it is installed as a wheel."""
    root = Path(__file__).resolve().parents[2]
    is_checkout = (root / "modelica" / "PreloadedSprings" / "package.mo").is_file()
    return root / "build" / "fmi2" if is_checkout else None


def _find_by_name(name: str) -> Path:
    packed = resources.files("pyjoystick") / "fmus" / f"{name}.fmu"
    folder = build_folder()
    candidates = [Path(str(packed)), *([folder / f"{name}.fmu"] if folder else [])]
    for path in candidates:
        if path.is_file():
            return path
    command = f"python -m fmu_build {MODELS[name]} --output {folder or 'DIR'}"
    advice = f"build it with `make fmu` or `{command}`" if folder else f"build it with `{command}`"
    raise FmuNotFoundError(name, advice if folder else f"{advice} and give its path")
