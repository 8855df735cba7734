"""What was measured without cameras, how uncertain it is, and what is taken as exact."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from pyjoystick.laboratory import PLACES, LoadCurveFit
from pyjoystick.model import FRICTION_NAMES, SIDES, JoystickParameters, ParameterFile, Side
from pyjoystick.runs import FMU_WITH_FRICTION, fmu_of_joystick

#: Parameters that are single numbers and may be uncertain, in the order of tables, and their places in a
#: parameter file.
UNCERTAIN: Final[Mapping[str, str]] = {
    **{name: PLACES[name] for name in ("m", "h", "J", "g", "a", "b")},
    **{name: name for name in FRICTION_NAMES},
}
#: Relative uncertainties of the records, which no residual shows, as attributes of `Bench` and in words.
OF_RECORDS: Final[Mapping[str, str]] = {"scale": "scale of the angle", "time_base": "time base"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Bench:
    """What was measured without cameras, with standard uncertainties.

    Attributes:
        joystick: the joystick, with constant damping; its J and C are where a fit begins
        curves: fits of the load-deflection curves, as far as there are any
        uncertainties: of the names in `UNCERTAIN`, in SI units
        scale: of the angle's scale, in parts of it: that of the radius of the top marker
        time_base: of the clock of the records, in parts of their duration
    """

    joystick: JoystickParameters
    curves: Mapping[Side, LoadCurveFit]
    uncertainties: Mapping[str, float]
    scale: float = 0.0
    time_base: float = 0.0

    @property
    def fmu(self) -> str:
        """Name of the FMU of the fits: with friction also where it is 0 and only its uncertainty is not."""
        name = fmu_of_joystick(self.joystick)
        return FMU_WITH_FRICTION.get(name, name) if self._rubs else name

    @property
    def exact(self) -> tuple[str, ...]:
        """What counts as exact, because no uncertainty of it is given; J is fitted."""
        values = self.joystick.to_names()
        names = [
            name
            for name in UNCERTAIN
            if name != "J" and values.get(name, 0.0) != 0.0 and not self.uncertainties.get(name, 0.0) > 0.0
        ]
        curves = [f"load curve {side}" for side in SIDES if side not in self.curves]
        records = [title for name, title in OF_RECORDS.items() if not getattr(self, name) > 0.0]
        return (*names, *([] if self._rubs else ["the absence of dry friction"]), *curves, *records)

    @property
    def _rubs(self) -> bool:
        """Whether there may be dry friction: a value or an uncertainty of it is not 0."""
        values = self.joystick.to_names()
        return any(values.get(one, 0.0) or self.uncertainties.get(one, 0.0) > 0.0 for one in FRICTION_NAMES)


def stated_uncertainties(file: ParameterFile) -> dict[str, float]:
    """Standard uncertainties (SI units) of the names in `UNCERTAIN` in a parameter file; 0 for none."""
    return {name: file.uncertainties.get(place, 0.0) for name, place in UNCERTAIN.items()}
