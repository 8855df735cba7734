"""Coupling schemes: how a master steps its FMUs from one communication point to the next.

Within a step, an FMU knows only what the master has set about its inputs. This determines the order of the
coupling error in the step length H.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np

from pyjoystick.fmu import REALS, UnsupportedFmuError
from pyjoystick.runs.coupling.network import Network
from pyjoystick.runs.errors import CouplingError
from pyjoystick.support import FloatArray

#: Relative and absolute tolerance for the agreement of two iterations at the end of a step.
_RELATIVE, _ABSOLUTE = 1e-9, 1e-12
_MOST_ITERATIONS: Final = 50


@dataclass(slots=True, eq=False)
class Past:
    """Memory of the previous step: its length (s) and the signals at its start."""

    length: float
    signals: FloatArray


#: Steps the FMUs from a communication point to another (s), given the signals at the first.
Advance = Callable[[Network, float, float, FloatArray, Past | None], None]


@dataclass(frozen=True, slots=True)
class Scheme:
    """A coupling scheme.

    Attributes:
        name: in `SCHEMES`
        description: one line
        advance: makes one step
        exchange: copies outputs to inputs before a step and returns the signals
        needs_rates: FMUs with real inputs must use input derivatives, which FMI 3.0 does not have
        needs_states: the FMUs must save and restore their state
    """

    name: str
    description: str
    advance: Advance
    exchange: Callable[[Network], FloatArray]
    needs_rates: bool = False
    needs_states: bool = False

    def require(self, network: Network) -> None:
        """Raise `UnsupportedFmuError` if an FMU does not support what the scheme needs."""
        for participant in network.participants.values():
            description = participant.description
            has_real_inputs = any(variable.type in REALS for variable in participant.inputs)
            if self.needs_rates and has_real_inputs and not description.interpolates_inputs:
                lacking = "does not follow input derivatives (canInterpolateInputs of FMI 2.0)"
            elif self.needs_states and not description.saves_states:
                lacking = "cannot save and restore its state (canGetAndSetFMUState)"
            else:
                continue
            simple = [one.name for one in SCHEMES.values() if not (one.needs_rates or one.needs_states)]
            reason = f"{lacking}, which scheme {self.name!r} needs; {' and '.join(simple)} do not"
            raise UnsupportedFmuError(description.path, reason)


def _hold(network: Network, begin: float, end: float, signals: FloatArray, past: Past | None) -> None:
    network.step(end)


def _extrapolate(network: Network, begin: float, end: float, signals: FloatArray, past: Past | None) -> None:
    network.set_rates(_rates(signals, past))
    network.step(end)


def _iterate(network: Network, begin: float, end: float, signals: FloatArray, past: Past | None) -> None:
    length = end - begin
    at_end = signals + length * _rates(signals, past)
    saved = network.save()
    try:
        # Broyden's method for: outputs at the end of the step = outputs assumed there. The first correction
        # is a plain fixed-point iteration.
        jacobian: FloatArray = -np.eye(len(signals))
        correction: FloatArray = np.zeros_like(signals)
        residual: FloatArray = np.zeros_like(signals)
        for _ in range(_MOST_ITERATIONS):
            network.set(signals)
            network.set_rates((at_end - signals) / length)
            network.step(end)
            before, residual = residual, network.exchange() - at_end
            if np.all(np.abs(residual) <= _RELATIVE * np.abs(at_end) + _ABSOLUTE):
                return
            network.restore(saved)
            if correction.any():
                miss = residual - before - jacobian @ correction
                jacobian += np.outer(miss, correction) / (correction @ correction)
            correction = np.asarray(np.linalg.solve(jacobian, -residual), dtype=np.float64)
            at_end = at_end + correction
        reason = f"no convergence in {_MOST_ITERATIONS} iterations; take shorter steps"
    except np.linalg.LinAlgError:
        reason = "the signals of the loop do not determine each other (gain of 1)"
    finally:
        network.forget(saved)
    raise CouplingError(network.system.name, f"the step from {begin:g} s to {end:g} s", reason)


def _rates(signals: FloatArray, past: Past | None) -> FloatArray:
    """Rates of the signals over the previous step; zero at the start."""
    return np.zeros_like(signals) if past is None else (signals - past.signals) / past.length


_SCHEMES: Final = (
    Scheme(
        "delay",
        "outputs are copied once, so that direct feedthrough is late by a step; order H",
        _hold,
        Network.copy,
    ),
    Scheme("hold", "inputs keep their value during a step; order H", _hold, Network.exchange),
    Scheme(
        "extrapolate",
        "inputs go on in line with the step before, by input derivatives; order H^2",
        _extrapolate,
        Network.exchange,
        needs_rates=True,
    ),
    Scheme(
        "iterate",
        "steps are repeated from saved states until the inputs lead straight to what the FMUs answer at "
        "their end; order H^2, and stable at longer steps",
        _iterate,
        Network.exchange,
        needs_rates=True,
        needs_states=True,
    ),
)
#: Schemes by name.
SCHEMES: Final = MappingProxyType({scheme.name: scheme for scheme in _SCHEMES})
