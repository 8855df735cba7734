"""Period over amplitude and other plots of derived quantities: their numbers, also as files."""

from __future__ import annotations

import csv
import math
import re
import struct
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
import pandas as pd
import pytest
from playwright.sync_api import expect

from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, undamped_oscillation
from pyjoystick.motion import find_peaks, periods
from tests.browser import LivePage
from tests.pyjoystick.reports.live_page.conftest import Live

_RECORDS = Path(__file__).parents[4] / "scenarios" / "data"


def _saved(page: LivePage, kind: str) -> pd.DataFrame:
    with page.page.expect_download() as download:
        page.page.locator(f"figure.{kind}").get_by_role("button").click()
    header, *rows = csv.reader(Path(download.value.path()).read_text("utf-8").splitlines())
    return pd.DataFrame(rows, columns=header)


def _periods(page: LivePage) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Amplitude (rad) and period (s): of the twenty releases, and of the motion that is shown."""
    expect(page.page.locator(".periods canvas")).to_have_attribute("aria-label", re.compile("from .* ms at"))
    table = _saved(page, "periods")
    numbers = table.iloc[:, 1:].astype(float).to_numpy()
    return numbers[table["motion"] == "released"], numbers[table["motion"] == "shown"]


def test_periods_are_those_of_the_fmu(live: Live, fmus: Path) -> None:
    released, shown = _periods(live("--set", "m=0.8"))
    time = np.arange(2001) * 1e-3
    found = []
    with Fmu(fmus / "JoystickFriction.fmu") as fmu:
        for angle in np.geomspace(math.radians(0.5), math.radians(20.0), 20):
            start = {"theta_start": -angle, "m": 0.8}
            run = fmu.run(time, parameters=start, outputs=["theta", "omega"])
            peaks = find_peaks(run.index, run["theta"], run["omega"])
            found.append(periods(peaks, release_time=0.0)[["amplitude", "period"]].iloc[0])
    np.testing.assert_allclose(released, np.array(found), rtol=1e-6)
    run = run.loc[:1.5]  # the last release is that of the page
    peaks = find_peaks(run.index, run["theta"], run["omega"])
    expected = periods(peaks, release_time=0.0)[["amplitude", "period"]].to_numpy()
    np.testing.assert_allclose(shown, expected, rtol=1e-5)  # the last peaks are within the clearance


def test_without_damping_they_are_those_of_the_energy(live: Live) -> None:
    released, _ = _periods(live("--set", "damping.C=0"))
    assert len(released) == 20
    for angle, (amplitude, period) in zip(
        np.geomspace(math.radians(0.5), math.radians(20.0), 20), released, strict=True
    ):
        exact = undamped_oscillation(NOMINAL, -angle)
        # Rows are 1 ms apart: the cubic between two of them errs where a kink is close to the peak.
        assert period == pytest.approx(exact.period, rel=1e-4)
        assert amplitude == pytest.approx(exact.forward, rel=1e-3)


def test_they_end_at_the_stops(live: Live) -> None:
    page = live("--set", "stops.theta_stop=10deg", "--set", "damping.C=0", fragment="#theta_start=-0.1")
    released, _ = _periods(page)
    # Heavy on one side, the handle swings a little farther to the other.
    assert math.degrees(released[-1, 0]) == pytest.approx(10.0, abs=0.5)


def test_they_follow_a_value_and_can_be_kept(live: Live) -> None:
    page = live()
    before, _ = _periods(page)
    page.page.get_by_role("button", name="Keep curves").click()
    canvas = page.page.locator(".periods canvas")
    words = canvas.get_attribute("aria-label")
    page.page.get_by_role("button", name="No preload").click()
    expect(canvas).not_to_have_attribute("aria-label", str(words))
    after, _ = _periods(page)
    # What is left without preload is nearly linear, but for the clearance.
    assert before[-1, 1] / before[5, 1] > 1.5
    assert after[-1, 1] / after[5, 1] < before[-1, 1] / before[5, 1]


def test_the_difference_is_saved_and_drawn_into_the_picture(live: Live) -> None:
    plot = "#:plots=" + quote('[[null,"theta"]]')
    page = live("--record", str(_RECORDS / "synthetic_constant_1.csv"), fragment=plot)
    table = _saved(page, "difference")
    assert list(table.columns) == ["time (s)", "simulated - measured theta (rad)"]
    rms = math.degrees(float(np.sqrt(np.mean(table.iloc[:, 1].astype(float) ** 2))))
    said = page.page.locator("span.difference").inner_text()
    assert rms == pytest.approx(float(re.findall(r"([\d.]+)° rms", said)[0]), rel=0.01)
    heights = []
    for record in ("synthetic_constant_1", "none"):
        page.page.get_by_label("Record").select_option(record)
        with page.page.expect_download() as download:
            page.page.get_by_role("button", name="PNG").click()
        heights.append(struct.unpack(">I", Path(download.value.path()).read_bytes()[20:24])[0])
    assert heights[0] > heights[1]  # three plots are two rows of them, two are one


def test_a_link_names_the_record(live: Live) -> None:
    both = ["--record", str(_RECORDS / "synthetic_constant_1.csv")]
    both += ["--record", str(_RECORDS / "synthetic_constant_2.csv")]
    page = live(*both)
    page.page.get_by_label("Record").select_option("synthetic_constant_2")
    assert "%40record=synthetic_constant_2" in page.address()
    again = live(*both, fragment=f"#{page.address()}")
    expect(again.page.get_by_label("Record")).to_have_value("1")
    assert again.page.locator("#note").is_hidden()
    page.page.get_by_label("Record").select_option("none")
    none = live(*both, fragment=f"#{page.address()}")
    expect(none.page.get_by_label("Record")).to_have_value("")
    expect(none.page.locator("figure.difference")).to_be_hidden()
