"""Measured parameter values, ready for a parameter file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from pyjoystick.model import PLAIN_TABLES

#: Places of the single-number quantities in a parameter file.
PLACES: Final = {key: f"{table}.{key}" for table, keys in PLAIN_TABLES.items() for key in keys}


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredValues:
    """Values of parameters.

    Attributes:
        values: by FMU name, in SI units, to a hundredth of their standard uncertainty or better
        uncertainties: standard uncertainties (SI units) by place in a parameter file
        sources: where they come from, by table of a parameter file
    """

    values: Mapping[str, float]
    uncertainties: Mapping[str, float]
    sources: Mapping[str, str]

    def with_more(self, other: MeasuredValues) -> MeasuredValues:
        """Combine these values with those of another measurement."""
        return MeasuredValues(
            values={**self.values, **other.values},
            uncertainties={**self.uncertainties, **other.uncertainties},
            sources={**self.sources, **other.sources},
        )
