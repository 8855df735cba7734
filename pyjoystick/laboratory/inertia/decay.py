"""Decay of a pendulum's amplitude: by a constant ratio for viscous damping, by constant steps for friction.

From one turn to the next, the energy J*omega^2/2 + W*(1 - cos(theta)), W = m*g*h, decreases by the work of
both:

    2*W*sin(M)*sin(D/2) = 8*C*sqrt(W/J)*G(M) + 2*T_c*M

M is the mean of the two amplitudes, D their difference, and 8*sqrt(W/J)*G(M) the integral of the velocity
over the angle in an undamped half swing: G = E(k) - (1 - k^2)*K(k), k = sin(M/2), K and E the complete
elliptic integrals. For small angles D = pi*z*M + 2*T_c/W with the damping ratio z = C/(2*sqrt(W*J)).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import least_squares
from scipy.special import ellipe, ellipk

from pyjoystick.laboratory.inertia.budget import Measured
from pyjoystick.support import FloatArray

#: Parameters fixed at zero, by name of the model.
_MODELS: Final = {
    "viscous damping alone": (True, False),
    "dry friction alone": (False, True),
    "viscous damping and dry friction": (True, True),
}
_BOTH: Final = "viscous damping and dry friction"
_ITERATIONS: Final = 5
#: Limit of the condition number of the normalized derivatives; above, two parameters are indistinguishable.
_CONDITION: Final = 1e4
#: Minimum variance of a height, relative to the largest squared, for records without noise.
_ROUNDING: Final = 1e-24


@dataclass(frozen=True, slots=True)
class Decay:
    """Viscous damping and dry friction, fitted together to the heights of the turns.

    Attributes:
        damping_ratio: of viscous damping
        friction_angle: T_c/(m*g*h), the angle (rad) that dry friction can hold against the weight; half of
            the decrease of the amplitude per half swing
        preferred: the model with the smallest information criterion (BIC)
        margins: excess of each model's criterion over that, by name; 6 and more is clear
    """

    damping_ratio: Measured
    friction_angle: Measured
    preferred: str
    margins: dict[str, float]


def fitted_decay(heights: FloatArray, errors: FloatArray | None = None) -> Decay:
    """Fit both contributions to the heights of successive turns.

    Neither is below zero: nothing drives the pendulum. Few heights, or nearly constant ones, do not tell the
    two apart, so that the standard error of the fit grows without limit. That of an estimate is
    therefore at most the value that it would have if it explained the decay alone.

    Args:
        heights: amplitudes (rad), above 0, shape (n,), n of 5 or more
        errors: their standard errors (rad); by default all the same, and found from the misfit
    """
    fits = {name: _fitted(heights, errors, free) for name, free in _MODELS.items()}
    criteria = {name: one.criterion for name, one in fits.items()}
    least = min(criteria.values())
    both, freedom = fits[_BOTH], len(heights) - 3.0

    def estimate(place: int, alone: _Fit) -> Measured:
        most = alone.values[place] + alone.errors[place]
        return Measured(float(both.values[place]), float(min(both.errors[place], most)), freedom)

    return Decay(
        estimate(1, fits["viscous damping alone"]),
        estimate(2, fits["dry friction alone"]),
        min(criteria, key=lambda name: criteria[name]),
        {name: one - least for name, one in criteria.items()},
    )


def decaying_heights(first: float, damping_ratio: float, friction_angle: float, count: int) -> FloatArray:
    """Amplitudes (rad) of successive turns, shape (count,)."""
    found = np.empty(count)
    found[0] = first
    for i in range(1, count):
        before = found[i - 1]
        fall = 0.0
        for _ in range(_ITERATIONS):
            mean = max(before - 0.5 * fall, _ROUNDING)
            k = math.sin(0.5 * mean) ** 2
            viscous = 8.0 * damping_ratio * float(ellipe(k) - (1.0 - k) * ellipk(k))
            # A trial step of a fit may require more than all of the energy.
            part = (viscous + friction_angle * mean) / math.sin(mean)
            fall = 2.0 * math.asin(min(1.0, max(-1.0, part)))
        found[i] = before - fall
    return found


@dataclass(frozen=True, slots=True, eq=False)
class _Fit:
    """First height, damping ratio and friction angle with standard errors, infinite if undetermined; BIC."""

    values: FloatArray
    errors: FloatArray
    criterion: float


def _fitted(heights: FloatArray, errors: FloatArray | None, free: Sequence[bool]) -> _Fit:
    count, scale = len(heights), float(np.max(heights))
    places = [0, *(i + 1 for i, one in enumerate(free) if one)]
    rate = max(math.log(heights[0] / heights[-1]) / (math.pi * (count - 1)), 0.0)
    start = np.array([heights[0], rate, max((heights[0] - heights[-1]) / (2.0 * (count - 1)), 0.0)])
    start[1:] *= np.array(free) / sum(free)
    sizes = np.array([scale, 1e-2, 1e-2 * scale])
    weights = np.ones(count) if errors is None else 1.0 / np.maximum(errors, math.sqrt(_ROUNDING) * scale)

    def full(own: FloatArray) -> FloatArray:
        values = np.zeros(3)
        values[places] = own * sizes[places]
        return values

    def residuals(own: FloatArray) -> FloatArray:
        first, ratio, friction = full(own)
        return weights * (decaying_heights(first, ratio, friction, count) - heights)

    solution = least_squares(
        residuals,
        start[places] / sizes[places],
        bounds=(0.0, np.inf),
        jac="3-point",
        xtol=1e-10,
        ftol=1e-10,
        gtol=None,
    )
    used = len(places)
    total = max(float(solution.fun @ solution.fun), float(np.sum(weights**2)) * _ROUNDING * scale**2)
    variance = total / max(count - used, 1)
    if errors is not None:
        variance = max(variance, 1.0)
    found = np.zeros(3)
    found[places] = np.sqrt(variance) * _factors(np.asarray(solution.jac, np.float64)) * sizes[places]
    # The search ends just inside its bounds.
    best = np.where(solution.active_mask < 0, 0.0, solution.x)
    return _Fit(full(best), found, count * math.log(total / count) + used * math.log(count))


def _factors(jacobian: FloatArray) -> FloatArray:
    """Standard errors for residuals of 1; infinite if two parameters are indistinguishable."""
    norms = np.linalg.norm(jacobian, axis=0)
    if not np.all(norms > 0.0) or np.linalg.cond(jacobian / norms) > _CONDITION:
        return np.full(len(norms), math.inf)
    return np.asarray(np.sqrt(np.diag(np.linalg.inv(jacobian.T @ jacobian))))
