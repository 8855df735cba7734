"""Exact derivatives of a driven joystick's stroboscopic map, from an FMU that computes sensitivities."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.fmu import Fmu, sensitivity_name
from pyjoystick.support import FloatArray

#: State variables of the map, and the parameters that set the state at the start.
MOTION: Final = ("theta", "omega")
STARTS: Final = ("theta_start", "omega_start")
#: Parameters whose sensitivities give the derivatives with respect to the frequency, see
#: `MapSensitivities.by_frequency`.
_SCALED: Final = ("J", "damping.C")


@dataclass(frozen=True, eq=False)
class MapSensitivities:
    """Maps the outputs of an FMU with sensitivities to derivatives of its stroboscopic map.

    Attributes:
        fmu: the FMU with sensitivities
        by: parameters, besides the start values, with respect to which derivatives are known
    """

    fmu: Fmu
    by: tuple[str, ...]

    @classmethod
    def of(cls, fmu: Fmu, by: tuple[str, ...]) -> MapSensitivities | None:
        """Find the sensitivities that belong to an FMU, see `Fmu.sensitive`.

        Args:
            fmu: FMU of a joystick
            by: parameters whose sensitivities are used if the FMU computes them for all of these

        Returns:
            None if there are no sensitivities to the state at the start
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
        """As `of`, for derivatives with respect to the frequency under constant damping."""
        return cls.of(fmu, _SCALED)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Outputs to record: the motion, and its sensitivities to the start values and to the parameters."""
        return (*MOTION, *_names(STARTS), *_names(self.by))

    def monodromies(self, ends: FloatArray) -> FloatArray:
        """Return the derivatives with respect to the start state, shape (runs, 2, 2).

        Args:
            ends: the `outputs` at the end of each run, shape (runs, outputs)
        """
        return ends[:, 2:6].reshape(-1, 2, 2)

    def by_parameter(self, end: FloatArray) -> FloatArray:
        """Return the derivatives with respect to the first parameter, shape (2,).

        Args:
            end: one row of `outputs`
        """
        return end[6:].reshape(2, -1)[:, 0]

    def by_frequency(
        self, end: FloatArray, state: FloatArray, frequency: float, inertia: float, damping: float
    ) -> FloatArray:
        """Return the derivative of the map with respect to the torque's frequency, shape (2,).

        It holds for constant damping: with the time f t and the velocity omega/f, the frequency enters
        only through J f^2 and C f.

        Args:
            end: one row of `outputs`
            state: state at the start of the run, shape (2,)
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
