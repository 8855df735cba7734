"""The peak method of section 3.3: eq. (10) at each peak, then power laws and constants of pooled peaks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
import pandas as pd
from scipy.stats import t as student

from pyjoystick.identification.errors import DampingEstimateError
from pyjoystick.identification.peak_method.line import PowerLine, fit_power_line
from pyjoystick.model import PowerLawDamping
from pyjoystick.motion import DISPLACEMENT_PEAKS, VELOCITY_PEAKS, ReleasePeaks
from pyjoystick.support import FloatArray, positive

#: Origin of time for velocity peaks.
VelocityClock = Literal["first peak", "release"]


def displacement_points(
    peaks: ReleasePeaks, inertia: float, *, count: int = DISPLACEMENT_PEAKS
) -> pd.DataFrame:
    """Eq. (10), C = -2 J / t * ln(|theta_peak| / |theta(0)|) with t from the release, for displacement peaks.

    Args:
        peaks: peaks of one release
        inertia: moment of inertia about the pivot, J (kg m2)
        count: number of peaks to use, from the first; fewer if there are fewer

    Returns:
        one row per peak: ``record``, ``number`` (from 1), ``time`` (s from the release), ``peak`` (rad,
        signed) and ``C`` (N m s/rad), which is not positive if a peak is no lower than the release

    Raises:
        ParameterError: the inertia is not above zero
    """
    table = peaks.displacement.iloc[:count]
    time = table["time"].to_numpy() - peaks.release_time
    return _points(peaks.name, time, table["value"].to_numpy(), abs(peaks.release_angle), inertia)


def velocity_points(
    peaks: ReleasePeaks,
    inertia: float,
    *,
    count: int = VELOCITY_PEAKS,
    clock: VelocityClock = "first peak",
) -> pd.DataFrame:
    """C_exp of the velocity peaks, by the analog of eq. (10).

    The paper says only that "a similar approach" is used. The velocity is zero at the release, so something
    must take the place of theta(0). In our reading, the first velocity peak does, and gives no point itself.
    Time counts from that peak (``first peak``), which makes the formula exact for a linear joystick, as eq.
    (9) is for the displacement. If time counts from the release instead (``release``), as eq. (9) literally
    says, the early points come out too low, and the line through them falls with an exponent near the
    paper's m = -0.26 whatever the true law; the authors may well have done that.

    Args:
        peaks: peaks of one release
        inertia: moment of inertia about the pivot, J (kg m2)
        count: number of peaks to use, including the first
        clock: origin of time

    Returns:
        as `displacement_points`, with ``peak`` in rad/s and ``time`` from the chosen origin

    Raises:
        DampingEstimateError: there is no velocity peak
        ParameterError: the inertia is not above zero
    """
    table = peaks.velocity.iloc[:count]
    if table.empty:
        raise DampingEstimateError(f"{peaks.name}: no peak of the velocity stands out of the noise")
    time, value = table["time"].to_numpy(), table["value"].to_numpy()
    start = peaks.release_time if clock == "release" else float(time[0])
    points = _points(peaks.name, time[1:] - start, value[1:], abs(float(value[0])), inertia)
    return points.assign(number=points["number"] + 1)


def _points(name: str, time: FloatArray, peak: FloatArray, start: float, inertia: float) -> pd.DataFrame:
    factor = -2.0 * positive("inertia", inertia, "kg.m2")
    return pd.DataFrame(
        {
            "record": name,
            "number": np.arange(1, len(time) + 1),
            "time": time,
            "peak": peak,
            "C": factor / time * np.log(np.abs(peak) / start),
        }
    )


#: The three lines of Fig. 9.
LINES: Final = ("positive", "negative", "velocity")
#: Records that a message names; of more, it gives the number.
_NAMED: Final = 3
#: The three readings of a constant damping coefficient.
CONSTANTS: Final = ("displacement", "velocity", "both")


@dataclass(frozen=True, slots=True)
class ConstantEstimate:
    """A constant damping coefficient: mean over peaks, then over records.

    Attributes:
        value: the mean (N m s/rad)
        error: standard error from the scatter between records; None with one record
        records: number of records
    """

    value: float
    error: float | None
    records: int

    def interval(self, confidence: float = 0.95) -> tuple[float, float] | None:
        """t-based confidence interval (N m s/rad); None with one record."""
        if self.error is None:
            return None
        half = float(student.ppf(0.5 + 0.5 * confidence, self.records - 1)) * self.error
        return self.value - half, self.value + half


@dataclass(frozen=True, slots=True, eq=False)
class DampingEstimate:
    """Results of the peak method; they are biased, see `peak_method.bias`.

    Attributes:
        displacement: points of the displacement peaks, see `displacement_points`
        velocity: points of the velocity peaks, see `velocity_points`
        lines: the power lines of the displacement peaks with theta > 0 (``positive``) and theta < 0
            (``negative``) and of the velocity peaks of both signs (``velocity``)
        constants: the mean C of the ``displacement`` peaks, of the ``velocity`` peaks, and the mean of
            these two (``both``), in which their biases cancel to first order
        left_out: number of points without a logarithm (a peak no lower than the start)
    """

    displacement: pd.DataFrame
    velocity: pd.DataFrame
    lines: dict[str, PowerLine]
    constants: dict[str, ConstantEstimate]
    left_out: int

    def law(self, alpha: float) -> PowerLawDamping:
        """Eq. (11) with the coefficients and exponents of the lines.

        Raises:
            ParameterError: alpha is not between 0 and 1
        """
        positive, negative, velocity = (self.lines[name] for name in LINES)
        return PowerLawDamping(
            alpha=alpha,
            A_pos=positive.coefficient,
            n_pos=positive.exponent,
            A_neg=negative.coefficient,
            n_neg=negative.exponent,
            B=velocity.coefficient,
            m=velocity.exponent,
        )


def estimate_damping(
    releases: Sequence[ReleasePeaks],
    inertia: float,
    *,
    displacement_peaks: int = DISPLACEMENT_PEAKS,
    velocity_peaks: int = VELOCITY_PEAKS,
    clock: VelocityClock = "first peak",
) -> DampingEstimate:
    """Apply the peak method, eqs. (9) and (10) and Fig. 9, to the pooled peaks of one or more releases.

    Args:
        releases: peaks of each release, from either side
        inertia: moment of inertia about the pivot, J (kg m2)
        displacement_peaks: number of displacement peaks to use of each release
        velocity_peaks: number of velocity peaks, including the first, which takes the place of theta(0)
        clock: origin of time for velocity peaks, see `velocity_points`

    Raises:
        DampingEstimateError: no release, too few points for a line (three on either side), or peaks that do
            not fall
        ParameterError: the inertia is not above zero
    """
    if not releases:
        raise DampingEstimateError("no release is given; the peaks of one or more are needed")
    displacement = pd.concat(
        [displacement_points(one, inertia, count=displacement_peaks) for one in releases], ignore_index=True
    )
    velocity = pd.concat(
        [velocity_points(one, inertia, count=velocity_peaks, clock=clock) for one in releases],
        ignore_index=True,
    )
    sides = {
        "positive": displacement[displacement["peak"] > 0.0],
        "negative": displacement[displacement["peak"] < 0.0],
        "velocity": velocity,
    }
    usable = {name: points[points["C"] > 0.0] for name, points in sides.items()}
    names = [one.name for one in releases]
    of = ", ".join(names) if len(names) <= _NAMED else f"{len(names)} records"
    return DampingEstimate(
        displacement=displacement,
        velocity=velocity,
        lines={
            name: fit_power_line(points["peak"].abs(), points["C"], name=f"{name} peaks of {of}")
            for name, points in usable.items()
        },
        constants=_constants(displacement, velocity),
        left_out=sum(len(sides[name]) - len(usable[name]) for name in LINES),
    )


def _constants(displacement: pd.DataFrame, velocity: pd.DataFrame) -> dict[str, ConstantEstimate]:
    means = pd.DataFrame(
        {
            "displacement": displacement.groupby("record")["C"].mean(),
            "velocity": velocity.groupby("record")["C"].mean(),
        }
    )
    means["both"] = means.mean(axis=1)
    return {name: _constant(means[name]) for name in CONSTANTS}


def _constant(values: pd.Series) -> ConstantEstimate:
    count, mean = len(values), float(values.mean())
    if not mean > 0.0:
        reason = f"the {values.name} peaks do not fall: C = {values.min():.3g} N m s/rad"
        raise DampingEstimateError(f"{values.idxmin()}: {reason} (all records: {mean:.3g}), must be above 0")
    error = float(np.std(values, ddof=1)) / math.sqrt(count) if count > 1 else None
    return ConstantEstimate(mean, error, count)
