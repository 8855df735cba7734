"""Periodic solutions by shooting (Newton's method for fixed points of a map), and their stability."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.forced_motion.periodic.maps import Linearization, SmoothMap
from pyjoystick.support import FloatArray, PyJoystickError

#: Tolerances for the last Newton step and the residual, relative to the scales.
ACCURACY: Final = 1e-9
_MOST_STEPS: Final = 12
#: A step of more scales than this means divergence.
_FAR: Final = 50.0


@dataclass(eq=False)
class NoSolutionError(PyJoystickError, RuntimeError):
    """A search for a periodic solution did not converge.

    Attributes:
        parameter: value of the parameter at the start
        reason: what happened instead
    """

    parameter: float
    reason: str
    _message = "no periodic solution found at {parameter:.6g}: {reason}"


@dataclass(frozen=True, eq=False)
class PeriodicSolution:
    """A state that returns after one period of the map.

    Attributes:
        state: shape (n,)
        parameter: value of the parameter
        map: linearization of the map there
        residual: largest |F(x) - x|, relative to the scales
    """

    state: FloatArray
    parameter: float
    map: Linearization
    residual: float

    @cached_property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers: eigenvalues of the monodromy matrix, largest magnitude first, shape (n,)."""
        values = np.linalg.eigvals(self.map.monodromy).astype(np.complex128)
        return values[np.argsort(-np.abs(values), kind="stable")]

    @property
    def is_stable(self) -> bool:
        """Whether all multipliers are inside the unit circle."""
        return bool(np.abs(self.multipliers[0]) < 1.0)

    def exponents(self, period: float) -> NDArray[np.complex128]:
        """Floquet exponents log(multiplier)/period (1/s), shape (n,), imaginary parts up to pi/period."""
        return np.asarray(np.log(self.multipliers) / period)


def solve(smooth_map: SmoothMap, start: FloatArray, parameter: float, scales: FloatArray) -> PeriodicSolution:
    """Find the periodic solution near a state, at a fixed parameter.

    Args:
        smooth_map: the map over one period
        start: start of the search, shape (n,)
        parameter: value of the parameter
        scales: size of each state, shape (n,)

    Raises:
        NoSolutionError: Newton's method does not converge
    """
    at_parameter = np.append(np.zeros(len(start)), 1.0)
    point = np.append(start / scales, 0.0)
    found, _ = correct(smooth_map, point, at_parameter, np.append(scales, 1.0), origin=parameter)
    return found


def correct(
    smooth_map: SmoothMap,
    point: FloatArray,
    normal: FloatArray,
    scales: FloatArray,
    *,
    origin: float = 0.0,
) -> tuple[PeriodicSolution, FloatArray]:
    """Find the solution in the plane through a point of states and parameter, by Newton's method.

    Args:
        smooth_map: the map over one period
        point: states and parameter divided by `scales`, shape (n + 1,)
        normal: normal of the plane, in the same units, shape (n + 1,)
        scales: scales of states and parameter, shape (n + 1,)
        origin: origin of the parameter

    Returns:
        the solution, and the matrix of its n + 1 equations in units of the scales, with last row `normal`

    Raises:
        NoSolutionError: it does not converge
    """
    place, last = point.copy(), np.inf
    for _ in range(_MOST_STEPS):
        state, parameter = scales[:-1] * place[:-1], origin + scales[-1] * place[-1]
        here = smooth_map(state, float(parameter))
        if not (np.all(np.isfinite(here.image)) and np.all(np.isfinite(here.monodromy))):
            raise NoSolutionError(float(parameter), "a run fails near the states that were tried")
        left = (here.image - state) / scales[:-1]
        residual = float(np.max(np.abs(left)))
        if last < ACCURACY and residual < ACCURACY:
            found = PeriodicSolution(state, float(parameter), here, residual)
            return found, _equations(here, here.by_parameter(), normal, scales)
        # With a fixed parameter, the derivative with respect to it is not needed.
        slope = here.by_parameter() if np.any(normal[:-1]) else np.zeros(len(state))
        try:
            step = np.linalg.solve(
                _equations(here, slope, normal, scales), np.append(left, normal @ (point - place))
            )
        except np.linalg.LinAlgError:
            raise NoSolutionError(float(parameter), "the equations are singular") from None
        last = float(np.max(np.abs(step)))
        if not last < _FAR:
            break
        place = place + step
    reason = f"Newton's method is still {residual:.2g} of the scales away after {_MOST_STEPS} steps at most"
    raise NoSolutionError(float(origin + scales[-1] * point[-1]), reason)


def _equations(
    here: Linearization, by_parameter: FloatArray, normal: FloatArray, scales: FloatArray
) -> FloatArray:
    """Derivatives of x - F(x, p) and of the plane's equation, in units of the scales."""
    n = len(here.image)
    matrix = np.empty((n + 1, n + 1))
    matrix[:n, :n] = np.eye(n) - here.monodromy * scales[None, :n] / scales[:n, None]
    matrix[:n, n] = -by_parameter * scales[n] / scales[:n]
    matrix[n] = normal
    return matrix
