"""The joystick that a report is about, and its free oscillation, made once for all sections."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu
from pyjoystick.model import JoystickParameters, LawName, Trajectory, law_name, simulate
from pyjoystick.motion import find_peaks
from pyjoystick.runs import free_oscillation
from pyjoystick.support import DEFAULT_DURATION

_INTERVAL: Final = 0.5e-3


@dataclass(frozen=True)
class Study:
    """A joystick, the FMU that runs it, and the release that the report shows.

    Attributes:
        joystick: its parameters
        fmu: the FMU with its damping law, open
        release_angle: angle of release from rest (rad)
        pivot_to_top: pivot to the top of the handle (m), where it is known
    """

    joystick: JoystickParameters
    fmu: Fmu
    release_angle: float
    pivot_to_top: float | None

    @property
    def law(self) -> LawName:
        """The name of the damping law."""
        return law_name(self.joystick.damping)

    @cached_property
    def run(self) -> pd.DataFrame:
        """The free oscillation, by the FMU."""
        return free_oscillation(
            self.release_angle, fmu=self.fmu, parameters=self.joystick, output_interval=_INTERVAL
        )

    @cached_property
    def peaks(self) -> pd.DataFrame:
        """The peaks of its angle."""
        return find_peaks(self.run.index, self.run["theta"], self.run["omega"])

    @cached_property
    def trajectory(self) -> Trajectory:
        """The same oscillation by the reference, with its turning points."""
        time = np.linspace(0.0, DEFAULT_DURATION, round(DEFAULT_DURATION / _INTERVAL) + 1)
        return simulate(self.joystick, time=time, theta_start=self.release_angle)
