"""A suspect: something that a model may lack, as the change of the residuals that it would cause."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.identification.fitting.checks.fitted_motion import FittedMotion
from pyjoystick.identification.fitting.problem.settings import Free
from pyjoystick.support import FloatArray

#: Stops and limits are tried at these parts of the largest angle on either side.
LEVELS: Final = (0.9, 0.75, 0.6)
#: A number that the fit took as known is a cause of its failure within this factor.
_CREDIBLE: Final = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class Suspect:
    """Something that the model may lack.

    Attributes:
        name: name of the suspect
        columns: columns by record
        says: part of a sentence that gives its size, from the estimates of its columns; empty if it has none
        one_sided: whether only a positive size makes sense
        own: whether each record has its own size
        free: free parameters of a fit that includes it; empty if no FMU has them, or if it is not tried
        alternatives: number of other suspects of its kind
        usual: whether most joysticks or records have it, with one sign; it is tested at a level of its own
    """

    name: str
    columns: tuple[FloatArray, ...]
    says: Callable[[FloatArray], str] = lambda sizes: ""
    one_sided: bool = False
    own: bool = False
    free: tuple[Free, ...] = ()
    alternatives: int = 1
    usual: bool = False


def each(
    motions: Sequence[FittedMotion], column: Callable[[FittedMotion], FloatArray]
) -> tuple[FloatArray, ...]:
    """One column for each motion, as a suspect needs them."""
    return tuple(column(one)[:, np.newaxis] for one in motions)


def near(name: str, value: float) -> Free:
    """A free parameter near its value in a fit; one that is not above zero keeps its usual bounds."""
    bounds = (value / _CREDIBLE, value * _CREDIBLE) if value > 0.0 else (None, None)
    return Free(name, value, *bounds)


def limits(values: Sequence[FloatArray]) -> list[float]:
    """Trial limits of the angle on either side, within the motions."""
    joined = np.concatenate(values)
    ends = (max(float(np.max(joined)), 0.0), min(float(np.min(joined)), 0.0))
    return [
        level * end for end, sign in zip(ends, (1, -1), strict=True) if sign * end > 0 for level in LEVELS
    ]


def beyond(values: FloatArray, limit: float) -> FloatArray:
    """Excess of values over a limit, on its side of zero, else 0."""
    return np.asarray(np.sign(limit) * np.maximum(np.sign(limit) * values - abs(limit), 0.0))


def largest(sizes: FloatArray) -> float:
    """The value of largest magnitude, with its sign."""
    return float(sizes[np.argmax(np.abs(sizes))])


@dataclass(frozen=True, slots=True)
class Unit:
    """Formats values of an output as text: angles in degrees."""

    output: str

    def __call__(self, value: float) -> str:
        """The number with its unit, to two digits."""
        return f"{math.degrees(value):.2g} deg" if self.output == "theta" else f"{value:.2g}"
