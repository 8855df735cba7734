"""Bias of the peak method.

Eq. (9) holds for a linear joystick. With restrained preloaded springs, the amplitude decays differently: for
a potential V ~ |theta|^s the virial theorem gives the kinetic energy the share s/(s + 2) of E on average, so
that E decays as exp(-2 C/J * s/(s + 2) * t), the angle as E^(1/s) and the velocity as E^(1/2). Eq. (10) then
returns 4/(s + 2) * C from displacement peaks and 2 s/(s + 2) * C from velocity peaks: a third too much and a
third too little if the preload alone holds the joystick (s = 1), and C itself if the spring is linear
(s = 2). The mean of the two is C for any s.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np
import pandas as pd
from scipy.optimize import brentq

from pyjoystick.identification.errors import DampingEstimateError
from pyjoystick.identification.peak_method.estimate import CONSTANTS, LINES, DampingEstimate, estimate_damping
from pyjoystick.model import ConstantDamping, JoystickParameters
from pyjoystick.motion import MeasuredPeaks, ReleasePeaks
from pyjoystick.support import SimulationError

#: Returns the peaks of a joystick released at an angle (rad).
Simulate = Callable[[JoystickParameters, float], ReleasePeaks]
#: The corrected C is searched for between these multiples of the estimate.
_SOUGHT: Final = (0.4, 2.5)


@dataclass(frozen=True, slots=True)
class Bias:
    """An estimate, and what the method would return if it were the truth.

    Attributes:
        estimate: from the records
        returned: result of the method for a simulation with the estimate
        corrected: for a constant C, the value whose simulation returns the estimate; for a coefficient or an
            exponent, the estimate minus its bias, which for coefficients is a factor
    """

    estimate: float
    returned: float
    corrected: float

    @property
    def bias(self) -> float:
        """Error that the method adds to the truth."""
        return self.returned - self.estimate


def constant_bias(
    estimate: DampingEstimate, joystick: JoystickParameters, release_angle: float, simulate: Simulate
) -> dict[str, Bias]:
    """Bias of each reading of a constant C, by simulation.

    Args:
        estimate: from the records
        joystick: the joystick; its damping law is replaced
        release_angle: release angle of the simulation (rad), ideally the mean of the records'
        simulate: returns the peaks of a release

    Returns:
        bias by reading: ``displacement``, ``velocity`` and ``both``

    Raises:
        DampingEstimateError: no C between 0.4 and 2.5 times the estimate returns it
    """

    def returned(C: float, name: str) -> float:  # noqa: N803 - the name of the quantity
        damped = dataclasses.replace(joystick, damping=ConstantDamping(C=C))
        found = estimate_damping([simulate(damped, release_angle)], damped.J)
        return found.constants[name].value

    biases = {}
    for name in CONSTANTS:
        value = estimate.constants[name].value
        low, high = (part * value for part in _SOUGHT)
        if not (returned(low, name) < value < returned(high, name)):
            raise DampingEstimateError(
                f"no constant C from {low:.3g} to {high:.3g} returns {name} = {value:.4g}"
            )
        corrected = brentq(
            lambda trial, name=name, value=value: returned(trial, name) - value, low, high, xtol=1e-6
        )
        biases[name] = Bias(value, returned(value, name), float(corrected))
    return biases


def line_bias(
    estimate: DampingEstimate, joystick: JoystickParameters, release_angle: float, simulate: Simulate
) -> dict[str, Bias]:
    """Bias of the lines' coefficients and exponents, by their names in the damping law.

    The displacement lines account for all the damping, and so does the velocity line: the law is simulated
    with alpha = 1 for the former and alpha = 0 for the latter.

    Args:
        estimate: from the records
        joystick: the joystick; its damping law is replaced
        release_angle: release angle of the simulation (rad)
        simulate: returns the peaks of a release

    Raises:
        DampingEstimateError: the law of the lines cannot be simulated, or its simulation has too few peaks

    Returns:
        bias by name: ``A_pos``, ``n_pos``, ``A_neg``, ``n_neg``, ``B``, ``m``
    """
    names = dict(zip(LINES, (("A_pos", "n_pos"), ("A_neg", "n_neg"), ("B", "m")), strict=True))
    biases = {}
    for alpha, lines in ((1.0, LINES[:2]), (0.0, LINES[2:])):
        damped = dataclasses.replace(joystick, damping=estimate.law(alpha))
        try:
            found = estimate_damping([simulate(damped, release_angle)], damped.J)
        except (SimulationError, DampingEstimateError) as error:
            exponents = ", ".join(f"{names[one][1]} = {estimate.lines[one].exponent:.3g}" for one in lines)
            # The peaks of the records were enough for lines: the error is of the simulated ones.
            failed, cause = "swings too little for its bias", "dry friction or a zero offset"
            if isinstance(error, SimulationError):
                failed, cause = "cannot be simulated", "a zero offset"
            reason = f"a joystick with {exponents} {failed}: have the records {cause}? ({error})"
            raise DampingEstimateError(reason) from error
        for line in lines:
            ours, theirs = estimate.lines[line], found.lines[line]
            coefficient, exponent = names[line]
            factor = ours.coefficient / theirs.coefficient
            biases[coefficient] = Bias(ours.coefficient, theirs.coefficient, ours.coefficient * factor)
            biases[exponent] = Bias(ours.exponent, theirs.exponent, 2.0 * ours.exponent - theirs.exponent)
    return biases


def biases(
    estimate: DampingEstimate,
    joystick: JoystickParameters,
    releases: Iterable[MeasuredPeaks],
    simulate: Simulate,
) -> tuple[dict[str, Bias], dict[str, Bias]]:
    """`constant_bias` and `line_bias` at the mean release angle; raises as they do."""
    angle = float(np.mean([release.release_angle for release in releases]))
    return constant_bias(estimate, joystick, angle, simulate), line_bias(estimate, joystick, angle, simulate)


def bias_table(
    joystick: JoystickParameters,
    values: Iterable[float],
    release_angles: Iterable[float],
    simulate: Simulate,
) -> pd.DataFrame:
    """Results of the method for simulations with known constant C.

    Args:
        joystick: the joystick; its damping law is replaced
        values: true C (N m s/rad)
        release_angles: release angles (rad)
        simulate: returns the peaks of a release

    Returns:
        one row per combination: ``C`` and ``release_angle``, the estimates ``displacement``, ``velocity``
        and ``both`` as fractions of the true C, and the exponents ``n_pos``, ``n_neg``, ``m`` of the lines,
        which should be 0
    """
    rows = []
    for value in values:
        damped = dataclasses.replace(joystick, damping=ConstantDamping(C=value))
        for angle in release_angles:
            found = estimate_damping([simulate(damped, angle)], damped.J)
            law = found.law(1.0)
            parts = {name: found.constants[name].value / value for name in CONSTANTS}
            exponents = {"n_pos": law.n_pos, "n_neg": law.n_neg, "m": law.m}
            rows.append({"C": value, "release_angle": angle} | parts | exponents)
    return pd.DataFrame(rows)
