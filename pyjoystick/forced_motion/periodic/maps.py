"""Maps from a state to the state one period later, and their derivatives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from pyjoystick.support import FloatArray

#: Maps states (runs, n), for a value of the parameter, to the states one period later (runs, n).
Images = Callable[[FloatArray, float], FloatArray]
#: The same -> these states, and their derivatives by the states before (runs, n, n).
Tangents = Callable[[FloatArray, float], tuple[FloatArray, FloatArray]]


@dataclass(frozen=True, slots=True, eq=False)
class Linearization:
    """Linearization of a map x -> F(x, p) at a point.

    Attributes:
        image: F, shape (n,)
        monodromy: dF/dx, shape (n, n)
        by_parameter: gives dF/dp, shape (n,), when it is asked for
        error: largest error of the elements of `monodromy` as estimated, in units in which the scales of all
            states are 1; None where they are no differences but as exact as the map
    """

    image: FloatArray
    monodromy: FloatArray
    by_parameter: Callable[[], FloatArray]
    error: float | None


#: Linearizes the map at a state (n,), for a value of the parameter.
SmoothMap = Callable[[FloatArray, float], Linearization]


class CentralDifferences:
    """Derivatives of a map from runs near a point, extrapolated from two steps (Richardson).

    With the steps h and h/2 the result is accurate to fourth order in h where the map is smooth. The error
    estimate is a third of the difference between the two central differences; it is too large rather than too
    small, and includes the noise of the runs.
    """

    def __init__(self, images: Images, scales: FloatArray, parameter_scale: float, *, step: float) -> None:
        """Set the steps.

        Args:
            images: the map, for many states at once
            scales: size of each state, shape (n,)
            parameter_scale: size of the parameter
            step: h relative to these sizes
        """
        self._images = images
        self._scales = scales
        self._steps = step * scales
        self._parameter_step = step * parameter_scale

    def __call__(self, state: FloatArray, parameter: float) -> Linearization:
        """Linearize at a point with 4 n + 1 runs, plus one on demand for the derivative by the parameter."""
        n = len(state)
        beside = np.diag(self._steps)
        offsets = np.concatenate((np.zeros((1, n)), beside, -beside, 0.5 * beside, -0.5 * beside))
        images = self._images(state + offsets, parameter)
        up, down, half_up, half_down = images[1:].reshape(4, n, n)
        # Row i of the images belongs to state i; transposed, it becomes a column of the matrix.
        wide = ((up - down) / (2.0 * self._steps[:, None])).T
        narrow = ((half_up - half_down) / self._steps[:, None]).T
        difference = (narrow - wide) * self._scales[None, :] / self._scales[:, None]
        return Linearization(
            image=images[0],
            monodromy=(4.0 * narrow - wide) / 3.0,
            by_parameter=partial(self.by_parameter, state, parameter, images[0]),
            error=float(np.max(np.abs(difference))) / 3.0,
        )

    def by_parameter(self, state: FloatArray, parameter: float, image: FloatArray) -> FloatArray:
        """A one-sided difference: it points the way along a branch, and no result contains it."""
        beside = self._images(state[None, :], parameter + self._parameter_step)[0]
        slope: FloatArray = (beside - image) / self._parameter_step
        return slope
