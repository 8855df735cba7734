"""The peaks of one release, measured or simulated, in the form that eqs. (9)-(12) use them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.errors import PyJoystickError
from pyjoystick.peaks import find_peaks

#: Number of peaks that eqs. (12a, b) judge: of the displacement and of the velocity.
DISPLACEMENT_PEAKS: Final = 9
VELOCITY_PEAKS: Final = 10


class PeakPairingError(PyJoystickError, ValueError):
    """Peaks of two motions cannot be paired by order and sign.

    Attributes:
        name: the motion that lacks the peak, or whose peak has the wrong sign
        series: ``displacement`` or ``velocity``
        number: number of the peak, from 1
        reason: what is wrong with it
    """

    def __init__(self, name: str, series: str, number: int, reason: str) -> None:
        super().__init__(name, series, number, reason)
        self.name = name
        self.series = series
        self.number = number
        self.reason = reason

    def __str__(self) -> str:
        return f"{self.name}: {self.series} peak {self.number} {self.reason}"


@dataclass(frozen=True, kw_only=True, eq=False)
class ReleasePeaks:
    """Release and peaks of a free oscillation.

    Attributes:
        name: what the motion is called in tables and messages
        release_time: instant of release (s)
        release_angle: angle at the release (rad)
        displacement, velocity: peaks after the release in order of time, on the same clock, with the columns
            ``time`` (s), ``value`` (rad or rad/s) and ``sign``; perhaps more columns
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
    """The average of repeated releases, peak by peak: the experiment's side of eqs. (12a, b).

    Times are averaged from the release of each trial; the average is released at time 0.

    Args:
        trials: one or more releases from the same side
        displacement_peaks: number of peaks that are averaged, from the first on
        velocity_peaks: likewise

    Raises:
        PeakPairingError: a trial has fewer peaks, or its peaks have other signs than those of the first trial
    """
    counts = {"displacement": displacement_peaks, "velocity": velocity_peaks}
    averaged = {}
    for series, count in counts.items():
        tables = [first_peaks(trial, series, count) for trial in trials]
        for trial, table in zip(trials, tables, strict=True):
            require_same_signs(trial.name, series, table, tables[0])
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


def first_peaks(peaks: ReleasePeaks, series: str, count: int) -> pd.DataFrame:
    """The first `count` peaks of a series, with ``time`` counted from the release.

    Raises:
        PeakPairingError: there are fewer
    """
    table: pd.DataFrame = getattr(peaks, series)
    if len(table) < count:
        raise PeakPairingError(peaks.name, series, len(table) + 1, f"is missing; {count} are needed")
    first = table.iloc[:count].reset_index(drop=True)
    return first.assign(time=first["time"] - peaks.release_time)


def require_same_signs(name: str, series: str, peaks: pd.DataFrame, others: pd.DataFrame) -> None:
    """Raise PeakPairingError where a peak and the one of the same number lie on different sides."""
    different = np.flatnonzero(peaks["sign"].to_numpy() != others["sign"].to_numpy())
    if different.size:
        number = int(different[0]) + 1
        raise PeakPairingError(
            name, series, number, "lies on the other side than the one it is compared with"
        )
