"""Comparison of simulated with measured peaks, matched by order and sign, as in eqs. (12a, b)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from pyjoystick.fmu import Peaks
from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.fmu_runs import FmuSettings, run_rows
from pyjoystick.identification.fitting.problem.instrument import (
    RELEASE_TIME,
    TIME_BASE,
    ZERO_OFFSET,
    Instrument,
)
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.identification.fitting.problem.predictor import Prediction
from pyjoystick.motion import Record, measured_peaks
from pyjoystick.support import FloatArray

#: Sampling interval of runs in which peaks are found (s); `find_peaks` interpolates.
_INTERVAL: Final = 1e-3


class PeakPredictor:
    """Heights and times of the first peaks, on the record's clock.

    The release is not a peak. In both run and record, the first peak is on the opposite side of it and the
    signs alternate from there, so that the i-th peaks correspond.

    Attributes:
        normalization: divisors of the differences: the height of the measured peak, and the time since the
            previous peak (or the release, for the first), shape (2*peaks,)
        differentiable: empty, because peaks that appear or vanish have no derivative
    """

    differentiable: tuple[str, ...] = ()

    def __init__(
        self, settings: FmuSettings, record: Measurement, output: str, derivative: str, count: int
    ) -> None:
        """Find the measured peaks.

        Raises:
            FitError: there are fewer than `count`, their signs do not alternate, or the output is neither the
                angle nor its velocity
        """
        self.record = record
        self.runs = 0
        self._settings = settings
        values, times, release = _measured(record, output, count)
        self.data: FloatArray = np.concatenate((values, times))
        self.labels = (output,) * count + (f"{output} time",) * count
        self.times: FloatArray = np.tile(times, 2)
        spacing = np.diff(times, prepend=release)
        self.normalization: FloatArray = np.concatenate((np.abs(values), spacing))
        duration = float(times[-1] - release) * 1.5 + 0.2
        self._reduction = Peaks(output, count, derivative)
        self._plan = settings.fmu.plan(
            np.arange(int(duration / _INTERVAL) + 1) * _INTERVAL,
            varied=settings.varied,
            parameters=settings.constants,
            outputs=(output, derivative),
            tolerance=settings.tolerance,
        )

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        """See `Predictor`. A missing peak counts as one of zero height, late by a whole spacing."""
        runs = run_rows(self._plan, rows, self._settings, self._reduction)
        self.runs += len(rows)
        cells = runs.numbers
        late = cells[:, 1::2] / (1.0 + instrument.time_base)
        heights, times = cells[:, 0::2] + instrument.zero_offset, late + instrument.origin
        count = heights.shape[1]
        # Peaks of different signs do not correspond.
        absent = ~(np.sign(heights) == np.sign(self.data[:count]))
        latest = self.data[count:] + self.normalization[count:]
        found = np.hstack((np.where(absent, 0.0, heights), np.where(absent, latest, times)))
        # If every peak is missing, the run has failed or does not swing at all.
        found[np.all(np.isnan(cells), axis=1)] = np.nan
        there, none = np.where(absent[0], 0.0, 1.0), np.zeros(count)
        slower = np.where(absent[0], 0.0, -late[0] / (1.0 + instrument.time_base))
        slopes = {
            RELEASE_TIME: np.concatenate((none, there)),
            TIME_BASE: np.concatenate((none, slower)),
            ZERO_OFFSET: np.concatenate((there, none)),
        }
        return Prediction(found, slopes, runs.message)

    def derivatives(
        self, row: FloatArray, instrument: Instrument, *, rough: bool = False
    ) -> Mapping[str, FloatArray]:
        """See `Predictor`."""
        return {}


def missing_peaks(predicted: FloatArray) -> int:
    """Number of measured peaks missing in a prediction (heights, then times), where they are exactly zero."""
    return int(np.count_nonzero(predicted[: len(predicted) // 2] == 0.0))


def _measured(record: Measurement, output: str, count: int) -> tuple[FloatArray, FloatArray, float]:
    """Heights and times of the first peaks, and the time of release."""
    if output not in ("theta", "omega"):
        raise FitError(record.name, f"peaks of {output} cannot be measured, only those of theta and omega")
    found = measured_peaks(Record(record.name, record.time, record.series("theta"), source=record.name))
    peaks = found.displacement if output == "theta" else found.velocity
    if len(peaks) < count:
        reason = (
            f"has {len(peaks)} peaks of {output} that stand out, {count} are to be compared; ask for fewer"
        )
        raise FitError(record.name, reason)
    peaks = peaks.iloc[:count]
    signs = peaks["sign"].to_numpy()
    if np.any(signs[1:] == signs[:-1]):
        i = int(np.flatnonzero(signs[1:] == signs[:-1])[0])
        reason = (
            f"peaks {i + 1} and {i + 2} of {output} at {peaks['time'].iloc[i]:.4g} s and "
            f"{peaks['time'].iloc[i + 1]:.4g} s are on the same side: no run has such pairs"
        )
        raise FitError(record.name, reason)
    return peaks["value"].to_numpy(), peaks["time"].to_numpy(), found.release_time
