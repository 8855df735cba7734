"""Quantiles against SciPy's own distributions."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from pyjoystick.runs.sweeps.variations import Levels, LogNormal, LogUniform, Normal, Uniform

PROBABILITY = np.linspace(0.0, 1.0, 2001)[:-1]


@pytest.mark.parametrize(
    ("variation", "distribution"),
    [
        (Uniform(-2.0, 3.0), stats.uniform(-2.0, 5.0)),
        (LogUniform(0.01, 10.0), stats.loguniform(0.01, 10.0)),
        (Normal(1.0, 2.0), stats.norm(1.0, 2.0)),
        (Normal(1.0, 2.0, 0.5, 1.5), stats.truncnorm(-0.25, 0.25, 1.0, 2.0)),
        (Normal(0.0, 1.0, 0.0), stats.halfnorm()),
        (LogNormal(3.0, 0.2), stats.lognorm(0.2, scale=3.0)),
    ],
)
def test_quantiles_are_those_of_the_distribution(variation: Uniform, distribution: stats.norm) -> None:
    inner = PROBABILITY[1:]
    np.testing.assert_allclose(variation.quantile(inner), distribution.ppf(inner), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    "variation", [Normal(0.0, 1.0), LogNormal(1.0, 1.0), Normal(0.0, 1.0, -1.0, 2.0), LogUniform(1e-3, 1.0)]
)
def test_every_quantile_is_finite_and_in_order(variation: Normal) -> None:
    values = variation.quantile(np.array([0.0, 1e-300, 0.5, 1.0 - 2.0**-53]))
    assert np.all(np.isfinite(values))
    assert np.all(np.diff(values) >= 0.0)


def test_truncation_holds_at_the_ends() -> None:
    for variation in (Normal(0.0, 5.0, -1.0, 1.0), LogNormal(1.0, 5.0, 0.5, 2.0)):
        values = variation.quantile(PROBABILITY)
        assert variation.low <= values.min() < values.max() <= variation.high
    assert math.isinf(Normal(0.0, 1.0).high)


def test_levels_are_taken_equally_often() -> None:
    values, counts = np.unique(Levels((3, 1, 2)).quantile(PROBABILITY[:1998]), return_counts=True)
    assert values.tolist() == [1, 2, 3]
    assert counts.max() - counts.min() <= 3
    assert Levels((False, True)).quantile(np.array([0.0, 0.99])).tolist() == [False, True]
