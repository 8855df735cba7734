"""Peaks of a measured or simulated release, and the errors of eqs. (12a, b) between two releases."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.motion.peaks import find_peaks
from pyjoystick.support import PyJoystickError

#: Numbers of peaks that eqs. (12a, b) compare: of the displacement and of the velocity.
DISPLACEMENT_PEAKS: Final = 9
VELOCITY_PEAKS: Final = 10


@dataclass(eq=False)
class PeakPairingError(PyJoystickError, ValueError):
    """Peaks of two motions cannot be paired by order and sign.

    Attributes:
        name: the motion that lacks the peak, or whose peak has the wrong sign
        series: ``displacement`` or ``velocity``
        number: number of the peak, from 1
        reason: what is wrong with it
    """

    name: str
    series: str
    number: int
    reason: str
    _message = "{name}: {series} peak {number} {reason}"


@dataclass(frozen=True, kw_only=True, eq=False)
class ReleasePeaks:
    """Release and peaks of a free oscillation.

    Attributes:
        name: name of the motion in tables and messages
        release_time: time of release (s)
        release_angle: angle at the release (rad)
        displacement, velocity: peaks after the release in order of time, on the same clock, with the columns
            ``time`` (s), ``value`` (rad or rad/s) and ``sign``, and possibly others
    """

    name: str
    release_time: float
    release_angle: float
    displacement: pd.DataFrame
    velocity: pd.DataFrame


def peaks_of_run(run: pd.DataFrame, *, name: str = "simulation") -> ReleasePeaks:
    """Peaks of a simulated free oscillation that starts with the release.

    Args:
        run: table over ``time`` (s) with ``theta`` (rad), ``omega`` (rad/s) and ``alpha`` (rad/s2)
        name: name of the motion
    """
    return ReleasePeaks(
        name=name,
        release_time=float(run.index[0]),
        release_angle=float(run["theta"].iloc[0]),
        displacement=find_peaks(run.index, run["theta"], run["omega"]),
        velocity=find_peaks(run.index, run["omega"], run["alpha"]),
    )


def average_peaks(
    trials: Sequence[ReleasePeaks],
    *,
    displacement_peaks: int = DISPLACEMENT_PEAKS,
    velocity_peaks: int = VELOCITY_PEAKS,
) -> ReleasePeaks:
    """Average repeated releases, peak by peak: the experiment's side of eqs. (12a, b).

    Times are averaged relative to the release of each trial; the average is released at time 0.

    Args:
        trials: one or more releases from the same side
        displacement_peaks: number of peaks to average, from the first
        velocity_peaks: the same for velocity peaks

    Raises:
        PeakPairingError: a trial has fewer peaks, or its peaks differ in sign from those of the first trial
    """
    counts = {"displacement": displacement_peaks, "velocity": velocity_peaks}
    averaged = {}
    for series, count in counts.items():
        tables = [_first_peaks(trial, series, count) for trial in trials]
        for trial, table in zip(trials, tables, strict=True):
            _require_same_signs(trial.name, series, table, tables[0])
        averaged[series] = pd.DataFrame(
            {
                column: np.mean([table[column].to_numpy() for table in tables], axis=0)
                for column in ("time", "value")
            }
        ).assign(sign=tables[0]["sign"].to_numpy())
    return ReleasePeaks(
        name=f"average of {len(trials)}",
        release_time=0.0,
        release_angle=float(np.mean([trial.release_angle for trial in trials])),
        displacement=averaged["displacement"],
        velocity=averaged["velocity"],
    )


def _first_peaks(peaks: ReleasePeaks, series: str, count: int) -> pd.DataFrame:
    """The first `count` peaks of a series, with ``time`` relative to the release.

    Raises:
        PeakPairingError: there are fewer
    """
    table: pd.DataFrame = getattr(peaks, series)
    if len(table) < count:
        raise PeakPairingError(peaks.name, series, len(table) + 1, f"is missing; {count} are needed")
    first = table.iloc[:count].reset_index(drop=True)
    return first.assign(time=first["time"] - peaks.release_time)


def _require_same_signs(name: str, series: str, peaks: pd.DataFrame, others: pd.DataFrame) -> None:
    """Raise PeakPairingError if peaks with the same number are on different sides."""
    different = np.flatnonzero(peaks["sign"].to_numpy() != others["sign"].to_numpy())
    if different.size:
        number = int(different[0]) + 1
        raise PeakPairingError(
            name, series, number, "lies on the opposite side to the peak that it is compared with"
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
    """Compute eqs. (12a, b), with peaks paired by their order after the release and their sign.

    eps = 1/n * sum |y_i - y^_i| / |y^_i| and 1/n * sum |t_i - t^_i| / (t^_i - t^_(i-1)), with the hat for the
    measurement. The paper's denominator y^_i is taken as a magnitude, because half of the peaks are negative.
    It does not define t^_0; here it is the time of release, from which all times count, for
    displacement and velocity alike. The first velocity peak comes half as long after the release as the
    interval between later ones, so an error of its time has double weight.

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
    """Compute the errors over a parameter, as in Fig. 11.

    Args:
        values: values of the parameter
        simulate: returns the peaks of the simulation at a value
        measured: peaks of the experiment

    Returns:
        one row per value, which is the index, with the fields of `PeakErrors` (percent) as columns

    Raises:
        PeakPairingError: the peaks of a simulation cannot be paired with the measured ones
    """
    found = {value: asdict(peak_errors(simulate(value), measured)) for value in values}
    return pd.DataFrame.from_dict(found, orient="index")


def minima(sweep: pd.DataFrame) -> pd.DataFrame:
    """Minimum of each error in a sweep: one row per error, columns ``at`` and ``error`` (percent)."""
    return pd.DataFrame({"at": sweep.idxmin(), "error": sweep.min()})


def _errors(simulated: ReleasePeaks, measured: ReleasePeaks, series: str, count: int) -> tuple[float, float]:
    """Eq. (12a) and eq. (12b) of one series, in percent."""
    ours, theirs = _first_peaks(simulated, series, count), _first_peaks(measured, series, count)
    _require_same_signs(simulated.name, series, ours, theirs)
    time, value = theirs["time"].to_numpy(), theirs["value"].to_numpy()
    heights = np.abs(ours["value"].to_numpy() - value) / np.abs(value)
    times = np.abs(ours["time"].to_numpy() - time) / np.diff(time, prepend=0.0)
    return 100.0 * float(np.mean(heights)), 100.0 * float(np.mean(times))
