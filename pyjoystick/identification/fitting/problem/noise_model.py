"""Noise model: level, weights of samples, and correlation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pyjoystick.identification.fitting.problem.noise_color import Memory
from pyjoystick.identification.fitting.problem.peak_prediction import PeakPredictor
from pyjoystick.identification.fitting.problem.predictor import Predictor
from pyjoystick.identification.fitting.problem.settings import Noise
from pyjoystick.identification.fitting.problem.torque_noise import TorqueNoise, Whitener
from pyjoystick.support import FloatArray

#: Assumed noise relative to the largest value, before there is an estimate.
_FIRST_GUESS = 1e-2


@dataclass(frozen=True, slots=True, eq=False)
class NoiseModel:
    """Weighting of residuals in the sum of squares.

    Attributes:
        weights: by record, shape (n,) each; the reciprocal of the noise's standard deviation if known
        shares: further weights of residuals, by record: 1, or less for outliers
        memories: correlation structure of the noise, by record
        correlation: correlation from sample to sample in `memories`
        torques: largest noise of the measured torque, by record; empty if none is allowed for
        torque_part: part of it that the residuals show
        whiteners: filters for it, by record, computed from the other attributes; empty if the part is zero
    """

    weights: tuple[FloatArray, ...]
    shares: tuple[FloatArray, ...]
    memories: tuple[Memory, ...]
    correlation: float = 0.0
    torques: tuple[TorqueNoise, ...] = ()
    torque_part: float = 0.0
    whiteners: tuple[Whitener, ...] = field(init=False, default=())

    def __post_init__(self) -> None:
        if self.torque_part > 0.0:
            whiteners = tuple(
                Whitener(self.torque_part * self.weighted(one.effects, k))
                for k, one in enumerate(self.torques)
            )
            object.__setattr__(self, "whiteners", whiteners)

    @classmethod
    def white(cls, weights: Sequence[FloatArray]) -> NoiseModel:
        """White noise without outliers."""
        return cls(
            tuple(weights),
            tuple(np.ones(len(one)) for one in weights),
            tuple(Memory(np.zeros(len(one))) for one in weights),
        )

    def colored(self, predictors: Sequence[Predictor], correlation: float) -> NoiseModel:
        """Return the noise with this correlation within each series; 0 makes it white."""
        memories = tuple(Memory.of(one.labels, correlation) for one in predictors)
        return replace(self, memories=memories, correlation=correlation)

    def scaled(self, values: FloatArray, record: int) -> FloatArray:
        """Weighted values of one record, shape (n, ...), in which the noise of the torque is white.

        Without any noise of the torque, these are the values times weights and shares.
        """
        weighted = self.weighted(values, record)
        return self.whiteners[record].whitened(weighted) if self.whiteners else weighted

    def torque_level(self, record: int) -> float:
        """Standard deviation of the noise of the torque measured in one record (N m), 0 if there is none."""
        return self.torque_part * self.torques[record].level if self.torques else 0.0

    def drawn(self, innovations: FloatArray, record: int) -> FloatArray:
        """Noise of one record in the unit of the data that has these innovations, shape (n,)."""
        found = self.memories[record].noise(innovations)
        if self.whiteners:
            found = self.whiteners[record].colored(found)
        return np.asarray(found / self.weights[record])

    def weighted(self, values: FloatArray, record: int) -> FloatArray:
        """Values of one record in the unit of the data, shape (n, ...), times weights and shares."""
        weights = self.weights[record] * self.shares[record]
        return values * weights.reshape(-1, *(1,) * (values.ndim - 1))

    def counted(self, values: FloatArray, record: int) -> FloatArray:
        """As `scaled`, then decorrelated: as values enter the sum of squares."""
        return self.memories[record].innovations(self.scaled(values, record))


def relative_sizes(predictor: Predictor) -> FloatArray:
    """Unit of each residual: the noise is `sigma` times this, shape (n,)."""
    if isinstance(predictor, PeakPredictor):
        return predictor.normalization
    return np.ones(len(predictor.data))


def first_noise(predictors: Sequence[Predictor], noise: Noise) -> NoiseModel:
    """White noise before the first search, with exact weights if its standard deviation is given."""
    found = []
    for predictor in predictors:
        labels = np.array(predictor.labels)
        sigma = np.full(len(labels), _FIRST_GUESS)
        # Errors of peaks are relative already; heights and times count alike.
        for label in dict.fromkeys(predictor.labels if not isinstance(predictor, PeakPredictor) else ()):
            # One size for all records, so that none counts more before the noise is estimated.
            largest = max(_largest(other, label) for other in predictors)
            sigma[labels == label] = noise.sigma.get(label, _FIRST_GUESS * largest)
        found.append(1.0 / (sigma * relative_sizes(predictor)))
    return NoiseModel.white(found)


def weights_of(
    predictors: Sequence[Predictor], sigmas: Sequence[Mapping[str, float]]
) -> tuple[FloatArray, ...]:
    """Weights that express residuals in standard deviations.

    Args:
        predictors: one for each record
        sigmas: standard deviations by series, for each record
    """
    return tuple(
        1.0 / (np.array([sigma[label] for label in predictor.labels]) * relative_sizes(predictor))
        for predictor, sigma in zip(predictors, sigmas, strict=True)
    )


def _largest(predictor: Predictor, label: str) -> float:
    inside = np.array(predictor.labels) == label
    if not inside.any():
        return 0.0
    return float(np.max(np.abs(predictor.data[inside])))
