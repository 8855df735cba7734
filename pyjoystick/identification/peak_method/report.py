"""Reports on damping estimates and peak errors, in Markdown, JSON and CSV."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd

from pyjoystick.identification.peak_method.bias import Bias
from pyjoystick.identification.peak_method.estimate import CONSTANTS, LINES, DampingEstimate
from pyjoystick.motion import MeasuredPeaks, minima
from pyjoystick.support import TextTable, document_text

_LINE_NAMES = dict(zip(LINES, (("A_pos", "n_pos"), ("A_neg", "n_neg"), ("B", "m")), strict=True))
_ERRORS = {
    "displacement": "displacement",
    "displacement_time": "its time",
    "velocity": "velocity",
    "velocity_time": "its time",
}


def releases_report(releases: Sequence[MeasuredPeaks]) -> str:
    """Release, noise and number of peaks of each record, with standard errors."""
    rows = [
        [
            one.name,
            _with_error(one.release_time, one.release_time_error, ".4f"),
            _with_error(math.degrees(one.release_angle), math.degrees(one.release_angle_error), "+.2f"),
            f"{math.degrees(one.noise):.3f}",
            f"{len(one.displacement)} and {len(one.velocity)}",
        ]
        for one in releases
    ]
    return TextTable(["record", "release (s)", "angle (deg)", "noise (deg)", "peaks"], rows).markdown()


def _with_error(value: float, error: float, form: str) -> str:
    """Format value and error with the given format, or with as many more digits as the error needs."""
    places = int(form.strip("+.f"))
    if 0.0 < error < math.inf:
        places = max(places, -math.floor(math.log10(error)))
    sign = "+" if "+" in form else ""
    return f"{value:{sign}.{places}f} +- {error:.{places}f}"


def damping_report(
    estimate: DampingEstimate, constants: Mapping[str, Bias], lines: Mapping[str, Bias]
) -> str:
    """The estimates of the peak method and their biases.

    Args:
        estimate: from the records
        constants: biases of the constant C, see `constant_bias`
        lines: biases of the lines' coefficients and exponents, see `line_bias`
    """
    rows = [_constant_row(name, estimate, constants[name]) for name in CONSTANTS]
    for line in LINES:
        coefficient, exponent = _LINE_NAMES[line]
        fitted = estimate.lines[line]
        rows.append(_row(coefficient, lines[coefficient], fitted.coefficient_interval()))
        rows.append(_row(exponent, lines[exponent], fitted.exponent_interval()))
    table = TextTable(["", "estimate", "95 % interval", "bias", "corrected"], rows).markdown()
    if estimate.left_out:
        return f"{table}\n\n{estimate.left_out} points without a logarithm are left out of the lines."
    return table


def damping_json(
    releases: Sequence[MeasuredPeaks],
    estimate: DampingEstimate,
    constants: Mapping[str, Bias],
    lines: Mapping[str, Bias],
    notes: Sequence[str] = (),
) -> str:
    """The report as JSON text, in SI units: releases, constant C, coefficients and exponents of the lines."""

    def with_bias(name: str, bias: Bias, interval: tuple[float, float] | None) -> dict[str, Any]:
        return {"name": name, **asdict(bias), "bias": bias.bias, "interval": interval}

    content: dict[str, Any] = {
        "releases": [
            {key: value for key, value in vars(one).items() if not isinstance(value, pd.DataFrame)}
            for one in releases
        ],
        "constants": [
            with_bias(name, constants[name], estimate.constants[name].interval()) for name in CONSTANTS
        ],
        "lines": [],
        "left_out": estimate.left_out,
    }
    for line, (coefficient, exponent) in _LINE_NAMES.items():
        fitted = estimate.lines[line]
        content["lines"] += [
            with_bias(coefficient, lines[coefficient], fitted.coefficient_interval()),
            with_bias(exponent, lines[exponent], fitted.exponent_interval()),
        ]
    return document_text("peaks", content, notes)


def damping_csv(estimate: DampingEstimate) -> str:
    """Peaks and the C of each as CSV, with separate columns for displacement and velocity."""
    series = {"theta (rad)": estimate.displacement, "omega (rad/s)": estimate.velocity}
    table = pd.concat([points.rename(columns={"peak": name}) for name, points in series.items()])
    headings = {"time": "time (s)", "C": "C (N.m.s/rad)"}
    columns = ["record", "number", "time (s)", *series, "C (N.m.s/rad)"]
    return table.rename(columns=headings)[columns].to_csv(index=False, lineterminator="\n")


def bias_report(table: pd.DataFrame) -> str:
    """Table from `bias_table`: results of the method for a known constant C."""
    exponents = ["n_pos", "n_neg", "m"]
    columns = ["C", "release_angle", *CONSTANTS, *exponents]
    rows = []
    for true, angle, *numbers in table[columns].to_numpy(dtype=np.float64).tolist():
        parts = [f"{value:.3f}" for value in numbers[: len(CONSTANTS)]]
        slopes = [f"{value:+.3f}" for value in numbers[len(CONSTANTS) :]]
        rows.append([f"{true:g}", f"{math.degrees(angle):g}", *parts, *slopes])
    return TextTable(["true C", "release (deg)", *CONSTANTS, *exponents], rows).markdown()


def peak_error_report(sweeps: Mapping[str, pd.DataFrame], shown: Mapping[str, Sequence[float]]) -> str:
    """Errors of eqs. (12a, b) at some values of each sweep, and the minima.

    Args:
        sweeps: tables of `sweep_peak_errors` by a label such as ``C``
        shown: values to show, by label; the nearest ones of the sweep are used
    """
    rows = []
    for label, sweep in sweeps.items():
        values = sweep.index.to_numpy(dtype=np.float64)
        errors = sweep[list(_ERRORS)].to_numpy(dtype=np.float64)
        for value in shown.get(label, ()):
            nearest = int(np.argmin(np.abs(values - value)))
            rows.append([f"{label} = {values[nearest]:.4g}", *(f"{error:.1f}" for error in errors[nearest])])
        least = minima(sweep).loc[list(_ERRORS), ["error", "at"]].to_numpy(dtype=np.float64)
        rows.append([f"{label}, smallest", *(f"{error:.1f} at {at:.4g}" for error, at in least)])
    return TextTable(["error (%)", *_ERRORS.values()], rows).markdown()


def _constant_row(name: str, estimate: DampingEstimate, bias: Bias) -> list[str]:
    return _row(f"C, {name}", bias, estimate.constants[name].interval())


def _row(name: str, bias: Bias, interval: tuple[float, float] | None) -> list[str]:
    between = "" if interval is None else f"{interval[0]:.4f} to {interval[1]:.4f}"
    return [name, f"{bias.estimate:.4f}", between, f"{bias.bias:+.4f}", f"{bias.corrected:.4f}"]
