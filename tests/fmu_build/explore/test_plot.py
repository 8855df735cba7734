"""Texts of plots and units, as passed to the canvas."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser

import fmu_build.explore
from fmu_build.explore.bundle import bundle
from tests.browser import leave, tab

_ASSETS = Path(fmu_build.explore.__file__).parent / "assets"
#: A plot of some values over their numbers: [[text, x, y] of each label, height of each point of the curve].
_DRAW = """([script, values]) => {
  const { drawPlot } = new Function(`${script}; return $plot;`)();
  const labels = [], heights = [];
  const nothing = () => {};
  const context = new Proxy({
    fillText: (text, x, y) => labels.push([text, x, y]),
    measureText: text => ({ width: 6 * text.length }),
  }, { get: (own, name) => own[name] ?? nothing });
  const curve = { x: values.map((_, i) => i), y: values, color: "black" };
  const { y } = drawPlot(context, 400, 210, { curves: [curve], xLabel: "s" }, {});
  return [labels, values.map(y)];
}"""


def _drawn(browser: Browser, values: list[float]) -> tuple[list[str], list[float]]:
    """The numbers beside the axis of y, and the heights of the points (pixels)."""
    page = tab(browser)
    labels, heights = page.evaluate(_DRAW, [bundle("plot", [_ASSETS]), values])
    leave(page)
    left = min(x for _, x, _ in labels)
    return [text for text, x, _ in labels if x == left], heights


def test_errors_of_the_solver_fill_no_plot(browser: Browser) -> None:
    """The energy without damping, at a tolerance of 1e-8."""
    _, heights = _drawn(browser, [554.8105, 554.8105 * (1 - 1.3e-8), 554.8105])
    assert max(heights) - min(heights) < 0.01


@pytest.mark.parametrize("change", [3e-6, 1e-5, 1e-3, 0.1])
@pytest.mark.parametrize("size", [554.8105, 1.2345e-7, 6.789e8])
def test_numbers_beside_an_axis_differ(browser: Browser, size: float, change: float) -> None:
    numbers, heights = _drawn(browser, [size, size * (1 + change)])
    assert max(heights) - min(heights) > 50
    assert len(set(numbers)) == len(numbers) > 2
    values = [float(number.replace("\N{MINUS SIGN}", "-")) for number in numbers]
    np.testing.assert_allclose(np.diff(values), values[1] - values[0], rtol=1e-3)


def test_units_of_temperatures_have_their_degree(browser: Browser) -> None:
    page = tab(browser)
    units = ["deg", "degC", "deg/s", "degF", "N.m.s/rad", "m/s2", "1"]
    shown = page.evaluate(
        "([script, units]) => units.map(new Function(`${script}; return $format.unitText;`)())",
        [bundle("format", [_ASSETS]), units],
    )
    leave(page)
    assert shown == ["°", "°C", "°/s", "°F", "N m s/rad", "m/s²", ""]
