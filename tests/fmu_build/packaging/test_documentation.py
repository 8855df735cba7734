"""The documentation page and the icon of an FMU."""

from __future__ import annotations

import struct
from dataclasses import replace
from typing import Any

import matplotlib as mpl
from lxml import html

from fmu_build.packaging.default_run import DefaultRun
from fmu_build.packaging.documentation import FIGURE, index_html
from fmu_build.packaging.figures import model_png
from fmu_build.support.description import ModelDescription, Variable


def _page(content: bytes) -> Any:
    return html.fromstring(content)


def test_page_lists_parameters_inputs_and_outputs(description: ModelDescription) -> None:
    page = _page(index_html(description, "it stopped", "tool 1.0"))
    rows = [[cell.text_content() for cell in row] for row in page.iter("tr")]
    assert ["k", "4", "N/m", "Stiffness <&>"] in rows
    assert ["mode", "Fast", "", ""] in rows
    assert ["flag", "true", "", "Switch"] in rows
    assert ["F", "0", "N", "Force"] in rows
    assert ["E", "", "J", "Energy"] in rows
    assert not any(row[0] == "der(x)" for row in rows)
    assert page.findtext(".//h1") == "Oscillator"


def test_page_holds_the_class_documentation_without_dead_links(description: ModelDescription) -> None:
    text = (
        '<html><h4>Use</h4><p>See <a href="modelica://A.B">B</a>, <a href="https://example.org">E</a>.'
        '<img src="modelica://A/b.png"/></p><script>run()</script></html>'
    )
    page = _page(index_html(replace(description, documentation=text), "it stopped", "tool"))
    assert "See B, E." in page.text_content()
    assert [a.get("href") for a in page.iter("a")] == ["https://example.org"]
    assert list(page.iter("img", "script")) == []


def test_page_of_a_class_without_documentation(description: ModelDescription) -> None:
    page = _page(index_html(replace(description, documentation=" "), "it stopped", "tool"))
    assert list(page.iter("div")) == []


def test_page_survives_characters_that_html_cannot_hold(description: ModelDescription) -> None:
    odd = replace(description, description="a\x07b", documentation="<p>c\x00d</p>")
    text = _page(index_html(odd, "e\x07f", "tool")).text_content()
    assert "a b" in text
    assert "c d" in text


def test_icon_is_a_png_of_400_by_300(description: ModelDescription) -> None:
    png = model_png(description)
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    assert struct.unpack(">II", png[16:24]) == (400, 300)
    assert b"Software" not in png
    with mpl.rc_context({"font.family": "monospace"}):
        assert model_png(description) == png
    assert model_png(replace(description, model_name="Test.Other")) != png


def test_icon_of_a_model_with_many_ports(description: ModelDescription) -> None:
    def ports(number: int) -> ModelDescription:
        inputs = tuple(Variable(f"u{i}", "Real", "input", "continuous", None, 0.0) for i in range(number))
        return replace(description, variables=inputs)

    assert model_png(ports(100)) == model_png(ports(13))
    assert model_png(ports(12)) != model_png(ports(13))


def test_page_shows_the_default_run_or_says_why_not(description: ModelDescription) -> None:
    run = DefaultRun((0.0, 1.0), {"F": (0.0, 0.0)}, {"x": (0.1, 0.2)})
    page = _page(index_html(description, run, "tool"))
    assert [image.get("src") for image in page.iter("img")] == [FIGURE]
    assert "From 0 s to 1 s with the inputs shown in the figure" in page.text_content()
    page = _page(index_html(description, "it broke", "tool"))
    assert list(page.iter("img")) == []
    assert "There is no figure: it broke." in page.text_content()
