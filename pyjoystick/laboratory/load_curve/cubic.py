"""The cubic polynomial conventionally fitted to such curves (Fig. 7b), for comparison."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from pyjoystick.laboratory.load_curve.curve import LoadCurve
from pyjoystick.laboratory.load_curve.fit import LoadCurveFit
from pyjoystick.support import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Misses:
    """Difference of force between a fit and the record in contact.

    Attributes:
        rms: root mean square (N)
        largest: largest difference (N), due to errors of travel on steep segments
    """

    rms: float
    largest: float


def cubic_fit(curve: LoadCurve, contact: float, zero: float) -> Polynomial:
    """Least-squares cubic for the force (N) minus `zero`, over travel (m) from `contact`."""
    travel = np.concatenate([branch.travel for branch in curve.branches])
    force = np.concatenate([branch.force for branch in curve.branches])
    inside = travel >= contact
    return Polynomial.fit(travel[inside], force[inside] - zero, 3)


def misses(fit: LoadCurveFit) -> dict[str, Misses]:
    """Differences of the segments and of the cubic from both branches in contact, without friction."""
    cubic = cubic_fit(fit.curve, fit.table.x[0], fit.zero)
    found = {}
    for name, force in (("segments", lambda x: segment_force(fit, x)), ("cubic", cubic)):
        differences = np.concatenate(
            [
                (branch.force - fit.zero - force(branch.travel))[branch.travel >= fit.table.x[0]]
                for branch in fit.curve.branches
            ]
        )
        rms = float(np.sqrt(np.mean(differences**2)))
        found[name] = Misses(rms, float(np.max(np.abs(differences))))
    return found


def segment_force(fit: LoadCurveFit, travel: ArrayLike) -> FloatArray:
    """Force of the springs (N) at a travel (m), same shape."""
    beyond = np.maximum(np.asarray(travel, np.float64)[..., None] - np.array(fit.table.x), 0.0)
    return np.asarray(beyond @ np.diff(fit.table.k, prepend=0.0))
