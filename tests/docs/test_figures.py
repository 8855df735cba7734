"""The committed figures match the output of their programs and are valid SVG."""

from __future__ import annotations

import math
from xml.etree import ElementTree

import pytest
from figures import DRAWINGS, FOLDER
from figures.svg import Drawing, Point, polar, zigzag

from tests.docs.pages import DOCS


@pytest.mark.parametrize("name", DRAWINGS)
def test_committed_figures_are_up_to_date(name: str) -> None:
    drawn = DRAWINGS[name]().svg()
    assert (FOLDER / f"{name}.svg").read_text(encoding="utf-8") == drawn, "make figure draws them anew"


def test_every_figure_is_shown() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in DOCS.glob("*.md"))
    assert {path.stem for path in FOLDER.glob("*.svg")} == set(DRAWINGS)
    assert [name for name in DRAWINGS if f"(figures/{name}.svg)" not in text] == []


@pytest.mark.parametrize("name", DRAWINGS)
def test_nothing_is_outside(name: str) -> None:
    drawing = DRAWINGS[name]()
    root = ElementTree.fromstring(drawing.svg())
    for shape in root:
        for x, y in _points(shape):
            assert -1.0 <= x <= drawing.width + 1.0, ElementTree.tostring(shape)
            assert -1.0 <= y <= drawing.height + 1.0, ElementTree.tostring(shape)


def _points(shape: ElementTree.Element) -> list[tuple[float, float]]:
    if shape.tag.endswith(("polyline", "polygon")):
        pairs = [pair.split(",") for pair in shape.attrib["points"].split()]
        return [(float(x), float(y)) for x, y in pairs]
    if shape.tag.endswith("circle"):
        return [(float(shape.attrib["cx"]), float(shape.attrib["cy"]))]
    if shape.tag.endswith("text"):
        return [(float(shape.attrib["x"]), float(shape.attrib["y"]))]
    return []


def test_subscripts_and_minus_signs() -> None:
    drawing = Drawing(100.0, 100.0, "A & B")
    drawing.text(Point(50.0, 40.0), "F_{0,ret} - k_s < 1")
    root = ElementTree.fromstring(drawing.svg())
    text = next(element for element in root if element.tag.endswith("text"))
    assert [span.text for span in text] == ["F", "0,ret", " \N{MINUS SIGN} k", "s", " < 1"]
    # Every shift down is taken back.
    assert math.isclose(sum(float(span.attrib.get("dy", 0.0)) for span in text), 0.0, abs_tol=1e-9)
    assert root[0].text == "A & B"


def test_geometry() -> None:
    assert polar(90.0, 2.0) == pytest.approx((0.0, 2.0))
    assert Point(1.0, 0.0).left() == (0.0, 1.0)
    points = zigzag(Point(0.0, 0.0), Point(100.0, 0.0), 5, 8.0)
    assert points[0] == (0.0, 0.0)
    assert points[-1] == (100.0, 0.0)
    assert {round(abs(point.y)) for point in points[2:-2]} == {8}
    assert [point.x for point in points] == sorted(point.x for point in points)
