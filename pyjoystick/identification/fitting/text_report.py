"""Text report of a fit (Markdown, readable as plain text)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pyjoystick.identification.fitting.checks import trust
from pyjoystick.identification.fitting.result import Fit
from pyjoystick.support import TextTable

#: Larger correlations are listed.
_STRONG = 0.9


def summary(fit: Fit) -> str:
    """Parameters with uncertainties, what the data cannot determine, and whether the fit can be trusted."""
    parts = [
        _verdict(fit),
        _parameters(fit),
        _derived(fit),
        _known(fit),
        _strong_correlations(fit),
        _noise(fit),
        _criteria(fit),
        _minima(fit),
        _checks(fit),
        _unseen(fit),
        _effort(fit),
    ]
    return "\n\n".join(part for part in parts if part)


def report(fit: Fit, title: str = "Fit") -> str:
    """The summary with a title, for a file."""
    return f"# {title}\n\n{summary(fit)}\n"


def _verdict(fit: Fit) -> str:
    if fit.trusted:
        return "Every check passed."
    failed = [check for check in fit.checks if not check.passed]
    return "NOT TO BE TRUSTED: " + "; ".join(f"{check.name}: {check.message}" for check in failed)


def _parameters(fit: Fit) -> str:
    level = f"{100.0 * fit.settings.uncertainty.level:g} %"
    header = ["parameter", "unit", "value", "standard error", f"{level} interval"]
    if fit.profiles:
        header.append(f"{level} by profile")
    if fit.bootstrap is not None:
        header.append(f"{level} by bootstrap")
        drawn = (
            fit.bootstrap.intervals(fit.settings.uncertainty.level) if len(fit.bootstrap.fits) > 1 else None
        )
    rows = []
    for j, variable in enumerate(fit.variables):
        error = float(fit.standard_errors.errors[j])
        row = [variable.label, variable.unit, _resolved(fit.x[j], error, 8)]
        row += (
            [f"{error:.2g}", _interval(fit.intervals[j])] if math.isfinite(error) else ["not determined", ""]
        )
        if fit.profiles:
            one = fit.profiles.get(j)
            row.append("" if one is None else _interval(one.interval) if one.converged else "not followed")
        if fit.bootstrap is not None:
            known = drawn is not None and bool(np.all(np.isfinite(drawn[j])))
            row.append(_interval(drawn[j]) if drawn is not None and known else "")
        rows.append(row)
    return TextTable(header, rows).markdown()


def _interval(ends: Sequence[float] | np.ndarray[tuple[int], np.dtype[np.float64]]) -> str:
    width = float(ends[1] - ends[0])
    low, high = (_resolved(end, width, 6) if math.isfinite(end) else "unbounded" for end in ends)
    return f"{low} to {high}"


def _resolved(value: float, width: float, least: int) -> str:
    """Format a value to two digits of a width; a time may need more digits than the minimum."""
    known = math.isfinite(width) and width > 0.0 and value != 0.0
    digits = 2 + math.ceil(math.log10(abs(value) / width)) if known else least
    return f"{value:.{max(least, digits)}g}"


def _derived(fit: Fit) -> str:
    if not fit.derived:
        return ""
    rows = [[one.name, one.record, f"{one.value:.8g}", f"{one.error:.2g}"] for one in fit.derived]
    return TextTable(["tied parameter", "record", "value", "standard error"], rows).markdown()


def _strong_correlations(fit: Fit) -> str:
    matrix = fit.standard_errors.correlation
    labels = [variable.label for variable in fit.variables]
    found = [
        f"{labels[i]} and {labels[j]} {matrix[i, j]:+.3f}"
        for i in range(len(labels))
        for j in range(i)
        if abs(matrix[i, j]) > _STRONG
    ]
    combination = fit.identifiability.weakest
    weakest = f"Worst-determined combination: {combination}." if combination else ""
    strong = f"Correlated beyond {_STRONG}: {'; '.join(found)}." if found else ""
    return "\n".join(part for part in (strong, weakest) if part)


def _known(fit: Fit) -> str:
    """Prior measurements of the fitted parameters, and how far the records alone are from them."""
    parts = []
    for one, x, error in zip(fit.variables, fit.x, fit.standard_errors.errors, strict=True):
        if one.uncertainty is not None:
            away = trust.away_from_known(one, x, error)
            says = (
                "the records contain no information about it"
                if away is None
                else f"the records lie {away:+.1f} standard errors away"
            )
            parts.append(f"{one.name} {one.start:.6g} +- {one.uncertainty:.2g} ({says})")
    return f"Counted as measured beforehand: {'; '.join(parts)}." if parts else ""


def _noise(fit: Fit) -> str:
    kind = "given" if fit.settings.noise.sigma else "estimated"
    unit = "relative" if fit.settings.comparison == "peaks" else "in the units of the outputs"
    texts = []
    for one in fit.records:
        levels = ", ".join(f"{label} {sigma:.4g}" for label, sigma in one.sigma.items())
        texts.append(f"{one.name}: {levels}")
    text = f"Standard deviation of the noise ({kind}, {unit}): {'; '.join(texts)}."
    torques = [f"{one.name}: {one.torque_noise:.2g} N m" for one in fit.records if one.torque_noise]
    if torques:
        text += f" Noise of the torque, which the intervals take into account: {'; '.join(torques)}."
    if fit.correlation:
        text += (
            f" Correlation from sample to sample {fit.correlation:.3f}; the intervals take it into account."
        )
    return text


def _criteria(fit: Fit) -> str:
    if fit.criteria is None:
        return ""
    found = fit.criteria
    return (
        f"AICc {found.aicc:.2f}, BIC {found.bic:.2f} ({found.parameters} parameters with the noise, "
        f"{found.samples} samples)."
    )


def _minima(fit: Fit) -> str:
    searches = sum(one.found for one in fit.minima)
    if searches == 1:
        return ""
    rows = [
        [str(number), f"{one.cost:.8g}", str(one.found), "yes" if one.converged else "no"]
        for number, one in enumerate(fit.minima, start=1)
    ]
    text = f"{searches} searches ended in {len(fit.minima)} different places."
    return f"{text}\n\n{TextTable(['place', 'sum of squares', 'searches', 'converged'], rows).markdown()}"


def _checks(fit: Fit) -> str:
    return "\n".join(
        f"- {'passed' if one.passed else 'FAILED'}: {one.name}: {one.message}" for one in fit.checks
    )


def _unseen(fit: Fit) -> str:
    if not fit.unseen:
        return ""
    header = ["missing from the model", "size", "moves", "by", "standard errors"]
    rows = [
        [one.suspect, one.size, one.parameter, f"{100.0 * one.part:.2g} %", f"{one.errors:.2g}"]
        for one in fit.unseen
    ]
    text = (
        "These records would hardly show what the table lists. At the size given, nine of ten such fits fail "
        'the check "missing physics"; a smaller one passes more often and moves less. Measure it, fit it, or '
        "count it in the error budget."
    )
    return f"{text}\n\n{TextTable(header, rows).markdown()}"


def _effort(fit: Fit) -> str:
    text = f"{fit.runs} runs of the FMU in {fit.seconds:.2f} s."
    text += f" Solution and derivatives at an FMU tolerance of {fit.steps.tolerance:g}."
    if fit.bootstrap is not None:
        text += f" Bootstrap over {fit.bootstrap.resampling}: {len(fit.bootstrap.fits)} fits"
        text += f", {fit.bootstrap.failed} failed." if fit.bootstrap.failed else "."
    return f"{text} Stopped before it was complete." if fit.interrupted else text
