"""The errors of eqs. (12a, b): how far simulated peaks lie from measured ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass

import numpy as np
import pandas as pd

from pyjoystick.release_peaks import (
    DISPLACEMENT_PEAKS,
    VELOCITY_PEAKS,
    ReleasePeaks,
    first_peaks,
    require_same_signs,
)


@dataclass(frozen=True, slots=True)
class PeakErrors:
    """Average relative errors of peaks, in percent.

    Attributes:
        displacement: eq. (12a) of the displacement peaks
        displacement_time: eq. (12b) of their times
        velocity: eq. (12a) of the velocity peaks
        velocity_time: eq. (12b) of their times
    """

    displacement: float
    displacement_time: float
    velocity: float
    velocity_time: float


def peak_errors(
    simulated: ReleasePeaks,
    measured: ReleasePeaks,
    *,
    displacement_peaks: int = DISPLACEMENT_PEAKS,
    velocity_peaks: int = VELOCITY_PEAKS,
) -> PeakErrors:
    """Eqs. (12a, b), with peaks paired by their order after the release and their sign.

    eps = 1/n * sum |y_i - y^_i| / |y^_i| and 1/n * sum |t_i - t^_i| / (t^_i - t^_(i-1)), the hat for the
    measurement. The paper's denominator y^_i is taken as a magnitude, for half of the peaks are negative.
    t^_0 is not defined there; it is taken as the instant of release, from which all times count, for
    displacement and velocity alike. The first velocity peak comes half as long after the release as later
    ones after one another, so that an error of its time weighs double.

    Args:
        simulated: peaks of the simulation
        measured: peaks of the experiment, the average of its trials (see `average_peaks`)
        displacement_peaks: n for the displacement
        velocity_peaks: n for the velocity

    Raises:
        PeakPairingError: one side has fewer peaks, or a pair differs in sign
    """
    displacement = _errors(simulated, measured, "displacement", displacement_peaks)
    return PeakErrors(*displacement, *_errors(simulated, measured, "velocity", velocity_peaks))


def sweep_peak_errors(
    values: Iterable[float], simulate: Callable[[float], ReleasePeaks], measured: ReleasePeaks
) -> pd.DataFrame:
    """The errors over a parameter, as in Fig. 11.

    Args:
        values: values of the parameter
        simulate: the peaks of the simulation at a value
        measured: peaks of the experiment

    Returns:
        one row a value, which is the index, with the fields of `PeakErrors` (percent) as columns

    Raises:
        PeakPairingError: the peaks of a simulation cannot be paired with the measured ones
    """
    found = {value: asdict(peak_errors(simulate(value), measured)) for value in values}
    return pd.DataFrame.from_dict(found, orient="index")


def minima(sweep: pd.DataFrame) -> pd.DataFrame:
    """Where each error of a sweep is smallest: one row an error, columns ``at`` and ``error`` (percent)."""
    return pd.DataFrame({"at": sweep.idxmin(), "error": sweep.min()})


def _errors(simulated: ReleasePeaks, measured: ReleasePeaks, series: str, count: int) -> tuple[float, float]:
    """Eq. (12a) and eq. (12b) of one series, in percent."""
    ours, theirs = first_peaks(simulated, series, count), first_peaks(measured, series, count)
    require_same_signs(simulated.name, series, ours, theirs)
    time, value = theirs["time"].to_numpy(), theirs["value"].to_numpy()
    heights = np.abs(ours["value"].to_numpy() - value) / np.abs(value)
    times = np.abs(ours["time"].to_numpy() - time) / np.diff(time, prepend=0.0)
    return 100.0 * float(np.mean(heights)), 100.0 * float(np.mean(times))
