"""Error budget: how the uncertainty of each measured quantity affects a run and the fitted parameters.

Each quantity is moved by its standard uncertainty, one at a time. Load-deflection curves are moved along the
principal axes of their covariance; the sum of squares over the axes is its full linear propagation.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu
from pyjoystick.identification.bench import UNCERTAIN, Bench
from pyjoystick.identification.fitting.fit import fit, fitted_values
from pyjoystick.identification.fitting.problem.joystick_settings import RELEASE, scaled_forces
from pyjoystick.identification.fitting.problem.known_values import with_values
from pyjoystick.identification.fitting.problem.settings import FitSettings, Free, Noise, Search, Uncertainty
from pyjoystick.identification.fitting.result import Fit
from pyjoystick.identification.swing_estimate import with_estimated_starts
from pyjoystick.laboratory import REST_TIME, LoadCurveFit, mean_period
from pyjoystick.model import ActuatorAssembly, JoystickParameters, Side, simulate
from pyjoystick.motion import Record
from pyjoystick.runs import fmu_of_joystick
from pyjoystick.support import ParameterError, TextTable, document_text

_OF_NOISE: Final = "fit, noise of the records"
#: The parameters that `refit` fits.
FITTED: Final = ("J", "damping.C")
_TIME: Final = np.arange(901) / 600.0


@dataclass(frozen=True, slots=True)
class Contribution:
    """Contribution of one stage; NaN where it does not apply.

    Attributes:
        stage: name of the stage
        theta, omega: root mean square error of the angle and its velocity from the release to 1.5 s after it
            (rad, rad/s)
        period: relative error of the mean of the first three periods
        J, C: relative error of the fitted moment of inertia and damping coefficient
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
        side: side of the curve
        curve: its fit, with four segments

    Raises:
        ParameterError: the curve is so uncertain that one of the joysticks is impossible
    """
    values = np.array((*curve.table.x, *curve.table.k))
    # Stiffnesses are a billion times larger than travels, which would be lost in the eigenvectors.
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
    """Difference of runs of moved joysticks: root of the sum of squares over the joysticks.

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


#: Every sample has the same weight, so that errors propagate through the fit linearly.
_PLAIN: Final = Noise(colored=False, robust=False)
#: A search that starts at the solution for values that have hardly moved needs no first parts of the records.
_NEAR: Final = Search(stages=())


def settings_of_refit(joystick: JoystickParameters, noise: Noise = _PLAIN) -> FitSettings:
    """Settings for a fit of J and C with everything else as in a joystick."""
    free = (*map(Free, FITTED), *RELEASE)
    name, wanted = fmu_of_joystick(joystick), Uncertainty(profiles=())
    settings = FitSettings(fmu=name, free=free, noise=noise, uncertainty=wanted)
    return with_values(settings, joystick.to_names())


def noise_contribution(joystick: JoystickParameters, found: Fit, *, release_angle: float) -> Contribution:
    """Standard errors of a fit and their effect on a run, including the correlation of J and C.

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
    run = run_contribution(_OF_NOISE, joystick, moved, release_angle=release_angle)
    return dataclasses.replace(run, J=errors[0], C=errors[1])


def fit_contributions(
    records: Sequence[Record], bench: Bench, fmu: Fmu, *, release_angle: float
) -> tuple[Fit, list[Contribution]]:
    """Fit J and C to records, and compute the contribution of each measured quantity to them and to a run.

    Args:
        records: releases with their zero at the middle position
        bench: bench measurements
        fmu: the FMU named by `Bench.fmu`
        release_angle: release angle of the compared runs (rad)

    Raises:
        FitError: as `fit` does
        ParameterError, SimulationError: a quantity is so uncertain that the joystick is impossible
    """
    settings = with_estimated_starts(settings_of_refit(bench.joystick, Noise()), bench.joystick, records)
    found = fit(records, settings, fmu=fmu)
    joystick = bench.joystick.replace(found.shared())

    def refit(moved: Sequence[Record], one: JoystickParameters) -> dict[str, float]:
        return fitted_values(moved, dataclasses.replace(settings_of_refit(one), search=_NEAR), fmu)

    plain = refit(records, joystick)
    contributions = [
        _with_fitted(stage, plain, [refit(moved, joystick) for moved in several]) if several else stage
        for stage, several in _moved_records(joystick, records, found, bench, release_angle)
    ]
    for name, joysticks in _moved_joysticks(joystick, bench).items():
        run = run_contribution(name, joystick, joysticks, release_angle=release_angle)
        # J is fitted, so the uncertainty of its measurement matters for runs only.
        refits = [] if name.startswith("J ") else [refit(records, one) for one in joysticks]
        contributions.append(_with_fitted(run, plain, refits) if refits else run)
    noise = noise_contribution(joystick, found, release_angle=release_angle)
    return found, [*contributions, noise]


def _moved_records(
    joystick: JoystickParameters, records: Sequence[Record], found: Fit, bench: Bench, release_angle: float
) -> Iterator[tuple[Contribution, list[list[Record]]]]:
    """Records with another scale of the angle or another clock; their zeros are fitted."""
    run = simulate(joystick, time=_TIME, theta_start=release_angle)
    if bench.scale > 0.0:
        theta, omega = (bench.scale * float(np.sqrt(np.mean(one**2))) for one in (run.theta, run.omega))
        scaled = [dataclasses.replace(one, theta=one.theta * (1.0 + bench.scale)) for one in records]
        stage = Contribution(f"scale of the angle, {100.0 * bench.scale:.2g} %", theta, omega, 0.0)
        yield stage, [scaled]
    if bench.time_base > 0.0:
        late = bench.time_base * _TIME
        theta, omega = (float(np.sqrt(np.mean((late * one) ** 2))) for one in (run.omega, run.alpha))
        slower = [dataclasses.replace(one, time=one.time * (1.0 + bench.time_base)) for one in records]
        title = f"time base, {100.0 * bench.time_base:.2g} %"
        yield Contribution(title, theta, omega, bench.time_base), [slower]
    zeros = [
        fitted.sigma["theta"] / math.sqrt(REST_TIME / float(np.median(np.diff(record.time))))
        for fitted, record in zip(found.records, records, strict=True)
    ]
    yield Contribution("zero, noise at rest", float(np.sqrt(np.mean(np.square(zeros))))), []


def _moved_joysticks(joystick: JoystickParameters, bench: Bench) -> dict[str, list[JoystickParameters]]:
    """Joysticks with one quantity moved, by name of the quantity."""
    moved = {f"load curve, {side}": curve_axes(joystick, side, curve) for side, curve in bench.curves.items()}
    values = joystick.to_names()
    for name in UNCERTAIN:
        error = bench.uncertainties.get(name, 0.0)
        if error > 0.0:
            moved[f"{name} +- {error:.1g}"] = [_moved(joystick, name, values.get(name, 0.0), error)]
    if bench.force_scale > 0.0:
        title = f"scale of the force, {100.0 * bench.force_scale:.2g} %"
        moved[title] = [scaled_forces(joystick, 1.0 + bench.force_scale)]
    return moved


def _moved(joystick: JoystickParameters, name: str, value: float, error: float) -> JoystickParameters:
    """A joystick with one quantity moved up, or down if there is no such joystick (T_c > T_s)."""
    try:
        return joystick.replace({name: value + error})
    except ParameterError:
        return joystick.replace({name: value - error})


def _with_fitted(
    contribution: Contribution, before: Mapping[str, float], moved: Sequence[Mapping[str, float]]
) -> Contribution:
    """Add the differences of J and C to the contribution, as roots of the sums of squares."""
    parts = [math.sqrt(sum((one[name] / before[name] - 1.0) ** 2 for one in moved)) for name in FITTED]
    return dataclasses.replace(contribution, J=parts[0], C=parts[1])


def combined(contributions: Sequence[Contribution]) -> tuple[float, float]:
    """Relative standard uncertainties of J and C: the roots of the sums of squares."""
    parts = np.array([(one.J, one.C) for one in contributions])
    inertia, damping = np.sqrt(np.nansum(parts**2, axis=0))
    return float(inertia), float(damping)


def contribution_table(contributions: Sequence[Contribution]) -> str:
    """Contributions as a table in Markdown, with the root of the sum of squares of those to J and C."""

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
    rows.append(["all", "", "", "", *(cell(100.0 * value, 3) for value in combined(contributions))])
    header = ["stage", "theta, rms (deg)", "omega, rms (rad/s)", "period (%)", "fitted J (%)", "fitted C (%)"]
    return TextTable(header, rows).markdown()


def contribution_csv(contributions: Sequence[Contribution]) -> str:
    """Contributions as CSV, one row per stage; `period`, `J` and `C` are relative."""
    headings = {"theta": "theta (rad)", "omega": "omega (rad/s)"}
    return pd.DataFrame(contributions).rename(columns=headings).to_csv(index=False, lineterminator="\n")


def contribution_json(
    found: Fit, contributions: Sequence[Contribution], exact: Sequence[str], notes: Sequence[str] = ()
) -> str:
    """Fitted values with combined standard uncertainties (SI units), and the contributions.

    Args:
        found: the fit
        contributions: contributions to its errors
        exact: quantities taken as exact, see `Bench.exact`
        notes: notes on the records
    """
    units = {one.name: one.unit for one in found.variables if one.record is None}
    fitted = [
        {
            "name": name,
            "value": found.value(name),
            "unit": units[name],
            "standard_uncertainty": abs(found.value(name)) * part,
        }
        for name, part in zip(FITTED, combined(contributions), strict=True)
    ]
    stages = [dataclasses.asdict(one) for one in contributions]
    content = {
        "trusted": found.trusted,
        "parameters": fitted,
        "contributions": stages,
        "exact": list(exact),
    }
    return document_text("budget", content, notes)
