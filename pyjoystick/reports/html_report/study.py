"""Subject of a report: a joystick, its free oscillation, and uncertainties of computed numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu
from pyjoystick.model import JoystickParameters, LawName, Trajectory, law_name, simulate
from pyjoystick.motion import find_peaks
from pyjoystick.runs import free_oscillation
from pyjoystick.support import DEFAULT_DURATION, FloatArray

_INTERVAL: Final = 0.5e-3


@dataclass(frozen=True)
class Study:
    """A joystick, its FMU, and the release that the report shows.

    Attributes:
        joystick: its parameters
        fmu: the FMU with its damping law, open
        release_angle: angle of the release from rest (rad)
        pivot_to_top: distance from the pivot to the top of the handle (m), if known
        moved: joysticks with one parameter moved by its standard uncertainty, for the digits of computed
            numbers
    """

    joystick: JoystickParameters
    fmu: Fmu
    release_angle: float
    pivot_to_top: float | None
    moved: tuple[JoystickParameters, ...] = ()

    @property
    def law(self) -> LawName:
        """The name of the damping law."""
        return law_name(self.joystick.damping)

    @cached_property
    def run(self) -> pd.DataFrame:
        """The free oscillation, from the FMU."""
        return free_oscillation(
            self.release_angle, fmu=self.fmu, parameters=self.joystick, output_interval=_INTERVAL
        )

    @cached_property
    def peaks(self) -> pd.DataFrame:
        """The peaks of its angle."""
        return find_peaks(self.run.index, self.run["theta"], self.run["omega"])

    def uncertainties(self, compute: Callable[[Study], FloatArray]) -> FloatArray | None:
        """Standard uncertainties of computed numbers, propagated from those of the parameters.

        Returns:
            the root of the sum of squares over `moved`, with the shape of the result of `compute`; None if
            `moved` is empty
        """
        if not self.moved:
            return None
        exact = compute(self)
        return np.asarray(np.sqrt(sum((compute(one) - exact) ** 2 for one in self._moved_studies)))

    @cached_property
    def _moved_studies(self) -> list[Study]:
        return [replace(self, joystick=one, moved=()) for one in self.moved]

    @cached_property
    def trajectory(self) -> Trajectory:
        """The same oscillation from the reference, with its turning points."""
        time = np.linspace(0.0, DEFAULT_DURATION, round(DEFAULT_DURATION / _INTERVAL) + 1)
        return simulate(self.joystick, time=time, theta_start=self.release_angle)
