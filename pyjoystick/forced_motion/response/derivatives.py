"""Exact derivatives of a shaken joystick's map, from an FMU that computes sensitivities while it runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.fmu import Fmu, sensitivity_name
from pyjoystick.support import FloatArray

#: What the map goes between, and the parameters that are the state at the start.
MOTION: Final = ("theta", "omega")
STARTS: Final = ("theta_start", "omega_start")
#: By these two, derivatives by the frequency follow, see `MapSensitivities.by_frequency`.
_SCALED: Final = ("J", "damping.C")


@dataclass(frozen=True, eq=False)
class MapSensitivities:
    """Which outputs of an FMU are the derivatives of its map.

    Attributes:
        fmu: the FMU with sensitivities
        by: the parameters, beside the start values, by whose sensitivities derivatives are known
    """

    fmu: Fmu
    by: tuple[str, ...]

    @classmethod
    def of(cls, fmu: Fmu, by: tuple[str, ...]) -> MapSensitivities | None:
        """Those that belong to an FMU, see `Fmu.sensitive`; None where it has none by the state at the start.

        Args:
            fmu: of a joystick
            by: parameters whose sensitivities would be of use, if all of them are known
        """
        sensitive = fmu.sensitive
        if sensitive is None:
            return None
        known = sensitive.description.variables.keys()
        if not known >= set(_names(STARTS)):
            return None
        return cls(sensitive, by if known >= set(_names(by)) else ())

    @classmethod
    def over_frequency(cls, fmu: Fmu) -> MapSensitivities | None:
        """The same with what derivatives by the frequency take under constant damping."""
        return cls.of(fmu, _SCALED)

    @property
    def outputs(self) -> tuple[str, ...]:
        """What a run has to record: the motion, its derivatives by the start, those by the parameters."""
        return (*MOTION, *_names(STARTS), *_names(self.by))

    def monodromies(self, ends: FloatArray) -> FloatArray:
        """The derivatives by the state before, shape (runs, 2, 2), from the `outputs` of each run."""
        return ends[:, 2:6].reshape(-1, 2, 2)

    def by_parameter(self, end: FloatArray) -> FloatArray:
        """The derivatives by the first of the parameters, shape (2,), from one row of `outputs`."""
        return end[6:].reshape(2, -1)[:, 0]

    def by_frequency(
        self, end: FloatArray, state: FloatArray, frequency: float, inertia: float, damping: float
    ) -> FloatArray:
        """The derivative of the map by the frequency of the torque, for constant damping, shape (2,).

        In the time f t and with omega/f the frequency enters through J f^2 and C f alone.

        Args:
            end: one row of `outputs`
            state: where the run began, shape (2,)
            frequency: f (Hz)
            inertia: J (kg m2)
            damping: C (N m s/rad)
        """
        by_inertia, by_damping = end[6:].reshape(2, 2).T
        by_omega = end[2:6].reshape(2, 2)[:, 1]
        slope = 2.0 * inertia * by_inertia + damping * by_damping - state[1] * by_omega
        slope[1] += end[1]
        return np.asarray(slope / frequency)


def _names(by: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(sensitivity_name(variable, parameter) for variable in MOTION for parameter in by)
