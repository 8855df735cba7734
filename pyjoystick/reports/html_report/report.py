"""The whole report: its sections in order, claims if it is about the paper's joystick, versions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from html import escape

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.reports.claims.document import findings
from pyjoystick.reports.html_report.measured_sections import SECTIONS as MEASURED_SECTIONS
from pyjoystick.reports.html_report.measurements import Measurements, moved_joysticks
from pyjoystick.reports.html_report.page import Section, page, paragraph
from pyjoystick.reports.html_report.sections import SECTIONS
from pyjoystick.reports.html_report.study import Study
from pyjoystick.support import ParameterError, TextTable, versions


def joystick_report(
    study: Study,
    *,
    measurements: Measurements | None = None,
    title: str = "",
    live: str = "",
    on_section: Callable[[str], None] = lambda name: None,
) -> str:
    """The report as one self-contained HTML text.

    Args:
        study: the joystick and its free oscillation
        measurements: its measurements, from `read_measurements`; if None, everything on the page is computed
            from the parameters, as the page states
        title: title of the page; generated if empty
        live: address of the joystick's live page (`joystick_page`), linked in the introduction
        on_section: called with the name of each section before it is made

    Raises:
        FmuRunError, SimulationError: the free oscillation fails
        ParameterError: the release is not an angle below pi/2, or the measurements are of another joystick
    """
    if measurements is not None and study.joystick != measurements.file.joystick:
        if not measurements.is_empty:
            raise ParameterError("measurements", f"of {measurements.file.path}", "of this joystick")
        measurements = None
    measured = {} if measurements is None else _measured(measurements)
    if measurements is not None:
        study = replace(study, moved=tuple(moved_joysticks(measurements, study.joystick)))
    computed = {name: make for name, make in SECTIONS.items() if name not in measured}
    sections = []
    for name, make in measured.items():
        on_section(name)
        sections.append(make())
    for name, compute in computed.items():
        on_section(name)
        section = compute(study)
        sections.append(replace(section, title=f"Computed: {section.title}") if measured else section)
    if study.joystick in (NOMINAL, NOMINAL_POWER_LAW):
        on_section("claims of the paper")
        sections.append(claims_section())
    angle = f"{math.degrees(study.release_angle):g} degrees"
    words = (
        f"A joystick with opposing restrained preloaded springs and {study.law} damping. Model, equations "
        "and notation: R. J. Rogers, P. Garland, M. Oliver, Dynamic modelling of mechanical systems with "
        "opposing restrained preloaded stiffnesses, J. Sound Vib. 274 (2004) 73-89. Angles are positive "
        "forward."
    )
    introduction = [paragraph(words), paragraph(_what_it_is_of(study, measurements, angle))]
    if live:
        introduction.append(f'<p><a href="{escape(live)}">This joystick, live</a>: with sliders.</p>')
    made = ", ".join(f"{name} {version}" for name, version in versions().items())
    footer = (
        f"Simulated by {study.fmu.description.path.name} ({study.fmu.description.guid}). Made with {made}."
    )
    return page(title or "A joystick", "\n".join(introduction), sections, footer=footer)


def _measured(found: Measurements) -> dict[str, Callable[[], Section]]:
    """Sections on measurements; empty if there are neither measurements nor stated uncertainties."""
    if found.is_empty and not found.file.uncertainties:
        return {}
    return {name: partial(make, found) for name, (make, has) in MEASURED_SECTIONS.items() if has(found)}


def _what_it_is_of(study: Study, found: Measurements | None, angle: str) -> str:
    """What on the page is measured and what is computed."""
    if found is None or found.is_empty:
        of = "the parameters below" if found is None else f"the parameters in {found.file.path.name}"
        return f"Everything on this page is computed from {of}, released at {angle}; no measurement is shown."
    given = {
        f"records ({', '.join(found.fit.records)})" if found.fit is not None else "": found.fit is not None,
        f"load-deflection curves ({', '.join(found.curve_sources.values())})": bool(found.curves),
        f"a swing test ({found.swing.source})" if found.swing is not None else "": found.swing is not None,
        f"a table of parts ({found.parts_source})": found.parts is not None,
    }
    shown = ", ".join(name for name, is_given in given.items() if is_given)
    return (
        f"The parameters are those in {found.file.path.name}. Measured, and shown as measured: "
        f'{shown or "nothing"}. Sections whose heading begins with "Computed" are the model\'s with these '
        f"parameters, for a release at {angle}."
    )


def claims_section() -> Section:
    """The claims of the paper with their verdicts."""
    parts = [
        TextTable(
            ("where", "the paper", "here", "verdict"),
            [
                [
                    claim.where,
                    claim.statement,
                    finding.text,
                    finding.verdict,
                ]
                for claim, finding in rows
            ],
        ).html(
            chapter,
            prose=True,
        )
        for chapter, rows in findings().items()
    ]
    return Section("The paper's claims, checked", parts)
