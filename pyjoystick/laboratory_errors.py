"""What the uncertainty of each measured quantity makes of a run, and of the parameters fitted to records.

Each quantity alone is moved by its standard uncertainty, those of a load-deflection curve along the principal
axes of their covariance: the sum of squares over the axes is the linear propagation of all of it.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.fitting import RELEASE, Fit, FitSettings, Free, Uncertainty, fit
from pyjoystick.fitting.joystick_values import with_values
from pyjoystick.fmu import Fmu
from pyjoystick.load_curve import LoadCurveFit
from pyjoystick.measurement_errors import mean_period
from pyjoystick.parameters import ActuatorAssembly, JoystickParameters, Side
from pyjoystick.records import Record
from pyjoystick.reference import simulate
from pyjoystick.report import markdown_table

#: What `refit` finds.
FITTED: Final = ("J", "damping.C")
_TIME: Final = np.arange(901) / 600.0


@dataclass(frozen=True, slots=True)
class Contribution:
    """What a stage contributes; NaN where it has no part in that.

    Attributes:
        stage: what it is
        theta, omega: root mean square error of the angle and its velocity from the release to 1.5 s after it
            (rad, rad/s)
        period: of the mean of the first three periods, in parts of it
        J, C: of the fitted moment of inertia and damping coefficient, in parts of them
    """

    stage: str
    theta: float = math.nan
    omega: float = math.nan
    period: float = math.nan
    J: float = math.nan
    C: float = math.nan


def curve_axes(joystick: JoystickParameters, side: Side, curve: LoadCurveFit) -> list[JoystickParameters]:
    """Joysticks whose curve of one side is off by one standard deviation along each axis of its covariance.

    Args:
        joystick: the joystick
        side: of the curve
        curve: its fit, of four segments

    Raises:
        ParameterError: the curve is so uncertain that one of them cannot be
    """
    values = np.array((*curve.table.x, *curve.table.k))
    # The stiffnesses are a billion times the travels, which would hide those from the eigenvectors.
    deviations = np.sqrt(np.diag(curve.covariance)[:8])
    correlation = curve.covariance[:8, :8] / np.outer(deviations, deviations)
    sizes, axes = np.linalg.eigh(correlation)
    moved = []
    for size, axis in zip(np.maximum(sizes, 0.0), axes.T, strict=True):
        x, k = np.split(values + math.sqrt(size) * axis * deviations, 2)
        actuator = ActuatorAssembly.from_table(x.tolist(), k.tolist())
        forward, backward = joystick.forward, joystick.backward
        forward, backward = (actuator, backward) if side == "forward" else (forward, actuator)
        moved.append(dataclasses.replace(joystick, forward=forward, backward=backward))
    return moved


def run_contribution(
    stage: str, joystick: JoystickParameters, moved: Sequence[JoystickParameters], *, release_angle: float
) -> Contribution:
    """What runs of moved joysticks differ by, as the root of the sum of squares over them.

    Raises:
        ParameterError, SimulationError: as `simulate` does
    """
    runs = [simulate(one, time=_TIME, theta_start=release_angle) for one in (joystick, *moved)]
    exact, period = runs[0], mean_period(_TIME, runs[0].theta)
    squares = [
        (
            float(np.mean((run.theta - exact.theta) ** 2)),
            float(np.mean((run.omega - exact.omega) ** 2)),
            (mean_period(_TIME, run.theta) / period - 1.0) ** 2,
        )
        for run in runs[1:]
    ]
    return Contribution(stage, *map(float, np.sqrt(np.sum(squares, axis=0))))


def refit(records: Sequence[Record], joystick: JoystickParameters, fmu: Fmu) -> Fit:
    """J and C fitted to records with all else as a joystick has it.

    Raises:
        FitError: as `fit` does
    """
    free = (*map(Free, FITTED), *RELEASE)
    settings = FitSettings(fmu="Joystick", free=free, uncertainty=Uncertainty(profiles=()))
    return fit(records, with_values(settings, joystick.to_names()), fmu=fmu)


def with_fitted(contribution: Contribution, before: Fit, moved: Sequence[Fit]) -> Contribution:
    """The contribution with what J and C differ by, as the root of the sum of squares."""
    parts = [
        math.sqrt(sum((one.value(name) / before.value(name) - 1.0) ** 2 for one in moved)) for name in FITTED
    ]
    return dataclasses.replace(contribution, J=parts[0], C=parts[1])


def noise_contribution(
    stage: str, joystick: JoystickParameters, found: Fit, *, release_angle: float
) -> Contribution:
    """What the standard errors of a fit make of a run, and those of J and C, whose correlation counts.

    Raises:
        ParameterError, SimulationError: as `simulate` does
    """
    values = np.array([found.value(name) for name in FITTED])
    sizes, axes = np.linalg.eigh(found.standard_errors.covariance[:2, :2] / np.outer(values, values))
    moved = [
        joystick.replace(dict(zip(FITTED, values * (1.0 + math.sqrt(size) * axis), strict=True)))
        for size, axis in zip(sizes, axes.T, strict=True)
    ]
    errors = [found.error(name) / found.value(name) for name in FITTED]
    run = run_contribution(stage, joystick, moved, release_angle=release_angle)
    return dataclasses.replace(run, J=errors[0], C=errors[1])


def contribution_table(contributions: Sequence[Contribution]) -> str:
    """The contributions as a table in Markdown, and the root of the sum of squares of those to J and C."""

    def cell(value: float, digits: int) -> str:
        return "" if math.isnan(value) else f"{value:.{digits}f}"

    rows = [
        [
            one.stage,
            cell(math.degrees(one.theta), 3),
            cell(one.omega, 4),
            *(cell(100.0 * value, 3) for value in (one.period, one.J, one.C)),
        ]
        for one in contributions
    ]
    whole = [
        math.sqrt(sum(getattr(one, name) ** 2 for one in contributions if not math.isnan(getattr(one, name))))
        for name in ("J", "C")
    ]
    rows.append(["all", "", "", "", *(cell(100.0 * value, 3) for value in whole)])
    header = ["stage", "theta, rms (deg)", "omega, rms (rad/s)", "period (%)", "fitted J (%)", "fitted C (%)"]
    return markdown_table(header, rows)
