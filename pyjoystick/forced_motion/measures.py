"""Load on the hand: peaks, means, impulse and work of the torque, and the share of each part."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.forced_motion.samples import Samples
from pyjoystick.model import PIVOT_TO_TOP, JoystickParameters, energy
from pyjoystick.support import FloatArray, positive

#: Parts of eq. (13) by name, and their columns; friction only if the joystick has it.
PARTS: Final = {
    "stiffness": "T_stiffness",
    "damping": "T_damping",
    "inertia": "T_inertia",
    "friction": "T_friction",
}


@dataclass(frozen=True, slots=True)
class PartMeasures:
    """Statistics of the torque or a part of it over a motion; peaks are those of the samples.

    Attributes:
        highest: largest value, towards positive angles (N m)
        lowest: smallest value (N m)
        rms: root mean square over time (N m)
        impulse: integral of the magnitude over time (N m s)
        work: integral of torque times angular velocity (J)
        share: contribution to the mean square of the total torque, mean(part*T)/mean(T^2); the shares of
            all parts add up to 1, and are negative for parts that oppose the sum of the others
    """

    highest: float
    lowest: float
    rms: float
    impulse: float
    work: float
    share: float

    @property
    def peak(self) -> float:
        """Largest magnitude (N m)."""
        return max(self.highest, -self.lowest)


@dataclass(frozen=True, slots=True)
class TorqueMeasures:
    """Statistics of the torque of a motion.

    Attributes:
        duration: length of the motion (s)
        total: statistics of T
        parts: statistics of its parts: ``stiffness``, ``damping``, ``inertia``, and ``friction`` if there is
            any
        positive_work: work done by the hand on the joystick (J): integral of T*omega where that is above 0
        negative_work: work done by the joystick on the hand (J), below 0
        energy_change: energy of the joystick at the end minus that at the start (J)
        pivot_to_handle: distance from the pivot to the hand (m)
    """

    duration: float
    total: PartMeasures
    parts: Mapping[str, PartMeasures]
    positive_work: float
    negative_work: float
    energy_change: float
    pivot_to_handle: float

    @property
    def work(self) -> float:
        """Net work of the hand (J): energy change and loss."""
        return self.total.work

    @property
    def loss(self) -> float:
        """Energy dissipated by damping and friction (J), the integral of C*omega^2 + M_f*omega."""
        friction = self.parts.get("friction")
        return self.parts["damping"].work + (friction.work if friction else 0.0)

    @property
    def peak_force(self) -> float:
        """Largest force of the hand, perpendicular to the handle (N)."""
        return self.total.peak / self.pivot_to_handle

    def peak_ratio(self, part: str, to: str = "total") -> float:
        """Peak of a part divided by the peak of the torque, or of another part."""
        other = self.total if to == "total" else self.parts[to]
        return self.parts[part].peak / other.peak


def measure(
    joystick: JoystickParameters,
    samples: Samples,
    torque: pd.DataFrame,
    *,
    pivot_to_handle: float = PIVOT_TO_TOP,
) -> TorqueMeasures:
    """Compute the statistics of a motion's torque; integrals use the samples' weights.

    For a measured motion, give its `Samples.refined`, and their torque.

    Args:
        joystick: joystick that the torque was computed for
        samples: the motion
        torque: its torque, from `torque_by_fmu` or `torque_by_reference`
        pivot_to_handle: distance from the pivot to the hand (m), by default the top of Table 2

    Raises:
        ParameterError: the distance is not above 0, or some |theta| >= pi/2
    """
    whole = torque["T"].to_numpy()
    power = whole * samples.omega
    first, last = energy(joystick, samples.theta[[0, -1]], samples.omega[[0, -1]])
    return TorqueMeasures(
        duration=samples.duration,
        total=_part(samples, whole, whole),
        parts={
            name: _part(samples, torque[column].to_numpy(), whole)
            for name, column in PARTS.items()
            if column in torque
        },
        positive_work=float(np.sum(np.maximum(power, 0.0) * samples.weights)),
        negative_work=float(np.sum(np.minimum(power, 0.0) * samples.weights)),
        energy_change=float(last - first),
        pivot_to_handle=positive("pivot_to_handle", pivot_to_handle, "m"),
    )


def _part(samples: Samples, part: FloatArray, whole: FloatArray) -> PartMeasures:
    weights = samples.weights
    square = float(np.sum(whole * whole * weights))
    return PartMeasures(
        highest=float(part.max()),
        lowest=float(part.min()),
        rms=float(np.sqrt(np.sum(part * part * weights) / np.sum(weights))),
        impulse=float(np.sum(np.abs(part) * weights)),
        work=float(np.sum(part * samples.omega * weights)),
        share=float(np.sum(part * whole * weights)) / square if square > 0.0 else 0.0,
    )
