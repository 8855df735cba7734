"""Checks that decide whether a fit can be trusted."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import stats

from pyjoystick.identification.fitting.checks.unseen import Unseen
from pyjoystick.identification.fitting.problem.variables import Variable, Variables
from pyjoystick.identification.fitting.solution.profile import Profile
from pyjoystick.identification.fitting.solution.search import OF_EITHER_SIGN, Minimum
from pyjoystick.identification.fitting.solution.uncertainty import Identifiability
from pyjoystick.support import FloatArray

#: A sound fit of white noise fails a test of the residuals once in this many fits.
_CHANCE: Final = 1e-3
#: An offset of more than this many standard errors is not chance.
_OFFSET: Final = 4.0
#: Limit of the difference between records and prior measurement, in standard errors: exceeded by chance for
#: one in a hundred known parameters.
_FAR: Final = 2.576
#: Records that reduce the variance of a prior measurement by less than this part have no say about it.
_SAYING: Final = 1e-3
#: Residuals above this part of the largest measured value are not noise.
_LARGE: Final = 0.05
#: Average error of peaks above which they do not agree.
_LARGE_PEAK_ERROR: Final = 0.2
#: A variable this close to a bound, relative to its scale, is at the bound.
_AT_BOUND: Final = 1e-6
#: A sum of squares lower by this, in variances of the noise, belongs to another minimum.
_UNDERCUT: Final = 0.01
#: A minimum that is higher by less, in variances of the noise, cannot be excluded: three standard errors.
_ALIKE: Final = 9.0


@dataclass(frozen=True, slots=True)
class Check:
    """One reason for or against trusting a fit.

    Attributes:
        name: name of the check
        passed: whether it passed
        message: what was found, and what to do if it failed
        unseen: what a check that passed may have missed
    """

    name: str
    passed: bool
    message: str
    unseen: tuple[Unseen, ...] = ()


def check_convergence(minimum: Minimum) -> Check:
    """Check whether the search converged."""
    advice = "" if minimum.converged else ": allow more evaluations or begin nearer"
    return Check("converged", minimum.converged, f"{minimum.message}{advice}")


def check_bounds(variables: Variables, x: FloatArray) -> Check:
    """Check whether a variable ended at one of its bounds."""
    at = [
        f"{one.label} = {one.lowest if value - one.lowest <= one.highest - value else one.highest:.6g}"
        for one, value in zip(variables.free, x, strict=True)
        if min(value - one.lowest, one.highest - value) <= _AT_BOUND * one.scale
    ]
    message = (
        f"at a bound: {', '.join(at)}; widen it, or fit without the parameter"
        if at
        else "no variable at a bound"
    )
    return Check("bounds", not at, message)


def check_sign(variables: Variables, minima: Sequence[Minimum]) -> Check | None:
    """Check whether the records determine the sign of a fitted initial velocity; None if none is fitted."""
    places = [j for j, one in enumerate(variables.free) if one.name == OF_EITHER_SIGN]
    if not places:
        return None
    best, *others = minima
    for other in others:
        j = next((j for j in places if other.x[j] * best.x[j] < 0.0), None)
        if j is not None and other.cost - best.cost < _ALIKE:
            message = (
                f"{variables.free[j].label} = {other.x[j]:.3g} explains the records almost as well as "
                f"{best.x[j]:.3g} (sum of squares larger by {other.cost - best.cost:.2g} variances of the "
                "noise): give it a bound of 0 on one side, or measure the velocity"
            )
            return Check("sign", False, message)
    return Check("sign", True, "the records determine the sign of the initial velocity")


def check_rank(known: Identifiability) -> Check:
    """Check whether the data determine every variable."""
    if known.deficient:
        return Check("rank", False, f"rank {known.rank} of {known.variables}: " + "; ".join(known.sentences))
    return Check("rank", True, f"full rank, {known.rank}; condition {known.condition:.3g}")


def check_precision(variables: Sequence[Variable], x: FloatArray, errors: FloatArray) -> Check:
    """Check whether every standard error is below the value itself.

    Values of a record or an instrument are exempt, because they may well be zero.
    """
    poor = [
        f"{one.label} = {value:.4g} +- {error:.2g}"
        for one, value, error in zip(variables, x, errors, strict=True)
        if math.isfinite(error) and error > abs(value) and one.record is None and not one.of_instrument
    ]
    if poor:
        message = f"practically undetermined at this noise: {', '.join(poor)}; fix them or measure more"
        return Check("precision", False, message)
    return Check("precision", True, "every standard error is below the value itself")


def check_known(variables: Sequence[Variable], x: FloatArray, errors: FloatArray) -> Check:
    """Check whether the records agree with prior measurements.

    A precise prior pulls the fit towards itself, so it is compared with what the records alone give.
    """
    found = [
        (one.label, away_from_known(one, value, error))
        for one, value, error in zip(variables, x, errors, strict=True)
        if one.uncertainty is not None
    ]
    far = [f"{name} by {away:+.1f}" for name, away in found if away is not None and abs(away) > _FAR]
    if far:
        message = f"the records alone differ from it, in standard errors: {', '.join(far)}"
        return Check("known values", False, message)
    return Check("known values", True, "the records agree with what was measured beforehand")


def away_from_known(one: Variable, x: float, error: float) -> float | None:
    """Difference between the records alone and a prior measurement, in standard errors.

    The fit is the weighted mean of both, so x - measured has the variance u^2 - error^2. None if there is no
    prior measurement or the records say next to nothing about the parameter.
    """
    if one.uncertainty is None:
        return None
    rest = one.uncertainty**2 - error**2
    return (x - one.start) / math.sqrt(rest) if rest > _SAYING * one.uncertainty**2 else None


def check_chi_squared(cost: float, freedom: int) -> Check:
    """Check whether the residuals are as small as the given noise.

    Args:
        cost: sum of squares in units of the noise
        freedom: number of samples minus number of variables
    """
    chance = float(stats.chi2.sf(cost, freedom))
    message = f"chi-squared {cost:.4g} for {freedom} degrees of freedom (chance {chance:.2g})"
    if chance <= _CHANCE:
        message += ": more than the given noise; the model lacks something, or the noise is larger"
    return Check("size of residuals", chance > _CHANCE, message)


def check_size(residuals: Sequence[FloatArray], data: Sequence[FloatArray]) -> Check:
    """Check whether the residuals are small, if the noise is unknown.

    Args:
        residuals: data minus prediction, by record
        data: measured values
    """
    parts = [
        float(np.sqrt(np.mean(one * one)) / np.max(np.abs(values)))
        for one, values in zip(residuals, data, strict=True)
    ]
    message = f"root mean square {100.0 * max(parts):.2g} % of the largest value, in the worst record"
    return Check("size of residuals", max(parts) < _LARGE, message)


def check_peak_errors(relative: Sequence[FloatArray]) -> Check:
    """Check whether the peaks agree as well as the paper's: within 20 % on average.

    Args:
        relative: relative errors of heights and times by record
    """
    worst = max(float(np.mean(np.abs(one))) for one in relative)
    message = f"heights and times differ by {100.0 * worst:.2g} % on average, in the worst record"
    return Check("size of residuals", worst < _LARGE_PEAK_ERROR, message)


def check_zero(offsets: Sequence[tuple[Variable, float, float]]) -> Check:
    """Check for records with a zero offset, which the fit corrects.

    Args:
        offsets: each variable with its value and its standard error
    """
    angle = [f"{one.label} = {_amount(one, value)} +- {_amount(one, error)}" for one, value, error in offsets]
    off = [
        text
        for text, (_, value, error) in zip(angle, offsets, strict=True)
        if error < math.inf and abs(value) > _OFFSET * error
    ]
    if off:
        return Check("zero offset", True, f"{', '.join(off)}: the zero of the record is off; corrected")
    return Check("zero offset", True, "no record has a significant zero offset")


def _amount(one: Variable, value: float) -> str:
    """A value with its unit, angles in degrees."""
    return f"{math.degrees(value):.3g} deg" if one.unit == "rad" else f"{value:.3g} {one.unit}".rstrip()


def check_profiles(labels: Sequence[str], profiles: Mapping[int, Profile]) -> Check:
    """Check whether the profiles confirm the minimum and could be followed."""
    undercut = [f"{labels[j]} (by {one.lower:.2g})" for j, one in profiles.items() if one.lower > _UNDERCUT]
    lost = [labels[j] for j, one in profiles.items() if not one.converged]
    if undercut:
        message = f"the profile of {', '.join(undercut)} lies below the minimum: start the search elsewhere"
        return Check("profiles", False, message)
    if lost:
        message = f"searches along the profile of {', '.join(lost)} did not converge: it gives no interval"
        return Check("profiles", False, message)
    return Check("profiles", True, "no profile undercuts the minimum")


def check_peaks(missing: Sequence[tuple[str, int]]) -> Check:
    """Check whether the run has a peak for every measured one."""
    lacking = [f"{count} of {name}" for name, count in missing if count]
    if lacking:
        message = f"the run has no peak to pair with {', '.join(lacking)}"
        return Check("peaks", False, message)
    return Check("peaks", True, "the run has a peak for every measured one")
