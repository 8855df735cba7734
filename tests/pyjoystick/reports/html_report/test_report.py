"""The report is one self-contained file that describes the joystick."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, PIVOT_TO_TOP, JoystickParameters
from pyjoystick.reports import Section, Study, figure, joystick_report, page, paragraph
from pyjoystick.support import TextTable
from tests.pyjoystick.reports.html_report.reading import drawing, read_page

OTHER = NOMINAL.replace({"m": 0.91, "damping.C": 0.05})


@pytest.fixture(scope="module")
def power_law(joystick_fmus: Path) -> Iterator[Fmu]:
    with Fmu(joystick_fmus / "JoystickPowerLaw.fmu") as fmu:
        yield fmu


@pytest.fixture(scope="module")
def constant(joystick_fmus: Path) -> Iterator[Fmu]:
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        yield fmu


@pytest.fixture(scope="module")
def papers_report(power_law: Fmu, joystick_fmus: Path) -> tuple[str, list[str]]:
    """The report on the paper's joystick, and the sections as they were announced."""
    announced: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("pyjoystick.fmu.files.build_folder", lambda: joystick_fmus)
        study = Study(NOMINAL_POWER_LAW, power_law, math.radians(-20.0), PIVOT_TO_TOP)
        text = joystick_report(study, title="Rogers & <others>", on_section=announced.append)
    return text, announced


def test_it_is_one_page_that_needs_nothing_else(papers_report: tuple[str, list[str]]) -> None:
    text, _ = papers_report
    read = read_page(text)
    assert text.startswith("<!DOCTYPE html>")
    assert read.language == "en"
    assert read.outside == []
    assert "@import" not in text
    assert "url(" not in text
    assert "://" not in text
    assert all(link[0] == "#" and link[1:] in read.targets for link in read.links)
    assert len(read.links) == 8
    assert "Everything on this page is computed from the parameters below" in text


def test_every_figure_says_what_it_shows(papers_report: tuple[str, list[str]]) -> None:
    images = read_page(papers_report[0]).images
    assert len(images) == 6
    assert all(len(image["alt"]) > 40 for image in images)
    assert len({image["alt"] for image in images}) == len(images)
    for image in images:
        svg = drawing(image)
        assert "<svg" in svg
        # What is inside a drawing asks for nothing either: it refers to itself alone.
        targets = re.findall(r'xlink:href="([^"]*)"', svg)
        assert targets
        assert all(target.startswith("#") for target in targets)


def test_the_sections_are_announced_and_there(papers_report: tuple[str, list[str]]) -> None:
    text, announced = papers_report
    read = read_page(text)
    assert len(announced) == 8
    assert read.headings[0].startswith("Rogers")
    assert read.headings[-1].startswith("The paper's claims")
    assert "Rogers &amp; &lt;others&gt;" in text
    assert "Made with Python" in text
    assert {"0.87", "0.01135", "430000", "disagrees"} <= set(read.cells)


def test_about_another_joystick_it_has_that_ones_numbers_and_no_claims(constant: Fmu) -> None:
    text = joystick_report(Study(OTHER, constant, math.radians(15.0), None))
    read = read_page(text)
    assert "0.91" in read.cells
    assert "pivot to top" not in read.cells
    assert "force at the top of the handle (0.266 m, that of the paper&#x27;s joystick)" in text
    assert "Constant: 0.05 N m s/rad." in text
    assert not any("paper says" in heading for heading in read.headings)


@pytest.mark.parametrize(
    "joystick",
    [
        NOMINAL.replace({"damping.C": 0.0}),
        NOMINAL.replace({"g": 0.0}),
        NOMINAL.replace({"damping.C": 5.0}),
        NOMINAL.replace({f"{side}.returnSpring.x_0": 0.002 for side in ("forward", "backward")}),
    ],
    ids=["undamped", "weightless", "overdamped", "large clearance"],
)
def test_unusual_joysticks_have_a_report(constant: Fmu, joystick: JoystickParameters) -> None:
    read = read_page(joystick_report(Study(joystick, constant, math.radians(-20.0), None)))
    assert len(read.images) >= 4
    assert not any("nan" in cell for cell in read.cells)


def test_text_is_escaped() -> None:
    parts = [paragraph("a < b & c"), TextTable(("x", "y<z"), [["1", "&"]]).html("<caption>")]
    text = page("<title>", "", [Section("a & b", parts)], footer="<end>")
    read_page(text)
    for escaped in (
        "a &lt; b &amp; c",
        "y&lt;z",
        "&lt;caption&gt;",
        "&lt;title&gt;",
        "a &amp; b",
        "&lt;end&gt;",
    ):
        assert escaped in text


def test_the_same_figure_is_the_same_text() -> None:
    def drawn() -> str:
        one = Figure()
        one.subplots().plot([0.0, 1.0], [0.0, 1.0])
        return figure(one, "caption", alt="a line that rises")

    assert drawn() == drawn()
