"""Results of a fit."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import pandas as pd

from pyjoystick.identification.fitting.checks.trust import Check
from pyjoystick.identification.fitting.checks.unseen import Unseen
from pyjoystick.identification.fitting.problem.difference_steps import StepChoice
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.problem.variables import Variable
from pyjoystick.identification.fitting.solution.bootstrap import Bootstrap
from pyjoystick.identification.fitting.solution.profile import Profile
from pyjoystick.identification.fitting.solution.search import Minimum
from pyjoystick.identification.fitting.solution.uncertainty import Identifiability, StandardErrors
from pyjoystick.support import Drawn, FloatArray


class Criteria(NamedTuple):
    """Information criteria of one fit.

    Attributes:
        log_likelihood: for white normal noise, at the fitted or given standard deviation
        parameters: number of fitted numbers, including the noise's standard deviations if estimated
        samples: number of samples
        aicc: Akaike's criterion, corrected for few samples; infinite if there are too few
        bic: Schwarz's criterion
    """

    log_likelihood: float
    parameters: int
    samples: int
    aicc: float
    bic: float


def criteria(log_likelihood: float, parameters: int, samples: int) -> Criteria:
    """Compute both criteria from the maximum of the likelihood."""
    spare = samples - parameters - 1
    correction = 2.0 * parameters * (parameters + 1) / spare if spare > 0 else math.inf
    return Criteria(
        log_likelihood,
        parameters,
        samples,
        -2.0 * log_likelihood + 2.0 * parameters + correction,
        -2.0 * log_likelihood + parameters * math.log(samples),
    )


@dataclass(frozen=True, slots=True, eq=False)
class Derived:
    """A tied parameter of the FMU, with a standard error propagated from the fitted variables.

    Attributes:
        name: the parameter
        record: the record that it belongs to; empty if all records share it
        value, error: its value and standard error
        slope: derivatives of the value with respect to the variables, shape (variables,)
    """

    name: str
    record: str
    value: float
    error: float
    slope: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class RecordFit:
    """One record and its fit.

    Attributes:
        name: name of the record
        labels: name of the series of each number, length n
        times: time of each number (s), shape (n,)
        data, predicted: measured and fitted numbers, shape (n,)
        sigma: standard deviation of the noise by series, given or estimated
        curve: the fitted motion, a table of the series every millisecond (s), NaN where samples are missing;
            None if peaks were compared
        errors: standard errors of the fitted numbers, propagated from the fitted values, shape (n,); None if
            unknown
        torque_noise: standard deviation of the noise of the torque that drives the FMU (N m), 0 if none is
            seen
    """

    name: str
    labels: tuple[str, ...]
    times: FloatArray
    data: FloatArray
    predicted: FloatArray
    sigma: dict[str, float]
    curve: pd.DataFrame | None = None
    errors: FloatArray | None = None
    torque_noise: float = 0.0

    def residuals(self) -> FloatArray:
        """Data minus prediction, shape (n,)."""
        return self.data - self.predicted


@dataclass(frozen=True, slots=True, eq=False)
class Fit(Drawn):
    """Results of a fit.

    Attributes:
        settings: settings of the fit
        variables: the fitted variables
        x: their values, shape (variables,)
        cost: sum of squares in units of the noise
        standard_errors: errors, covariance, correlations
        intervals: linear confidence intervals, shape (variables, 2)
        derived: tied parameters
        minima: the minima at which the searches ended, best first
        identifiability: what the data cannot determine
        profiles: profile likelihoods by index of the variable
        bootstrap: fits of resampled data; None if not requested
        criteria: AICc and BIC; None if peaks were compared
        records: each record and its fit
        checks: checks of whether the fit can be trusted
        steps: difference steps of the derivatives, with their errors
        correlation: correlation of the noise from sample to sample, 0 for white noise
        runs: number of FMU runs
        seconds: duration (s)
        interrupted: the fit was stopped after the search; later results are partly missing
    """

    _shown_by = "pyjoystick.identification.fitting.notebook"

    settings: FitSettings
    variables: tuple[Variable, ...]
    x: FloatArray
    cost: float
    standard_errors: StandardErrors
    intervals: FloatArray
    derived: tuple[Derived, ...]
    minima: tuple[Minimum, ...]
    identifiability: Identifiability
    criteria: Criteria | None
    records: tuple[RecordFit, ...]
    checks: tuple[Check, ...]
    steps: StepChoice
    runs: int
    seconds: float
    correlation: float = 0.0
    profiles: dict[int, Profile] = field(default_factory=dict)
    bootstrap: Bootstrap | None = None
    interrupted: bool = False

    @property
    def trusted(self) -> bool:
        """Whether all checks passed."""
        return not self.failed

    @property
    def failed(self) -> tuple[str, ...]:
        """Names of the checks that failed."""
        return tuple(check.name for check in self.checks if not check.passed)

    @property
    def unseen(self) -> tuple[Unseen, ...]:
        """Effects that may be missing from the model because the records would hardly show them."""
        return tuple(one for check in self.checks for one in check.unseen)

    def value(self, label: str) -> float:
        """Return a fitted value by label: ``damping.C`` or ``theta_start [run 1]``; KeyError if none."""
        return float(self.x[self._place(label)])

    def error(self, label: str) -> float:
        """Return the standard error of a fitted value by its label."""
        return float(self.standard_errors.errors[self._place(label)])

    def interval(self, label: str) -> tuple[float, float]:
        """Return the interval of a fitted value by its label: by profile if there is one, else linear."""
        place = self._place(label)
        if place in self.profiles and self.profiles[place].converged:
            return self.profiles[place].interval
        low, high = self.intervals[place]
        return float(low), float(high)

    def shared(self) -> dict[str, float]:
        """Fitted values that all records share, by name."""
        return {
            one.name: float(value)
            for one, value in zip(self.variables, np.asarray(self.x), strict=True)
            if one.record is None
        }

    def _place(self, label: str) -> int:
        labels = [one.label for one in self.variables]
        if label not in labels:
            raise KeyError(f"{label!r} is not among {', '.join(labels)}")
        return labels.index(label)
