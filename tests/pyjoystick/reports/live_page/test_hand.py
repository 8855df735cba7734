"""The handle in an operator's hand: moved by pointer, touch and keys, and released."""

from __future__ import annotations

import json
import math
from pathlib import Path
from urllib.parse import quote

import numpy as np
import pandas as pd
import pytest
from playwright.sync_api import Page, expect

from pyjoystick.fmu import Fmu
from tests.browser import LivePage
from tests.pyjoystick.reports.live_page.conftest import Live

_SHOWN = ("theta", "theta_ref", "omega_ref", "grip", "T_hand")
#: The handle swings as long as a run takes: not long, because frames take their time on a busy machine.
_BRIEF = "#:stop=0.4"
_PLOT = f"{_BRIEF}&:plots={quote(json.dumps([[None, *_SHOWN]]))}"


def _point(page: Page, angle: float) -> tuple[float, float]:
    """Where the handle's grip is drawn at an angle (deg)."""
    place = page.evaluate(
        """angle => {
          const length = 0.22e3; // mm, of the joystick's 266
          const point = new DOMPoint(length * Math.sin(angle), -length * Math.cos(angle));
          const { x, y } = point.matrixTransform(document.querySelector("svg.whole").getScreenCTM());
          return [x, y];
        }""",
        math.radians(angle),
    )
    return float(place[0]), float(place[1])


def _angle(page: Page) -> float:
    return float(page.locator(".handle").get_attribute("aria-valuenow") or "nan")


def _drag(page: Page, start: float, end: float, moves: int = 8) -> None:
    page.mouse.move(*_point(page, start))
    page.mouse.down()
    for angle in np.linspace(start, end, moves + 1)[1:]:
        page.mouse.move(*_point(page, angle))
        page.wait_for_timeout(10)


def _reaches(page: LivePage, low: float, high: float) -> None:
    """Wait until the handle has an angle (deg) between two."""
    for _ in range(1000):
        if low < _angle(page.page) < high:
            return
        page.page.wait_for_timeout(10)
    pytest.fail(f"the handle is at {_angle(page.page)} degrees, not between {low} and {high}")


def _ended(page: LivePage) -> None:
    """Wait until the handle swings no more."""
    expect(page.page.locator("#status")).to_contain_text("Moved by hand", timeout=30_000)


def _replayed(live: LivePage, fmu: Fmu, **parameters: float) -> tuple[pd.DataFrame, pd.DataFrame]:
    """What a page has recorded, and what the FMU makes of the same hand.

    Between two rows theta_ref is straight; omega_ref and grip are those of the later row.
    """
    shown = live.csv()
    time = shown.index.to_numpy()
    before, after = shown.iloc[:-1], shown.iloc[1:]
    held = after[["omega_ref", "grip"]].to_numpy()
    hand = pd.DataFrame(
        {
            "theta_ref": np.stack((before["theta_ref"], after["theta_ref"]), axis=1).ravel(),
            "omega_ref": np.repeat(held[:, 0], 2),
            "grip": np.repeat(held[:, 1], 2),
        },
        index=np.stack((time[:-1], time[1:]), axis=1).ravel(),
    )
    parameters = {"theta_start": float(shown["theta"].iloc[0]), **parameters}
    return shown, fmu.run(time, inputs=hand, parameters=parameters, outputs=["theta", "T_hand"])


def test_the_motion_by_pointer_is_that_of_the_model_with_the_same_hand(live: Live, fmus: Path) -> None:
    page = live(fragment=_PLOT)
    _drag(page.page, -20.0, 10.0)
    _reaches(page, 5.0, 9.0)
    page.page.mouse.up()
    _ended(page)
    with Fmu(fmus / "HeldJoystick.fmu") as fmu:
        shown, expected = _replayed(page, fmu)
    assert np.degrees(shown["theta_ref"].iloc[[0, -1]]).tolist() == pytest.approx([-20.0, 10.0], abs=0.5)
    assert shown["grip"].iloc[-1] == 0.0
    assert shown["T_hand"].iloc[-1] == 0.0
    # Both integrate to 1e-8, with other restarts.
    np.testing.assert_allclose(shown["theta"], expected["theta"], atol=1e-6)
    # At the end of a frame the hand has the torque of the next one, where its speed is another.
    steady = ~np.any(np.diff(shown[["omega_ref", "grip"]], axis=0, append=0.0), axis=1)
    np.testing.assert_allclose(shown["T_hand"][steady], expected["T_hand"][steady], atol=1e-4)


def test_the_handle_follows_and_swings_after_it_is_let_go(live: Live) -> None:
    page = live(fragment=_BRIEF)
    _drag(page.page, -20.0, 5.0)
    # The hand's spring of 25 N m/rad gives way by 1.4 N m of preload: 3 degrees.
    _reaches(page, 1.0, 3.0)
    expect(page.page.locator(".torque")).to_contain_text("hand 1.")
    expect(page.page.locator(".wanted")).to_be_visible()
    page.page.mouse.up()
    _ended(page)
    assert abs(_angle(page.page)) < 3.0
    expect(page.page.locator(".wanted")).to_be_hidden()
    assert page.csv()["theta"].min() < math.radians(-1.0)  # it swung back over the middle
    with page.rerun():
        page.page.get_by_role("button", name="20° release").click()
    assert len(page.csv()) == 401


def test_keys_move_the_handle_and_let_it_go(live: Live) -> None:
    page = live(fragment=_PLOT)
    page.page.locator(".handle").focus()
    for key in ("Home", "ArrowRight", "ArrowRight", "PageUp"):
        page.page.keyboard.press(key)
    _reaches(page, -11.0, -9.0)  # wanted are -20 + 1 + 1 + 5
    page.page.keyboard.press("Enter")
    _ended(page)
    shown = page.csv()
    assert np.degrees(shown["theta_ref"].iloc[-1]) == pytest.approx(-13.0, abs=1.0)
    page.page.locator(".handle").focus()
    page.page.keyboard.press("ArrowLeft")
    expect(page.page.locator(".torque")).to_contain_text("hand")
    page.page.keyboard.press("Tab")  # who leaves the handle lets it go
    expect(page.page.locator(".torque")).to_be_empty()


def test_a_changed_value_ends_it(live: Live) -> None:
    page = live()
    page.page.locator(".handle").focus()
    page.page.keyboard.press("ArrowRight")
    expect(page.page.locator(".torque")).to_contain_text("hand")
    with page.rerun():
        page.page.locator('.control[data-name="damping.C"] input.number').evaluate(
            "field => { field.value = '0.1'; field.dispatchEvent(new Event('input')); }"
        )
    expect(page.page.locator(".torque")).to_be_empty()
    assert len(page.csv()) == 1501


def test_without_motion_the_swing_is_there_at_once(live: Live) -> None:
    page = live(reduced_motion="reduce", fragment=_PLOT)
    page.page.locator(".handle").focus()
    page.page.keyboard.press("ArrowRight")
    expect(page.page.locator(".torque")).to_contain_text("hand")
    page.page.evaluate("""() => {
      window.angles = new Set();
      const handle = document.querySelector(".handle");
      const torque = document.querySelector(".torque");
      const seen = () => torque.textContent === "" && window.angles.add(handle.getAttribute("transform"));
      new MutationObserver(seen).observe(handle, { attributes: true });
    }""")
    page.page.keyboard.press("Escape")
    _ended(page)
    expect(page.page.locator(".torque")).to_be_empty()  # drawn
    assert page.page.evaluate("window.angles.size") == 1
    shown = page.csv()
    assert (shown["grip"] == 0.0).sum() >= 350
    assert shown["theta"].max() > 0.1


def test_a_finger_on_a_narrow_page(live: Live) -> None:
    page = live(fragment=_BRIEF, width=390, has_touch=True)
    touch = page.page.context.new_cdp_session(page.page)

    def send(kind: str, angle: float | None) -> None:
        points = [] if angle is None else [dict(zip("xy", _point(page.page, angle), strict=True))]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    top = page.page.evaluate("scrollY")
    send("touchStart", -20.0)
    for angle in np.linspace(-19.0, 8.0, 15):
        send("touchMove", angle)
        page.page.wait_for_timeout(16)
    _reaches(page, 2.0, 8.0)
    send("touchEnd", None)
    _ended(page)
    assert page.page.evaluate("scrollY") == top  # the finger drew the handle, not the page


def test_a_failure_is_said_in_the_words_of_the_model(live: Live) -> None:
    page = live()
    with page.rerun():
        page.type("J", "-1")
    with page.rerun():
        page.page.locator(".handle").press("ArrowRight")
    assert page.alert().startswith('The run stopped (error). Variable "J" cannot be -1')
    with page.rerun():
        page.type("J", "0.01")
    assert page.alert() == ""
    page.page.locator(".handle").press("ArrowRight")
    expect(page.page.locator(".torque")).to_contain_text("hand")
