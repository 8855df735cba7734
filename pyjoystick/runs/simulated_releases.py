"""Peaks of simulated releases, with FMUs that stay open between runs."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Final, Self

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu
from pyjoystick.model import JoystickParameters
from pyjoystick.motion import ReleasePeaks, peaks_of_run
from pyjoystick.runs.experiments import time_grid
from pyjoystick.runs.joystick_fmus import fmu_of_joystick
from pyjoystick.support import FloatArray, angle

#: Length of a run and time between its samples (s); peaks are located between the samples.
DURATION: Final = 1.5
OUTPUT_INTERVAL: Final = 0.5e-3
_OUTPUTS: Final = ("theta", "omega", "alpha")


class SimulatedReleases:
    """Releases from rest with the FMUs of both damping laws, with or without friction and stops.

    FMUs are opened on demand. Use it in a `with` statement, which closes them. A call returns the peaks of
    one release:

    >>> with SimulatedReleases() as simulate:  # doctest: +SKIP
    ...     peaks = simulate(NOMINAL, math.radians(-20))
    """

    def __init__(self, *, duration: float = DURATION, output_interval: float = OUTPUT_INTERVAL) -> None:
        """Set the length of the runs and the time between their samples (s)."""
        self._time: FloatArray = time_grid(duration, output_interval)
        self._stack = ExitStack()
        self._fmus: dict[str, Fmu] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def __call__(self, joystick: JoystickParameters, release_angle: float) -> ReleasePeaks:
        """Peaks of one release.

        Args:
            joystick: its damping law, friction and stops select the FMU
            release_angle: release angle (rad)

        Raises:
            ParameterError: the angle is pi/2 or more
            FmuNotFoundError, FmuRunError: the FMU is missing or fails
        """
        law = fmu_of_joystick(joystick)
        values = joystick.to_names() | {"theta_start": angle("release_angle", release_angle)}
        run = self._fmu(law).run(self._time, parameters=values, outputs=_OUTPUTS)
        return peaks_of_run(run, name=f"{law} from {np.degrees(release_angle):g} degrees")

    def vary(
        self, joystick: JoystickParameters, release_angle: float, name: str, values: FloatArray
    ) -> dict[float, ReleasePeaks]:
        """Peaks of releases that differ in one parameter; everything else is prepared once.

        Args:
            joystick: parameters common to all runs
            release_angle: release angle (rad)
            name: FMU name of the varied parameter, such as ``damping.C``
            values: its values, shape (runs,)

        Returns:
            the peaks by value

        Raises:
            UnknownParameterError, ParameterError: the name or a value is not allowed
            FmuRunError: a run fails
        """
        checked = [joystick.replace({name: float(value)}) for value in values]
        # Use the FMU with stops (and friction) if any joystick has stops, else with friction if any has it.
        fullest = max([joystick, *checked], key=lambda one: (bool(one.stops), bool(one.friction)))
        fixed = fullest.to_names() | {"theta_start": angle("release_angle", release_angle)}
        fixed.pop(name, None)
        plan = self._fmu(fmu_of_joystick(fullest)).plan(
            self._time, varied=[name], parameters=fixed, outputs=_OUTPUTS
        )
        found = {}
        for value in map(float, values):
            run = pd.DataFrame(plan.run([value]), index=self._time, columns=list(_OUTPUTS))
            found[value] = peaks_of_run(run, name=f"{name} = {value:g}")
        return found

    def _fmu(self, law: str) -> Fmu:
        if law not in self._fmus:
            self._fmus[law] = self._stack.enter_context(Fmu(law))
        return self._fmus[law]
