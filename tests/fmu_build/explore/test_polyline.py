"""Simplified curves: no omitted point is more than a tenth of a pixel from the lines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser

import fmu_build.explore
from tests.browser import leave, tab

_SCRIPT = Path(fmu_build.explore.__file__).parent / "assets" / "polyline.js"
_TRACE = """async ([script, points]) => {
  const { trace } = await import(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
  const found = [];
  const path = { moveTo: (x, y) => found.push([[x, y]]), lineTo: (x, y) => found.at(-1).push([x, y]) };
  const number = value => value ?? NaN;
  trace(path, points.length, i => number(points[i][0]), i => number(points[i][1]));
  return found;
}"""
Points = np.ndarray


def _traced(browser: Browser, points: Points) -> list[Points]:
    """The parts of the curve of points [n][2]; NaN comes as None."""
    given = [[None if math.isnan(x) else float(x) for x in point] for point in points]
    page = tab(browser)
    found = page.evaluate(_TRACE, [_SCRIPT.read_text("utf-8"), given])
    leave(page)
    return [np.array(part) for part in found]


def _distance(point: Sequence[float], part: Points) -> float:
    """From a point to the nearest line of a part."""
    start, along = part[:-1], np.diff(part, axis=0)
    length = np.maximum(np.sum(along**2, axis=1), 1e-300)
    place = np.clip(np.sum((point - start) * along, axis=1) / length, 0.0, 1.0)
    return float(np.min(np.linalg.norm(start + place[:, None] * along - point, axis=1)))


_T = np.linspace(0.0, 1.0, 1501)
_DECAY = np.exp(-2.0 * _T)
_RANDOM = np.random.default_rng(1)
_CURVES = {
    "oscillation": (np.column_stack([360 * _T, 90 * _DECAY * np.cos(40 * _T)]), 200),
    "phase plane": (np.column_stack([150 * _DECAY * np.cos(40 * _T), 90 * _DECAY * np.sin(40 * _T)]), 450),
    "line": (np.column_stack([360 * _T, 0.0 * _T]), 2),
    "there and back": (np.column_stack([100 * np.sin(20 * _T), 0.0 * _T]), 25),
    "steps": (np.column_stack([360 * _T, 50.0 * (np.arange(1501) % 100 < 50)]), 61),
    "noise": (np.column_stack([360 * _T, 20.0 * _RANDOM.random(1501)]), 1501),
    "walk": (np.cumsum(_RANDOM.random((1501, 2)) - 0.5, axis=0), 1501),
}


@pytest.mark.parametrize("name", _CURVES)
def test_no_point_is_further_from_the_curve_than_the_tolerance(browser: Browser, name: str) -> None:
    points, most = _CURVES[name]
    (part,) = _traced(browser, points)
    assert len(part) <= most
    assert max(_distance(point, part) for point in points) <= 0.1 + 1e-9
    given = {tuple(point) for point in points}
    assert all(tuple(point) in given for point in part)
    np.testing.assert_array_equal(part[[0, -1]], points[[0, -1]])


def test_what_is_no_number_interrupts_the_curve(browser: Browser) -> None:
    points = np.column_stack([np.arange(9.0), np.zeros(9)])
    points[0, 0] = points[4, 1] = points[8, 0] = math.nan
    parts = _traced(browser, points)
    assert [part.tolist() for part in parts] == [[[1.0, 0.0], [3.0, 0.0]], [[5.0, 0.0], [7.0, 0.0]]]
