"""Predictors: the numbers that are compared with one record, for many rows of parameters at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from pyjoystick.identification.fitting.problem.instrument import Instrument
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.support import FloatArray


class Prediction(NamedTuple):
    """The numbers that are compared with one record.

    Attributes:
        values: shape (rows, n); NaN in rows whose run failed
        slopes: derivatives of the first row with respect to numbers of the instrument, shape (n,) each;
            those that act through the clock only where the derivatives of the outputs are known
        message: why the first row failed, else empty
    """

    values: FloatArray
    slopes: Mapping[str, FloatArray]
    message: str


class Predictor(Protocol):
    """Predicts what one record shows.

    Attributes:
        record: what was measured
        data: the measured numbers that a prediction is compared with, shape (n,)
        labels: name of the series that each of them belongs to, length n
        times: the instant (s) of the record that each of them belongs to, shape (n,)
        differentiable: varied parameters whose derivatives `derivatives` has
    """

    record: Measurement
    data: FloatArray
    labels: tuple[str, ...]
    times: FloatArray
    differentiable: tuple[str, ...]

    @property
    def runs(self) -> int:
        """FMU runs so far."""
        ...

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        """The prediction for rows of parameters, shape (rows, varied)."""
        ...

    def derivatives(
        self, row: FloatArray, instrument: Instrument, *, rough: bool = False
    ) -> Mapping[str, FloatArray]:
        """Derivatives of the prediction by `differentiable`, shape (n,) each; none where the run fails.

        Rough ones are good for five digits and take half the time.
        """
        ...
