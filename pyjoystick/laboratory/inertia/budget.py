"""Propagation of uncertainty according to the GUM (JCGM 100:2008, clauses 5 and 6)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

from scipy.stats import t as student

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

    A contribution is half the change of the function from one standard uncertainty below to one above.

    Args:
        function: function of the quantities by name
        quantities: measured independently of each other
    """
    values = {name: one.value for name, one in quantities.items()}
    budget = {}
    for name, one in quantities.items():
        high = function(**(values | {name: one.value + one.uncertainty}))
        low = function(**(values | {name: one.value - one.uncertainty}))
        budget[name] = abs(high - low) / 2.0
    uncertainty = math.hypot(*budget.values())
    spread = sum(budget[name] ** 4 / one.freedom for name, one in quantities.items())
    freedom = uncertainty**4 / spread if spread > 0.0 else math.inf
    return Estimate(function(**values), uncertainty, freedom, budget)
