"""Choice of the FMU for a joystick, by its damping law, dry friction and stops.

Separate from the experiments, so that inspecting a project does not load pandas.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final

from pyjoystick.fmu import FmuDescription, UnsupportedFmuError
from pyjoystick.model import JoystickParameters, LawName, law_name, units_of
from pyjoystick.motion import plain_unit

#: Declared units of variables without one.
NO_UNIT: Final = ("", "1")
#: FMUs of a joystick without dry friction and stops.
FMU_OF_LAW: Final[Mapping[LawName, str]] = {"constant": "Joystick", "power-law": "JoystickPowerLaw"}
#: FMUs of the same joystick with dry friction.
FMU_WITH_FRICTION: Final[Mapping[str, str]] = {
    "Joystick": "JoystickFriction",
    "JoystickPowerLaw": "JoystickFrictionPowerLaw",
}
#: FMUs of the same joystick with stops, which also have dry friction.
FMU_WITH_STOPS: Final[Mapping[str, str]] = {
    "Joystick": "MountedJoystick",
    "JoystickPowerLaw": "MountedJoystickPowerLaw",
    "JoystickFriction": "MountedJoystick",
    "JoystickFrictionPowerLaw": "MountedJoystickPowerLaw",
}


def fmu_of_joystick(joystick: JoystickParameters) -> str:
    """Name of the FMU that computes the motion of a joystick with its damping law, friction and stops."""
    return fmu_with_parts(FMU_OF_LAW[law_name(joystick.damping)], joystick)


def fmu_with_parts(fmu: str, joystick: JoystickParameters) -> str:
    """Name of the counterpart of `fmu` with the dry friction and the stops of a joystick.

    FMUs from elsewhere have no counterpart and keep their name.
    """
    if joystick.stops:
        return FMU_WITH_STOPS.get(fmu, fmu)
    return FMU_WITH_FRICTION.get(fmu, fmu) if joystick.friction else fmu


def mounted_fmu(joystick: JoystickParameters) -> str:
    """Name of the FMU of a joystick with stops, in a hand, on a moving base, by its damping law."""
    return FMU_WITH_STOPS[FMU_OF_LAW[law_name(joystick.damping)]]


def law_of_fmu(description: FmuDescription) -> LawName:
    """The damping law of a joystick's FMU, by its parameters.

    Raises:
        UnsupportedFmuError: it declares a parameter of the joystick in another unit than the SI unit
    """
    require_si_units(description, description.settable_names())
    return "power-law" if "damping.alpha" in description.variables else "constant"


def require_si_units(description: FmuDescription, names: Iterable[str]) -> None:
    """Raise `UnsupportedFmuError` if one of these quantities of the joystick is declared in another unit."""
    for name in names:
        if not has_si_unit(description, name):
            (unit, *_) = units_of(name) or ("",)
            reason = f"declares {name} in {description.variables[name].unit}; that of a joystick is "
            raise UnsupportedFmuError(description.path, reason + (f"in {unit}" if unit else "a pure number"))


def has_si_unit(description: FmuDescription, name: str) -> bool:
    """Whether a variable is in the SI unit of the joystick's quantity of this name, if there is one.

    Without a declared unit, it is taken to be.
    """
    known = units_of(name)
    if known is None or name not in description.variables:
        return True
    declared = plain_unit(description.variables[name].unit)
    return declared in NO_UNIT or known.get(declared) == 1.0
