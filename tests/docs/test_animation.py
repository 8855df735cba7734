"""The animated drawing: its motion is that of the reference, and it keeps to what a reader prefers."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from figures import FOLDER, swing
from figures.animation import Animation
from figures.svg import Point
from playwright.sync_api import Browser

from pyjoystick.model import NOMINAL, STOP_ANGLE, simulate

_FILE = FOLDER / "swing.svg"


def test_the_handle_moves_as_the_reference() -> None:
    text = swing.draw().svg()
    assert len(text.encode()) < 150_000
    frames = re.search(r"@keyframes handle-linear\{(.*)\}", text)
    assert frames is not None
    pairs = re.findall(r"([\d.]+)%\{transform:rotate\((.*?)deg\)\}", frames[1])
    instants, angles = (np.array([float(pair[i]) for pair in pairs]) for i in (0, 1))
    time = np.linspace(0.0, 1.2, 500)
    motion = simulate(NOMINAL, time=time, theta_start=-STOP_ANGLE)
    shown = np.interp(0.8 + 8.0 * time, instants * swing.DURATION / 100.0, angles)
    # 0.05 degrees between keyframes, and the rounding of their values and instants.
    np.testing.assert_allclose(shown, np.degrees(motion.theta), atol=0.1)
    assert angles[0] == angles[-1] == -20.0


def test_keyframes_follow_corners() -> None:
    drawing = Animation(100.0, 100.0, "Corners", duration=4.0)
    times = np.linspace(0.0, 4.0, 401)
    with drawing.group("part"):
        drawing.circle(Point(50.0, 50.0), 5.0)
    drawing.move("part", times, [Point(10.0 * min(time, 4.0 - time), 0.0) for time in times])
    frames = re.findall(r"([\d.]+%)\{transform:translate\((.*?)px,0px\)\}", drawing.svg())
    assert frames == [("0%", "0"), ("50%", "20"), ("100%", "0")]


@pytest.mark.parametrize("motion", ["reduce", "no-preference"])
@pytest.mark.parametrize(("scheme", "ground"), [("light", (255, 255, 255)), ("dark", (29, 33, 39))])
def test_it_keeps_to_what_the_reader_prefers(
    browser: Browser, motion: str, scheme: str, ground: tuple[int, int, int]
) -> None:
    context = browser.new_context(color_scheme=scheme, reduced_motion=motion)  # type: ignore[arg-type]
    page = context.new_page()
    page.goto(_FILE.as_uri())
    fill = page.evaluate("getComputedStyle(document.querySelector('svg > rect')).fill")
    assert fill == f"rgb{ground}"
    animations = page.evaluate("document.getAnimations().length")
    assert (animations == 0) == (motion == "reduce")
    turned = "new DOMMatrix(getComputedStyle(document.querySelector('.handle')).transform)"
    # Without motion, and while it is held, it shows the joystick before its release.
    page.evaluate("document.getAnimations().forEach(one => { one.pause(); one.currentTime = 500 })")
    sine = page.evaluate(f"{turned}.b")
    assert sine == pytest.approx(-math.sin(STOP_ANGLE), abs=1e-3)  # the browser prints six digits
    context.close()
