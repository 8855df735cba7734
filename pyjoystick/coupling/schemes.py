"""How a master lets its FMUs pass from one communication point to the next.

Within a step an FMU knows its inputs by what the master tells it beforehand. What that is decides the order
of the coupling error in the step's length H.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np

from pyjoystick._types import FloatArray
from pyjoystick.coupling.errors import CouplingError
from pyjoystick.coupling.network import Network

#: The end of an iterated step agrees with the one before it to so much of itself, or absolutely.
_RELATIVE, _ABSOLUTE = 1e-9, 1e-12
_MOST_ITERATIONS: Final = 50


@dataclass(slots=True)
class Past:
    """What a scheme remembers of the step before: its length (s) and the signals at its beginning."""

    length: float
    signals: FloatArray


#: Goes on to a communication point (s) and returns what the next step may want to know.
Advance = Callable[[Network, float, float, Past | None], Past]


@dataclass(frozen=True, slots=True)
class Scheme:
    """A way of coupling.

    Attributes:
        advance: function of the network, the step's beginning and end (s) and the past
        needs_rates: the FMUs must follow input derivatives
        description: a line on it
    """

    advance: Advance
    needs_rates: bool
    description: str


def _hold(network: Network, begin: float, end: float, past: Past | None) -> Past:
    signals = network.exchange()
    network.step(end)
    return Past(end - begin, signals)


def _extrapolate(network: Network, begin: float, end: float, past: Past | None) -> Past:
    signals = network.exchange()
    network.set_rates(_rates(signals, past))
    network.step(end)
    return Past(end - begin, signals)


def _iterate(network: Network, begin: float, end: float, past: Past | None) -> Past:
    signals = network.exchange()
    length = end - begin
    at_end = signals + length * _rates(signals, past)
    saved = network.save()
    try:
        for _ in range(_MOST_ITERATIONS):
            network.set(signals)
            network.set_rates((at_end - signals) / length)
            network.step(end)
            before, at_end = at_end, network.exchange()
            if np.allclose(before, at_end, rtol=_RELATIVE, atol=_ABSOLUTE):
                return Past(length, signals)
            network.restore(saved)
    finally:
        network.forget(saved)
    reason = f"no convergence in {_MOST_ITERATIONS} iterations; take shorter steps"
    raise CouplingError(network.system.name, f"the step from {begin:g} s to {end:g} s", reason)


def _rates(signals: FloatArray, past: Past | None) -> FloatArray:
    """Rates of the signals over the step before; none at the beginning."""
    return np.zeros_like(signals) if past is None else (signals - past.signals) / past.length


#: The schemes by name.
SCHEMES: Final = MappingProxyType(
    {
        "hold": Scheme(_hold, False, "inputs keep the value of the step's beginning: error of order H"),
        "extrapolate": Scheme(
            _extrapolate, True, "inputs go on in line with the step before, by input derivatives: order H^2"
        ),
        "iterate": Scheme(
            _iterate,
            True,
            "the step is repeated from the saved FMU states until inputs that lead straight to its end agree "
            "with what the FMUs answer there: order H^2, and stable at longer steps",
        ),
    }
)
