"""Sections of a report on measurements, each a function of the measurements."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Final

import numpy as np

from pyjoystick.identification import FittedValue, combined, combined_uncertainties_apart
from pyjoystick.laboratory import Estimate, Measured, plot_load_curve
from pyjoystick.model import SIDES, fmu_values
from pyjoystick.reports.html_report.known_digits import with_uncertainty
from pyjoystick.reports.html_report.measured_figures import (
    band,
    plot_record,
    plot_residual_distribution,
    plot_swing,
)
from pyjoystick.reports.html_report.measured_parameters import is_rounded, parameter_section, uncertainty_of
from pyjoystick.reports.html_report.measurements import Measurements, SwingTest, found_contradictions
from pyjoystick.reports.html_report.page import Section, figure, paragraph
from pyjoystick.support import TextTable

_DEG: Final = math.degrees(1.0)


def record_section(found: Measurements) -> Section:
    """Records compared with the model."""
    fit = found.fit
    assert fit is not None
    level = f"{100.0 * fit.level:g} %"
    rows, by_record = [], {(one.record, one.name): one for one in fit.values if one.record}
    for one in fit.series:
        inside = np.abs(one.residuals) <= band(one, fit.quantile)
        factor = _DEG if one.label in ("theta", "omega") else 1.0
        release = [_cell(by_record.get((one.record, name))) for name in ("theta_start", "release_time")]
        noise = [f"{factor * size:.2g}" for size in (one.sigma, float(np.sqrt(np.mean(one.residuals**2))))]
        rows.append([one.record, str(len(one.data)), *release, *noise, f"{100.0 * np.mean(inside):.0f}"])
    header = (
        "record",
        "samples",
        "released at (deg)",
        "and at (s)",
        "noise",
        "residual, rms",
        f"in the {level} band (%)",
    )
    known = all(one.errors is not None for one in fit.series)
    words = (
        f"Dots are measured, lines computed. The bands should hold {level} of the samples: they are the "
        "noise of a sample"
        + (
            " and what the records leave unknown of the motion."
            if known
            else " alone, because the records leave a combination of the fitted values undetermined."
        )
    )
    figures = [
        figure(
            plot_record(one, fit),
            f"{one.record}: what was measured, the model's motion, and the difference within its band.",
            alt=f"{len(one.data)} measured samples of {one.label} over the model's motion.",
        )
        for one in fit.series
    ]
    return Section(
        "Records against the model",
        [
            paragraph(words),
            *figures,
            TextTable(header, rows).html("Records; noise and residuals in degrees for angles."),
            figure(
                plot_residual_distribution(fit),
                "Residuals of all records: they should look like noise and not depend on the angle.",
                alt="Residuals over the fitted angle, and their histogram beside a normal distribution.",
            ),
        ],
    )


def fit_section(found: Measurements) -> Section:
    """Fitted parameters, and whether the fit can be trusted."""
    fit = found.fit
    assert fit is not None
    rows = []
    for one in fit.values:
        if one.record:
            continue
        value, error = with_uncertainty(one.value, one.error)
        low, high = (with_uncertainty(end, one.error)[0] for end in one.interval)
        rows.append([one.name, value, error, f"{low} to {high}" if one.is_determined else "", one.unit])
    header = ("", "value", "standard error", f"{100.0 * fit.level:g} % interval", "unit")
    failed = [name for name, passed, _ in fit.checks if not passed]
    verdict = (
        f"The fit failed {', '.join(failed)}: do not trust it." if failed else "The fit passed every check."
    )
    if not fit.is_complete:
        verdict += " It was stopped before it was complete."
    against = [paragraph(f"{one.sentence}.") for one in found_contradictions(found)]
    if against:
        verdict += " What was measured without the records contradicts it."
    checks = [[name, "passed" if passed else "FAILED", message] for name, passed, message in fit.checks]
    return Section(
        "Fit to the records",
        [
            paragraph(verdict),
            *against,
            TextTable(header, rows).html(
                "Fitted values. The standard errors are of the noise alone, with all else taken as known.",
                texts=1,
            ),
            TextTable(("check", "", "what it found"), checks).html("Checks of the fit.", texts=2),
        ],
    )


def unidentified_section(found: Measurements) -> Section:
    """What these measurements do not determine."""
    sentences = list(found.fit.open) if found.fit is not None else []
    undetermined = [one.name for one in found.fit.values if not one.is_determined] if found.fit else []
    if undetermined:
        sentences.append(f"the records do not determine {', '.join(dict.fromkeys(undetermined))}")
    if found.fit is not None and found.fit.unseen:
        sentences.append(f"the records would hardly show {', '.join(found.fit.unseen)}")
    unstated = [one.name for one in fmu_values(found.file) if uncertainty_of(found, one) is None]
    if unstated:
        names = ", ".join(unstated)
        # A file name cannot be capitalized at the start of a sentence.
        sentences.append(
            f"no uncertainty is stated in {found.file.path.name} for {names}: taken as exact here"
        )
    absent = {
        "load-deflection curves": len(found.curves) == len(SIDES),
        "a swing test": found.swing is not None,
        "records of the motion": found.fit is not None,
        "an error budget": found.budget is not None,
    }
    missing = [name for name, given in absent.items() if not given]
    if missing:
        sentences.append(f"not given to this report: {', '.join(missing)}")
    if not sentences:
        sentences = [
            "every parameter has a stated uncertainty, and the records determine all that was fitted"
        ]
    return Section("What was not identified", [paragraph(f"{one[0].upper()}{one[1:]}.") for one in sentences])


def budget_section(found: Measurements) -> Section:
    """Contribution of each quantity to the errors of J and C."""
    budget = found.budget
    assert budget is not None

    def cell(part: float) -> str:
        return "" if math.isnan(part) else f"{100.0 * part:.2g}"

    cells = [[one.stage, cell(one.period), cell(one.J), cell(one.C)] for one in budget.contributions]
    rows = [row for row in cells if any(row[1:])]
    rows.append(["all", "", *map(cell, combined(budget.contributions))])
    exact = ", ".join(budget.exact)
    header = ("quantity", "period of a run (%)", "fitted J (%)", "fitted C (%)")
    return Section(
        "Error budget",
        [
            paragraph(
                "Each quantity alone is moved by its standard uncertainty, and the fit is repeated. The last "
                "row is the root of the sum of squares."
                + (f" Taken as exact, because no uncertainty was given: {exact}." if exact else "")
            ),
            TextTable(header, rows).html(f"From {budget.source}: one standard uncertainty, relative."),
        ],
    )


def curve_section(found: Measurements) -> Section:
    """Measured load-deflection curves."""
    parts = []
    for side, curve in found.curves.items():
        source = found.curve_sources[side]
        alt = f"Measured force over travel, {side}, with the straight segments fitted to it."
        caption = f"{side.capitalize()}: samples of {source}, and the segments fitted to them."
        parts.append(figure(plot_load_curve(curve), caption, alt=alt))
        if curve.curve.unloading is not None:
            friction, error = with_uncertainty(curve.friction, curve.friction_error)
            parts.append(paragraph(f"Friction: {friction} N (standard error {error} N) either way."))
    return Section("Load-deflection curves as measured", parts)


def swing_section(found: Measurements) -> Section:
    """The recorded swing test, and its moment of inertia compared with that of the joystick."""
    swing = found.swing
    assert swing is not None
    rows = [
        _estimate("period of small swings, T", swing.period.period, "s"),
        _estimate("moment of inertia about the pivot, J", swing.inertia, "kg m2"),
    ]
    shares = ", ".join(
        f"{name} {100.0 * part / swing.inertia.value:.2g} %"
        for name, part in swing.inertia.budget.items()
        if part
    )
    alt = "The angle of the pendulum over time, as recorded."
    return Section(
        "Swing test as measured",
        [
            figure(plot_swing(swing.record), f"The joystick as a pendulum: {swing.source}.", alt=alt),
            TextTable(("", "value", "standard uncertainty", "unit"), rows).html("From the record.", texts=1),
            paragraph(
                f"Contributions to the relative uncertainty of this J: {shares}. "
                + _beside_the_joystick(found, swing)
            ),
        ],
    )


def _beside_the_joystick(found: Measurements, swing: SwingTest) -> str:
    """Compare the moment of inertia from the swing with that of the joystick."""
    joystick = Measured(found.file.joystick.J, found.file.uncertainties.get("body.J", 0.0))
    if is_rounded(joystick.value, swing.inertia):
        return "It is the J of this report."
    value, text = with_uncertainty(joystick.value, joystick.uncertainty)
    apart = combined_uncertainties_apart(joystick, swing.inertia)
    return (
        f"The joystick of this report has J = {value} kg m2 (standard uncertainty {text}); the two differ by "
        f"{apart:.1f} combined standard uncertainties."
    )


#: Sections by name, and what they require.
SECTIONS: Final[Mapping[str, tuple[Callable[[Measurements], Section], Callable[[Measurements], bool]]]] = {
    "parameters": (parameter_section, lambda found: True),
    "records": (record_section, lambda found: found.fit is not None and bool(found.fit.series)),
    "fit": (fit_section, lambda found: found.fit is not None),
    "what was not identified": (unidentified_section, lambda found: True),
    "error budget": (budget_section, lambda found: found.budget is not None),
    "load curves": (curve_section, lambda found: bool(found.curves)),
    "swing test": (swing_section, lambda found: found.swing is not None),
}


def _cell(one: FittedValue | None) -> str:
    if one is None:
        return ""
    factor = _DEG if one.unit == "rad" else 1.0
    value, error = with_uncertainty(one.value, one.error, factor)
    return f"{value} ± {error}" if error else value


def _estimate(name: str, one: Estimate, unit: str) -> list[str]:
    return [name, *with_uncertainty(one.value, one.uncertainty), unit]
