"""The least-squares problem: weighted residuals and their derivatives."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from pyjoystick.identification.fitting.problem.difference_steps import FIRST_STEP
from pyjoystick.identification.fitting.problem.forward_model import ForwardModel
from pyjoystick.identification.fitting.problem.noise_model import NoiseModel
from pyjoystick.identification.fitting.problem.predictor import Predictor
from pyjoystick.identification.fitting.problem.variables import Variables
from pyjoystick.support import FloatArray

#: If the FMU fails, residuals are set to this multiple of the data, so that no search ends there.
_FAILED: Final = 1e3


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """Residuals r(x) = weight*share*(prediction - data), one block per record.

    For autocorrelated noise, residuals are innovations. Prior knowledge of variables is appended:
    (x - measured)/uncertainty.

    A problem is immutable. Each stage of a fit derives the next problem from it by `dataclasses.replace`:
    with other steps, with the noise that the residuals show, or with resampled data. All share the model.

    Attributes:
        model: the forward model
        noise: model of the noise
        data: measured numbers, by record
        measured: prior measurements, by variable; only those with an uncertainty count
        steps: difference steps, relative to the scale of each variable, shape (variables,)
    """

    model: ForwardModel
    noise: NoiseModel
    data: tuple[FloatArray, ...]
    measured: FloatArray
    steps: FloatArray

    @classmethod
    def of(cls, model: ForwardModel, noise: NoiseModel) -> Problem:
        """The initial problem: data of the records, start values of variables, first steps."""
        return cls(
            model,
            noise,
            tuple(predictor.data for predictor in model.predictors),
            np.array(model.variables.start),
            np.full(len(model.variables.free), FIRST_STEP),
        )

    @property
    def variables(self) -> Variables:
        """Meaning of x."""
        return self.model.variables

    @property
    def predictors(self) -> tuple[Predictor, ...]:
        """Predictors, one for each record."""
        return self.model.predictors

    def predictions(self, x: FloatArray) -> list[FloatArray]:
        """Predictions at x by record; raises FitError if a run fails."""
        return self.model.predictions(x)

    @property
    def size(self) -> int:
        """Number of residuals with nonzero weight."""
        return sum(
            int(np.count_nonzero(weight * share))
            for weight, share in zip(self.noise.weights, self.noise.shares, strict=True)
        )

    @property
    def terms(self) -> int:
        """Number of residuals with nonzero weight, including those of prior knowledge."""
        return self.size + len(self.prior)

    @property
    def prior(self) -> FloatArray:
        """Derivatives of the prior-knowledge residuals, shape (known, variables)."""
        uncertainties = np.array([one.uncertainty or math.inf for one in self.variables.free])
        return np.asarray(np.diag(1.0 / uncertainties)[np.isfinite(uncertainties)])

    def residuals(self, x: FloatArray) -> FloatArray:
        """All weighted residuals, shape (samples of all records + known variables,).

        A failing run gives residuals of a thousand times the data, so that a search turns back.
        """
        found = []
        for k, data in enumerate(self.data):
            residuals = self.model.at(x, k).values[0] - data
            failed = _FAILED * float(np.max(np.abs(data)))
            found.append(self.noise.counted(np.where(np.isfinite(residuals), residuals, failed), k))
        return np.concatenate((*found, self.prior @ (x - self.measured)))

    def jacobian(self, x: FloatArray, *, central: bool = True) -> FloatArray:
        """Derivatives of all residuals, shape (samples of all records + known variables, variables).

        Args:
            x: the point
            central: use second-order derivatives; see `ForwardModel.jacobian`
        """
        blocks = self.jacobians(x, central=central)
        return np.concatenate((*(self.noise.counted(block, k) for k, block in enumerate(blocks)), self.prior))

    def jacobians(self, x: FloatArray, *, central: bool = True) -> list[FloatArray]:
        """Derivatives of the predictions in the unit of the data, one array per record."""
        return [self.model.jacobian(x, k, self.steps, central=central) for k in range(len(self.predictors))]

    def with_weights(self, weights: tuple[FloatArray, ...]) -> Problem:
        """Return the problem with other weights of the residuals, by record."""
        return replace(self, noise=replace(self.noise, weights=weights))
