"""The whole report: its sections in order, the claims where it is about the paper's joystick, versions."""

from __future__ import annotations

import math
from collections.abc import Callable

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.reports.claims.document import findings
from pyjoystick.reports.html_report.page import Section, page, paragraph
from pyjoystick.reports.html_report.sections import SECTIONS, Study
from pyjoystick.support import TextTable, versions


def joystick_report(
    study: Study, *, title: str = "", on_section: Callable[[str], None] = lambda name: None
) -> str:
    """The report as HTML in one piece: no file beside it, nothing from the network.

    Args:
        study: the joystick and its free oscillation
        title: of the page; one is made where it is empty
        on_section: called with the name of each section before it is made

    Raises:
        FmuRunError, SimulationError: the free oscillation fails
        ParameterError: the release is no angle below pi/2
    """
    sections = []
    for name, make in SECTIONS.items():
        on_section(name)
        sections.append(make(study))
    if study.joystick in (NOMINAL, NOMINAL_POWER_LAW):
        on_section("claims of the paper")
        sections.append(claims_section())
    words = (
        f"A joystick with opposing restrained preloaded springs and {study.law} damping, released at "
        f"{math.degrees(study.release_angle):g} degrees. Model, equations and notation: R. J. "
        "Rogers, P. Garland, "
        "M. Oliver, Dynamic modelling of mechanical systems with opposing restrained preloaded stiffnesses, "
        "J. Sound Vib. 274 (2004) 73-89. Angles are positive forward."
    )
    made = ", ".join(f"{name} {version}" for name, version in versions().items())
    footer = (
        f"Simulated by {study.fmu.description.path.name} ({study.fmu.description.guid}). Made with {made}."
    )
    return page(title or "A joystick", paragraph(words), sections, footer=footer)


def claims_section() -> Section:
    """The claims of the paper with their verdicts."""
    parts = [
        TextTable(
            ("where", "the paper", "here", "verdict"),
            [
                [
                    claim.where,
                    claim.statement,
                    "; ".join(filter(None, (finding.here, finding.remark))),
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
