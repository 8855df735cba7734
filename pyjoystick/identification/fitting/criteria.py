"""AICc and BIC: how well a model does for the number of its parameters. Lower is better."""

from __future__ import annotations

import math
from typing import NamedTuple


class Criteria(NamedTuple):
    """Information criteria of one fit.

    Attributes:
        log_likelihood: of white normal noise, at the fitted or given standard deviation
        parameters: number of fitted numbers, the noise's standard deviations included where estimated
        samples: number of samples
        aicc: Akaike's criterion with the correction for few samples; infinite where samples are too few
        bic: Schwarz's criterion
    """

    log_likelihood: float
    parameters: int
    samples: int
    aicc: float
    bic: float


def criteria(log_likelihood: float, parameters: int, samples: int) -> Criteria:
    """Both criteria from the likelihood at its maximum."""
    spare = samples - parameters - 1
    correction = 2.0 * parameters * (parameters + 1) / spare if spare > 0 else math.inf
    return Criteria(
        log_likelihood,
        parameters,
        samples,
        -2.0 * log_likelihood + 2.0 * parameters + correction,
        -2.0 * log_likelihood + parameters * math.log(samples),
    )
