"""Bench measurements (made without cameras): values, uncertainties, and what is taken as exact."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from pyjoystick.laboratory import PLACES, LoadCurveFit
from pyjoystick.model import FRICTION_NAMES, SIDES, JoystickParameters, ParameterFile, Side
from pyjoystick.runs import FMU_WITH_FRICTION, fmu_of_joystick

#: Single-number parameters that may be uncertain, in the order of tables, with their places in a parameter
#: file.
UNCERTAIN: Final[Mapping[str, str]] = {
    **{name: PLACES[name] for name in ("m", "h", "J", "g", "a", "b")},
    **{name: name for name in FRICTION_NAMES},
}
#: Relative uncertainties of instruments that residuals do not show: attributes of `Bench` and their names.
OF_INSTRUMENTS: Final[Mapping[str, str]] = {
    "scale": "scale of the angle",
    "time_base": "time base",
    "force_scale": "scale of the force",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Bench:
    """Bench measurements with their standard uncertainties.

    Attributes:
        joystick: the joystick, with constant damping; fits start from its J and C
        curves: fits of the measured load-deflection curves
        uncertainties: standard uncertainties of the names in `UNCERTAIN` (SI units)
        scale: relative uncertainty of the angle's scale, equal to that of the top marker's radius
        time_base: relative uncertainty of the clock of the records
        force_scale: relative uncertainty of the load cell's scale, which all springs have in common
    """

    joystick: JoystickParameters
    curves: Mapping[Side, LoadCurveFit]
    uncertainties: Mapping[str, float]
    scale: float = 0.0
    time_base: float = 0.0
    force_scale: float = 0.0

    @property
    def fmu(self) -> str:
        """Name of the FMU to fit; the one with friction also where friction is 0 but uncertain."""
        name = fmu_of_joystick(self.joystick)
        return FMU_WITH_FRICTION.get(name, name) if self._rubs else name

    @property
    def exact(self) -> tuple[str, ...]:
        """Quantities taken as exact because no uncertainty is given; J is fitted."""
        values = self.joystick.to_names()
        names = [
            name
            for name in UNCERTAIN
            if name != "J" and values.get(name, 0.0) != 0.0 and not self.uncertainties.get(name, 0.0) > 0.0
        ]
        curves = [f"load curve {side}" for side in SIDES if side not in self.curves]
        instruments = [title for name, title in OF_INSTRUMENTS.items() if not getattr(self, name) > 0.0]
        return (*names, *([] if self._rubs else ["the absence of dry friction"]), *curves, *instruments)

    @property
    def _rubs(self) -> bool:
        """Whether dry friction has a nonzero value or uncertainty."""
        values = self.joystick.to_names()
        return any(values.get(one, 0.0) or self.uncertainties.get(one, 0.0) > 0.0 for one in FRICTION_NAMES)


def stated_uncertainties(file: ParameterFile) -> dict[str, float]:
    """Standard uncertainties (SI units) that a parameter file gives for the names in `UNCERTAIN`, else 0."""
    return {name: file.uncertainties.get(place, 0.0) for name, place in UNCERTAIN.items()}
