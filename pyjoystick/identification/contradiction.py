"""Contradictions between the measured and the fitted value of a parameter."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from pyjoystick.laboratory import Estimate, Measured
from pyjoystick.model import rounded, rounded_error

#: Limit in combined standard uncertainties; values that agree exceed it by chance once in 400 times.
_LIMIT: Final = 3.0
#: Scale and time base bias a fit without showing in its residuals, because they affect all samples alike.
_CLOCK_AND_SCALE: Final = "the clock of the records, the scale of their angle"


@dataclass(frozen=True, slots=True)
class Contradiction:
    """A measured and a fitted value that differ by more than their uncertainties allow.

    Attributes:
        name: parameter of the FMU
        fitted, measured: the values with their standard uncertainties (SI units)
        source: where the measured value comes from
    """

    name: str
    fitted: Measured
    measured: Measured
    source: str

    @property
    def apart(self) -> float:
        """Difference in combined standard uncertainties."""
        return combined_uncertainties_apart(self.fitted, self.measured)

    @property
    def short(self) -> str:
        """Short form, for the source of the number in a parameter file."""
        return (
            f"{self.name} is {self.apart:.1f} combined standard uncertainties off the {self.source}, "
            f"{_text(self.measured)}"
        )

    @property
    def sentence(self) -> str:
        """Describe the contradiction and suggest what to check first."""
        # J from a swing test is proportional to h, and fits use h for the weight's moment.
        last = "h" if self.name == "J" else f"the measurement of {self.name}"
        return (
            f"{self.name} = {_text(self.fitted)} of the fit contradicts {_text(self.measured)} of the "
            f"{self.source}: {self.apart:.1f} combined standard uncertainties apart. Check "
            f"{_CLOCK_AND_SCALE} and {last}"
        )


def combined_uncertainties_apart(one: Measured | Estimate, other: Measured | Estimate) -> float:
    """Difference of independent values in combined standard uncertainties; NaN if both are exact."""
    combined = math.hypot(one.uncertainty, other.uncertainty)
    return abs(one.value - other.value) / combined if combined > 0.0 else math.nan


def contradictions(
    fitted: Mapping[str, Measured], measured: Mapping[str, tuple[Measured, str]]
) -> Iterator[Contradiction]:
    """Find parameters whose fitted and measured values disagree.

    Args:
        fitted: values fitted without using their measurement, by FMU name
        measured: measured values and their sources; values without an uncertainty are skipped
    """
    for name in fitted:
        value, source = measured.get(name, (Measured(math.nan), ""))
        if value.uncertainty > 0.0 and combined_uncertainties_apart(fitted[name], value) > _LIMIT:
            yield Contradiction(name, fitted[name], value, source)


def _text(one: Measured) -> str:
    return f"{rounded(one.value, one.uncertainty):.9g} +- {rounded_error(one.uncertainty):g}"
