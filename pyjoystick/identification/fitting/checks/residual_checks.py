"""Checks of whether residuals are noise or show something that the model lacks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy import stats

from pyjoystick.identification.fitting.checks.outliers import Outliers
from pyjoystick.identification.fitting.checks.repeats import Repeats
from pyjoystick.identification.fitting.checks.score_test import Finding, explanation
from pyjoystick.identification.fitting.checks.trust import Check
from pyjoystick.identification.fitting.checks.unseen import Unseen
from pyjoystick.support import FloatArray

#: A sound fit fails each of these checks at this rate, and "missing physics" at twice this rate.
CHANCE: Final = 5e-3
#: Numbers of lags, few for short correlations and many for slow waves, as far as the series is long enough.
_LAGS: Final = (5, 20)
_SHORTEST: Final = 10
#: Number of outliers and clipped records that are listed.
_NAMED: Final = 5
#: A series is clipped if this many samples have exactly the largest or smallest value, provided that its
#: resolution is finer than this part of the noise.
_CLIPPED: Final = 3
_FINE: Final = 0.1


class Series(NamedTuple):
    """Residuals of one series of one record, as innovations (decorrelated).

    Attributes:
        name: name of the record, and of the series if there are several
        values: in standard deviations, shape (n,)
        basis: orthonormal columns that span what was fitted, shape (n, rank)
    """

    name: str
    values: FloatArray
    basis: FloatArray


class Whiteness(NamedTuple):
    """Result of the test for correlated samples.

    Attributes:
        chance: probability that white noise looks like this
        correlation: from sample to sample, over all series
        worst: the series with the largest correlation
    """

    chance: float
    correlation: float
    worst: str


def whiteness(series: Sequence[Series]) -> Whiteness:
    """Test all series for autocorrelation: Ljung-Box for each, pooled by Fisher's method, and averaged.

    Fitting correlates residuals; the test uses their expected correlations under white noise, not zero. The
    smallest of three probabilities is multiplied by three: Fisher's with few lags (with many, the
    probabilities of single records are too small by half), averages with few and with many.
    """
    judged = [one for one in series if len(one.values) > _SHORTEST and one.values @ one.values > 0.0]
    if not judged:
        return Whiteness(1.0, 0.0, "")
    chances = []
    for most in _LAGS:
        own, total, sizes = [], np.zeros(most), np.zeros(most)
        for one in judged:
            lags = min(most, len(one.values) // 4)
            products, power = _products(one, lags)
            n = len(one.values)
            spread = n - np.arange(1.0, lags + 1.0)
            statistic = float(np.sum((products / power) ** 2 / spread)) * n * (n + 2.0)
            own.append(max(float(stats.chi2.sf(statistic, lags)), 1e-300))
            total[:lags] += products / power * n
            sizes[:lags] += spread
        if most == _LAGS[0]:
            fisher = -2.0 * float(np.sum(np.log(own)))
            chances.append(float(stats.chi2.sf(fisher, 2 * len(own))))
        used = sizes > 0.0
        pooled = float(np.sum(total[used] ** 2 / sizes[used]))
        chances.append(float(stats.chi2.sf(pooled, int(used.sum()))))
    first = {one.name: _products(one, 1) for one in judged}
    correlations = {name: float(products[0] / power) for name, (products, power) in first.items()}
    worst = max(correlations, key=lambda name: abs(correlations[name]))
    mean = sum(products[0] for products, _ in first.values()) / sum(power for _, power in first.values())
    return Whiteness(min(1.0, len(chances) * min(chances)), float(mean), worst)


def _products(one: Series, lags: int) -> tuple[FloatArray, float]:
    """Sums of lagged products minus their expectation for white noise, and the power."""
    values = one.values
    freedom = max(len(values) - float(np.sum(one.basis**2)), 1.0)
    power = float(values @ values)
    products = np.array([values[k:] @ values[:-k] for k in range(1, lags + 1)])
    fitted = np.array([np.sum(one.basis[k:] * one.basis[:-k]) for k in range(1, lags + 1)])
    return products + fitted * power / freedom, power


def check_whiteness(found: Whiteness, correlation: float) -> Check:
    """Check whether the residuals, or their innovations, look like independent samples.

    Args:
        found: autocorrelations of the residuals
        correlation: estimated correlation of the noise from sample to sample; 0 for white noise
    """
    noise = (
        f" beside noise with a correlation of {correlation:.2f} from sample to sample" if correlation else ""
    )
    if found.chance < CHANCE:
        message = (
            f"not white{noise}: {found.correlation:+.2f} from sample to sample over all records, most in "
            f"{found.worst} (chance {found.chance:.1g}): the model lacks something, or the data were filtered"
        )
        return Check("whiteness", False, message)
    return Check("whiteness", True, f"no correlation over {_LAGS[-1]} samples{noise}")


def check_repeats(repeats: Repeats, innovations: Sequence[FloatArray], shared: int, own: int) -> Check | None:
    """Check repeated records for a common deviation from the fit (lack of fit).

    An F test of the means over the repeats against their scatter; noise does not repeat itself.

    Args:
        repeats: which samples correspond
        innovations: innovations of the residuals, by record
        shared: number of variables that all records share
        own: number of variables of each record alone
    """
    if not repeats.any:
        return None
    means = repeats.means(innovations)
    between = float(np.sum(repeats.counts * means**2))
    inside = [
        one[places >= 0] for one, places in zip(repeats.deviations(innovations), repeats.places, strict=True)
    ]
    within = sum(float(one @ one) for one in inside)
    above, below = repeats_freedom(repeats, shared, own)
    if above < 1.0 or below < 1.0 or within == 0.0:
        return None
    ratio = (between / above) / (within / below)
    chance = float(stats.f.sf(ratio, above, below))
    message = f"mean over repeats against their scatter {ratio:.2f} (chance {chance:.2g})"
    if chance < CHANCE:
        message += ": the records deviate from the fit in the same way"
    return Check("lack of fit", chance >= CHANCE, message)


def repeats_freedom(repeats: Repeats, shared: int, own: int) -> tuple[float, float]:
    """Degrees of freedom of the means over repeats and of the scatter about them.

    For each repeated release, the variables of one record are subtracted from the means, and those of the
    other records from the scatter.

    Args:
        repeats: which samples correspond
        shared: number of variables that all records share
        own: number of variables of each record alone
    """
    groups, samples, releases = len(repeats.counts), float(np.sum(repeats.counts)), len(repeats.releases)
    return groups - shared - own * releases, samples - groups - own * (sum(repeats.releases) - releases)


def check_suspects(
    causes: Sequence[Finding], judged: int, imitated: Sequence[str], missed: Sequence[Unseen]
) -> Check:
    """Check whether something that the model lacks would explain the residuals better than noise.

    Args:
        causes: what would, most likely first
        judged: number of suspects that can be distinguished from the fitted variables
        imitated: names of the other suspects
        missed: effects that may be present but unseen
    """
    if causes:
        return Check("missing physics", False, f"the residuals are not noise: {explanation(causes)}")
    kinds = f"{judged} kinds of physics and instrument errors"
    text = f"none of {kinds} would explain the residuals better than noise"
    if imitated:
        text += f"; the fitted parameters could make up for {', '.join(imitated)}"
    return Check("missing physics", True, text, tuple(missed))


def check_outliers(
    found: Outliers, names: Sequence[str], times: Sequence[FloatArray], *, robust: bool
) -> Check:
    """Check whether outliers are few and have reduced weights.

    Args:
        found: the outliers
        names: names of the records
        times: times of the residuals by record (s)
        robust: whether outliers have reduced weights
    """
    places = found.places()
    if not places:
        return Check("outliers", True, "no sample is an outlier")
    largest = sorted(places, key=lambda one: -abs(one[2]))[:_NAMED]
    listed = ", ".join(f"{names[k]} at {times[k][i]:.4g} s ({size:+.1f})" for k, i, size in largest)
    text = f"{len(places)} of {sum(map(len, times))} samples are off by more than {found.limit:.1f} standard "
    text += f"deviations: {listed}{', ...' if len(places) > _NAMED else ''}"
    if not found.few:
        return Check("outliers", False, f"{text}; too many or too close together to be single faults")
    advice = "they count less or not at all" if robust else "leave them out, or let noise be robust"
    return Check("outliers", robust, f"{text}; {advice}")


def check_clipping(names: Sequence[str], data: Sequence[FloatArray], sigmas: Sequence[float]) -> Check:
    """Check whether a record stays at its largest or smallest value, as with a saturated instrument.

    Noise coarser than the resolution does not repeat a value exactly. Records without such noise are not
    judged, because they stay at the angle at which the joystick is held.

    Args:
        names: names of the series
        data: measured values, shape (n,) each
        sigmas: standard deviations of the noise
    """
    clipped = []
    for name, values, sigma in zip(names, data, sigmas, strict=True):
        steps = np.diff(np.sort(values))
        if not np.any(steps > 0.0) or float(np.min(steps[steps > 0.0])) > _FINE * sigma:
            continue
        for end in (float(np.max(values)), float(np.min(values))):
            count = int(np.count_nonzero(values == end))
            if count >= _CLIPPED:
                clipped.append(f"{name} ({count} samples at {end:.5g})")
    if clipped:
        message = (
            f"clipped: {', '.join(clipped[:_NAMED])}; leave these samples out or measure with more range"
        )
        return Check("clipping", False, message)
    return Check("clipping", True, "no record stays at its largest or smallest value")
