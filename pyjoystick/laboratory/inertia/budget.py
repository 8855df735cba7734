"""Propagation of uncertainty according to the GUM (JCGM 100:2008, clauses 5 and 6)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

from scipy.stats import t as student

from pyjoystick.support import finite

_LEVEL: Final = 0.95


@dataclass(frozen=True, slots=True)
class Measured:
    """A quantity with its standard uncertainty.

    Attributes:
        value: in SI units
        uncertainty: standard uncertainty, same unit
        freedom: degrees of freedom of the uncertainty; infinite unless it comes from a few readings
    """

    value: float
    uncertainty: float = 0.0
    freedom: float = math.inf


@dataclass(frozen=True, slots=True)
class Estimate:
    """A result with its uncertainty budget.

    Attributes:
        value: in SI units
        uncertainty: combined standard uncertainty
        freedom: effective degrees of freedom (Welch and Satterthwaite)
        budget: contribution of each quantity to the standard uncertainty, in the unit of the result
    """

    value: float
    uncertainty: float
    freedom: float
    budget: Mapping[str, float]

    @property
    def interval(self) -> tuple[float, float]:
        """The 95 % interval."""
        factor = float(student.ppf(0.5 + _LEVEL / 2.0, self.freedom))
        return self.value - factor * self.uncertainty, self.value + factor * self.uncertainty


def combined(function: Callable[..., float], quantities: Mapping[str, Measured]) -> Estimate:
    """Evaluate a function of independent quantities, with the contribution of each to its uncertainty.

    The uncertainty is the root mean square of the function's deviation from its value, to second order. With
    half the change D from one standard uncertainty below to one above, and the second difference C, a
    quantity shifts the mean by C/2 and adds D^2 + C^2/2 to the variance. At a minimum, only C remains: m*x^2
    at x = 0 has the mean m*u^2 and the standard deviation sqrt(2)*m*u^2. The sum of the shifts counts as an
    error and does not change the value, because its sign depends on what x is: a measured x scatters about
    the true one, the true one about a nominal x.

    Args:
        function: function of the quantities by name
        quantities: measured independently of each other

    Raises:
        ParameterError: a value or uncertainty is not a finite number
    """
    for name, one in quantities.items():
        finite(name, one.value)
        finite(f"u({name})", one.uncertainty)
    values = {name: one.value for name, one in quantities.items()}
    value = function(**values)
    first, second = {}, {}
    for name, one in quantities.items():
        high = function(**(values | {name: one.value + one.uncertainty}))
        low = function(**(values | {name: one.value - one.uncertainty}))
        first[name], second[name] = (high - low) / 2.0, (high - value) - (value - low)
    shift = sum(second.values()) / 2.0
    # Each has its share of the square of the whole shift.
    squares = {name: first[name] ** 2 + C**2 / 2.0 + C / 2.0 * shift for name, C in second.items()}
    budget = {name: math.sqrt(max(0.0, square)) for name, square in squares.items()}
    uncertainty = math.hypot(*budget.values())
    spread = sum(budget[name] ** 4 / one.freedom for name, one in quantities.items())
    freedom = uncertainty**4 / spread if spread > 0.0 else math.inf
    return Estimate(value, uncertainty, freedom, budget)
