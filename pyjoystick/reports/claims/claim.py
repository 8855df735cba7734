"""Claims of the paper, their verdicts, and runs that several claims share."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import Final, cast

import numpy as np
import pandas as pd

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, STOP_ANGLE, PowerLawDamping, Trajectory, period_table
from pyjoystick.motion import ReleasePeaks, find_peaks, peaks_of_run
from pyjoystick.reports.dissipation import sampled_closely
from pyjoystick.runs import reference_free_oscillation

#: Released backward, like the paper's joystick.
RELEASE: Final = -STOP_ANGLE
#: Number of peaks compared by eqs. (12a, b).
PEAKS: Final = 9
_INTERVAL: Final = 0.25e-3
_DURATION: Final = 1.5


class Workbench:
    """Free oscillations of the paper's joystick with both damping laws, by the reference."""

    def __init__(self) -> None:
        self._smoothed: dict[float, Trajectory] = {}

    @cached_property
    def constant(self) -> pd.DataFrame:
        """Table of the run with the constant C."""
        return reference_free_oscillation(RELEASE, parameters=NOMINAL, output_interval=_INTERVAL)

    @cached_property
    def power_law(self) -> pd.DataFrame:
        """Table of the run with eq. (11) at alpha = 0.9."""
        return reference_free_oscillation(RELEASE, parameters=NOMINAL_POWER_LAW, output_interval=_INTERVAL)

    @cached_property
    def trajectory(self) -> Trajectory:
        """Run with eq. (11), sampled closely around its events and turning points."""
        return self.smoothed(1.0)

    def smoothed(self, factor: float) -> Trajectory:
        """The same, with `factor` times the smoothing of eq. (11) at zero angle and zero velocity."""
        if factor not in self._smoothed:
            law = cast("PowerLawDamping", NOMINAL_POWER_LAW.damping)
            joystick = NOMINAL_POWER_LAW.replace(
                {
                    "damping.eps_theta": factor * law.eps_theta,
                    "damping.eps_omega": factor * law.eps_omega,
                }
            )
            self._smoothed[factor] = sampled_closely(joystick, release_angle=RELEASE, duration=_DURATION)
        return self._smoothed[factor]

    @cached_property
    def constant_release(self) -> ReleasePeaks:
        """Peaks of the run with the constant C."""
        return peaks_of_run(self.constant, name="constant")

    @cached_property
    def power_law_release(self) -> ReleasePeaks:
        """Peaks of the run with eq. (11)."""
        return peaks_of_run(self.power_law, name="power law")

    def heights(self, run: pd.DataFrame) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        """Magnitudes of the release and of the first nine peaks of the angle (rad)."""
        peaks = find_peaks(run.index, run["theta"], run["omega"])
        return np.concatenate(([abs(RELEASE)], peaks["value"].abs().to_numpy()[:PEAKS]))

    @cached_property
    def periods(self) -> pd.DataFrame:
        """Undamped periods from 20 degrees down to 0.2 degrees (backward releases), by increasing amplitude.

        They are closely spaced where the balance springs engage.
        """
        angles = np.geomspace(0.2, math.degrees(STOP_ANGLE), 400), np.linspace(6.8, 7.6, 161)
        return period_table(NOMINAL, -np.radians(np.unique(np.concatenate(angles))))


class Verdict(StrEnum):
    """Agreement with a claim."""

    AGREES = "agrees"
    IN_PART = "in part"
    DISAGREES = "disagrees"
    OPEN = "cannot be checked"
    SILENT = "silent"


@dataclass(frozen=True, slots=True)
class Finding:
    """Result for one claim.

    Attributes:
        verdict: agreement, decided by numbers
        here: our result as text; the first letter may be lower-case
        remark: why it does not agree, or other remarks; sentences without the last period
    """

    verdict: Verdict
    here: str
    remark: str = ""

    @property
    def text(self) -> str:
        """The result, followed by the remark, as sentences."""
        # Capitalize, except for symbols such as f_n.
        first = re.sub(r"^[a-z](?=[a-z',]* )", lambda letter: letter[0].upper(), self.here)
        return f"{first}. {self.remark}." if self.remark else first


@dataclass(frozen=True, slots=True)
class Claim:
    """A claim of the paper and the function that checks it.

    Attributes:
        where: section, figure, table or equation of the paper
        statement: the claim in our words
        check: returns the finding, given the runs of a workbench
    """

    where: str
    statement: str
    check: Callable[[Workbench], Finding]


def claim(where: str, statement: str) -> Callable[[Callable[[Workbench], Finding]], Claim]:
    """Decorator that makes a claim from the function that checks it."""
    return lambda check: Claim(where, statement, check)


def verdict(agrees: bool, in_part: bool = False) -> Verdict:
    """Verdict from numbers: true, partly true, or false."""
    if agrees:
        return Verdict.AGREES
    return Verdict.IN_PART if in_part else Verdict.DISAGREES
