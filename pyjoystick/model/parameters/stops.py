"""The mechanical stops of a joystick, which the paper mentions at about 20 degrees and does not model."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Final

from pyjoystick.support import ParameterError, not_negative, positive


@dataclass(frozen=True, slots=True, kw_only=True)
class Stops:
    """A spring and a damper on either side that push and never pull; none where theta_stop is 0.

    At a compression delta = |theta| - theta_stop above 0, whose rate is delta', the moment against the motion
    outward is max(0, K*delta + D*delta').

    Attributes:
        theta_stop: angle at which the handle meets a stop, to either side (rad), 0 or more, below pi/2
        K: stiffness about the pivot (N m/rad), above 0
        D: damping about the pivot (N m s/rad), 0 or more

    Raises:
        ParameterError: a value is not finite or outside its range
    """

    theta_stop: float = 0.0
    K: float = 1000.0
    D: float = 0.7

    def __post_init__(self) -> None:
        theta_stop = not_negative("theta_stop", self.theta_stop, "rad")
        if theta_stop >= 0.5 * math.pi:
            raise ParameterError("theta_stop", self.theta_stop, "below pi/2 rad; 0 means no stops")
        object.__setattr__(self, "theta_stop", theta_stop)
        object.__setattr__(self, "K", positive("K", self.K, "N.m/rad"))
        object.__setattr__(self, "D", not_negative("D", self.D, "N.m.s/rad"))

    def __bool__(self) -> bool:
        return self.theta_stop > 0.0


#: FMU names of the parameters of the stops.
STOP_NAMES: Final = tuple(f"stops.{field.name}" for field in dataclasses.fields(Stops))
