"""Parameters that were measured and are fitted freely too: where the two values cannot both be right."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from pyjoystick.laboratory import Estimate, Measured
from pyjoystick.model import rounded, rounded_error

#: Combined standard uncertainties by which two right values differ once in 400 times.
_LIMIT: Final = 3.0
#: What misleads a fit by more than its residuals show: time and angle enter every sample alike.
_CLOCK_AND_SCALE: Final = "the clock of the records, the scale of their angle"


@dataclass(frozen=True, slots=True)
class Contradiction:
    """Two values of a parameter that differ by more than their uncertainties.

    Attributes:
        name: in the FMU
        fitted, measured: with standard uncertainties (SI units)
        source: what the measured one is from
    """

    name: str
    fitted: Measured
    measured: Measured
    source: str

    @property
    def apart(self) -> float:
        """How far, in combined standard uncertainties."""
        return combined_uncertainties_apart(self.fitted, self.measured)

    @property
    def short(self) -> str:
        """For the source of the number in a parameter file."""
        return (
            f"{self.name} is {self.apart:.1f} combined standard uncertainties off the {self.source}, "
            f"{_text(self.measured)}"
        )

    @property
    def sentence(self) -> str:
        """What contradicts what, and what to look at first."""
        # The swing test gives J in proportion to h, and the records weigh the joystick by it.
        last = "h" if self.name == "J" else f"the measurement of {self.name}"
        return (
            f"{self.name} = {_text(self.fitted)} of the fit contradicts {_text(self.measured)} of the "
            f"{self.source}: {self.apart:.1f} combined standard uncertainties apart. Check "
            f"{_CLOCK_AND_SCALE} and {last}"
        )


def combined_uncertainties_apart(one: Measured | Estimate, other: Measured | Estimate) -> float:
    """The difference of independent values in combined standard uncertainties; NaN where both are exact."""
    combined = math.hypot(one.uncertainty, other.uncertainty)
    return abs(one.value - other.value) / combined if combined > 0.0 else math.nan


def contradictions(
    fitted: Mapping[str, Measured], measured: Mapping[str, tuple[Measured, str]]
) -> Iterator[Contradiction]:
    """Parameters whose fitted value cannot be the measured one.

    Args:
        fitted: what was fitted without regard to its measurement, by FMU name
        measured: measured values and what they are from; one without an uncertainty contradicts nothing
    """
    for name in fitted:
        value, source = measured.get(name, (Measured(math.nan), ""))
        if value.uncertainty > 0.0 and combined_uncertainties_apart(fitted[name], value) > _LIMIT:
            yield Contradiction(name, fitted[name], value, source)


def _text(one: Measured) -> str:
    return f"{rounded(one.value, one.uncertainty):.9g} +- {rounded_error(one.uncertainty):g}"
