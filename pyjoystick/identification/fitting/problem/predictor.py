"""Predictors: the numbers to compare with one record, for several rows of parameters at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from pyjoystick.identification.fitting.problem.instrument import Instrument
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.support import FloatArray


class Prediction(NamedTuple):
    """The numbers to compare with one record.

    Attributes:
        values: shape (rows, n); NaN in rows whose run failed
        slopes: derivatives of the first row with respect to the instrument's numbers, shape (n,) each;
            those that act through the clock only if the derivatives of the outputs are known
        message: why the first row failed, else empty
    """

    values: FloatArray
    slopes: Mapping[str, FloatArray]
    message: str


class Predictor(Protocol):
    """Predicts the readings of one record.

    Attributes:
        record: the measured record
        data: measured numbers that a prediction is compared with, shape (n,)
        labels: name of the series that each of them belongs to, length n
        times: time (s) in the record that each of them belongs to, shape (n,)
        differentiable: varied parameters for which `derivatives` works
    """

    record: Measurement
    data: FloatArray
    labels: tuple[str, ...]
    times: FloatArray
    differentiable: tuple[str, ...]

    @property
    def runs(self) -> int:
        """Number of FMU runs so far."""
        ...

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        """The prediction for rows of parameters, shape (rows, varied)."""
        ...

    def derivatives(
        self, row: FloatArray, instrument: Instrument, *, rough: bool = False
    ) -> Mapping[str, FloatArray]:
        """Derivatives of the prediction by `differentiable`, shape (n,) each; none if the run fails.

        Rough ones are accurate to five digits and take half the time.
        """
        ...
