"""Checks of the residuals: are they noise, or something that the model lacks."""

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

#: A sound fit fails each of these checks in this part of all cases, "missing physics" in twice as many.
CHANCE: Final = 5e-3
#: Numbers of lags, short for single samples and long for slow waves, as far as a series has room for them.
_LAGS: Final = (5, 20)
_SHORTEST: Final = 10
#: Outliers and clipped records that are named.
_NAMED: Final = 5
#: So many samples at the very largest or smallest value are clipped, if the resolution is finer than this
#: part of the noise.
_CLIPPED: Final = 3
_FINE: Final = 0.1


class Series(NamedTuple):
    """The residuals of one series of one record, each what is new in it.

    Attributes:
        name: of the record, and the series if there are several
        values: in standard deviations, shape (n,)
        basis: orthonormal columns that span what was fitted, shape (n, rank)
    """

    name: str
    values: FloatArray
    basis: FloatArray


class Whiteness(NamedTuple):
    """Whether samples depend on each other.

    Attributes:
        chance: that white noise looks like this
        correlation: from sample to sample, over all series
        worst: the series with the largest correlation
    """

    chance: float
    correlation: float
    worst: str


def whiteness(series: Sequence[Series]) -> Whiteness:
    """Autocorrelations of all series: each by Ljung and Box, pooled by Fisher's method, and averaged.

    What fitting takes away from the correlations is taken into account: their expectations under white noise
    are those of residuals, and not zero. The least of three chances counts three times: Fisher's with few
    lags (with many, the chances of single records are too small by half), averages with few and with many.
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
    """Sums of products of samples some lags apart, less what they would be for white noise, and the power."""
    values = one.values
    freedom = max(len(values) - float(np.sum(one.basis**2)), 1.0)
    power = float(values @ values)
    products = np.array([values[k:] @ values[:-k] for k in range(1, lags + 1)])
    fitted = np.array([np.sum(one.basis[k:] * one.basis[:-k]) for k in range(1, lags + 1)])
    return products + fitted * power / freedom, power


def check_whiteness(found: Whiteness, correlation: float) -> Check:
    """Whether the residuals look like independent samples, or what is new in them does.

    Args:
        found: their autocorrelations
        correlation: of the noise from sample to sample as it was estimated; 0 for white noise
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
    """Whether records that repeat each other deviate from the fit in the same way (lack of fit).

    The mean over the repeats against their scatter (F test): noise does not repeat itself.

    Args:
        repeats: which samples belong together
        innovations: residuals by record, each what is new in it
        shared: number of variables that all records share
        own: number of variables that each record has for itself
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
    """Degrees of freedom of the means over repeats and of the scatter around them.

    Each release that was repeated takes the variables of one record from the means, those of the other
    records from the scatter.

    Args:
        repeats: which samples belong together
        shared: number of variables that all records share
        own: number of variables that each record has for itself
    """
    groups, samples, releases = len(repeats.counts), float(np.sum(repeats.counts)), len(repeats.releases)
    return groups - shared - own * releases, samples - groups - own * (sum(repeats.releases) - releases)


def check_suspects(
    causes: Sequence[Finding], judged: int, imitated: Sequence[str], missed: Sequence[Unseen]
) -> Check:
    """Whether something that the model lacks would explain the residuals better than noise.

    Args:
        causes: what would, most likely first
        judged: how many suspects could be told from the fitted variables
        imitated: names of the others
        missed: what may be there all the same, unseen
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
    """Whether outliers are few, and were given less weight.

    Args:
        found: the outliers
        names: of the records
        times: instants of the residuals by record (s)
        robust: whether they count less
    """
    places = found.places()
    if not places:
        return Check("outliers", True, "no sample is out of line")
    largest = sorted(places, key=lambda one: -abs(one[2]))[:_NAMED]
    listed = ", ".join(f"{names[k]} at {times[k][i]:.4g} s ({size:+.1f})" for k, i, size in largest)
    text = f"{len(places)} of {sum(map(len, times))} samples are off by more than {found.limit:.1f} standard "
    text += f"deviations: {listed}{', ...' if len(places) > _NAMED else ''}"
    if not found.few:
        return Check("outliers", False, f"{text}; too many or too close together to be single faults")
    advice = "they count less or not at all" if robust else "leave them out, or let noise be robust"
    return Check("outliers", robust, f"{text}; {advice}")


def check_clipping(names: Sequence[str], data: Sequence[FloatArray], sigmas: Sequence[float]) -> Check:
    """Whether a record stays at its largest or smallest value, as a saturated instrument does.

    Noise that is finer than its resolution does not give the same value twice. Records without such noise are
    not judged: they do stay at the angle at which they were held.

    Args:
        names: of the series
        data: what was measured, shape (n,) each
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
