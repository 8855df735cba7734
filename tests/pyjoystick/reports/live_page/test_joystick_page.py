"""The page of a joystick in a real browser: scene, records, and the parameter file that it writes."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from playwright.sync_api import expect

from pyjoystick.cli import main
from pyjoystick.fmu import Fmu
from pyjoystick.identification import guess_release
from pyjoystick.model import NOMINAL, read_parameter_file, write_parameters
from pyjoystick.motion import read_record
from pyjoystick.reports.live_page.joystick_page import joystick_page
from tests.browser import LivePage
from tests.pyjoystick.reports.live_page.conftest import Live

_RECORDS = Path(__file__).parents[4] / "scenarios" / "data"
_RECORD = _RECORDS / "synthetic_constant_1.csv"


def _turn(page: LivePage) -> float:
    """The angle of the drawn handle (deg)."""
    transform = page.page.locator(".whole g").first.get_attribute("transform") or ""
    return float(re.fullmatch(r"rotate\((.*)\)", transform)[1])  # type: ignore[index]


def test_the_page_starts_with_the_joystick_of_the_command(live: Live, fmus: Path) -> None:
    page = live("--set", "damping.C=0.06", "--set", "forward.returnSpring.F_0=40", "--release-angle", "-15")
    shown = page.csv()
    assert shown.pop("T_hand").abs().max() == 0.0
    with Fmu(fmus / "JoystickFriction.fmu") as fmu:
        values = {"damping.C": 0.06, "forward.returnSpring.F_0": 40.0, "theta_start": math.radians(-15.0)}
        expected = fmu.run(shown.index.to_numpy(), parameters=values, outputs=list(shown.columns))
    np.testing.assert_allclose(shown.to_numpy(), expected.to_numpy(), rtol=1e-9, atol=1e-9)
    assert page.address() == ""  # these are the values that it starts with


def test_a_joystick_with_stops_has_them_on_its_page(live: Live, fmus: Path) -> None:
    page = live("--set", "stops.theta_stop=15deg", "--release-angle", "-20")
    shown = page.csv()
    with Fmu(fmus / "MountedJoystick.fmu") as fmu:
        values = {"stops.theta_stop": math.radians(15.0), "theta_start": math.radians(-20.0)}
        expected = fmu.run(shown.index.to_numpy(), parameters=values, outputs=list(shown.columns))
    assert shown["M_stop"].abs().max() > 10.0
    assert page.page.locator(".handle").get_attribute("aria-valuemax") == "15.0"
    np.testing.assert_allclose(shown.to_numpy(), expected.to_numpy(), rtol=1e-6, atol=1e-9)


def test_the_scene_follows_the_cursor(live: Live) -> None:
    page = live()
    table = page.csv()
    assert _turn(page) == pytest.approx(-20.0, abs=1e-3)
    states = page.page.locator(".springs .state")
    expect(states).to_have_text(["released", "released", "lifted off", "lifted off"])
    cursor = page.page.get_by_label("Time of the cursor")
    cursor.fill("80")  # of 1000 parts of 1.5 s
    expect(page.page.locator(".playback .time")).to_have_text("0.120 s")
    expect(states).to_have_text(["lifted off", "lifted off", "released", "released"])
    angle = float(np.degrees(table["theta"].loc[0.12]))
    assert angle > 10.0
    assert _turn(page) == pytest.approx(angle, abs=1e-3)
    travel = page.page.locator(".detail > g > g").locator("path.part")
    shifts = [path.locator("xpath=..").get_attribute("transform") for path in travel.all()]
    depth = 1e3 * table["x"].loc[0.12]  # mm: the drawing is to scale
    moved = [float(re.fullmatch(r"translate\(0 (.*)\)", str(shift))[1]) for shift in shifts]  # type: ignore[index]
    assert moved == [0.0, pytest.approx(depth, rel=1e-9)]


def test_lengths_that_the_model_refuses_are_not_drawn(live: Live) -> None:
    page = live()
    parts = page.page.locator(".detail")
    drawn = parts.inner_html()
    with page.rerun():
        page.type("a", "-3")  # the browser would complain of negative widths
    assert 'Variable "a" cannot be -0.003' in page.alert()
    page.settle()
    assert parts.inner_html() == drawn
    with page.rerun():
        page.type("a", "30")
    page.settle()
    assert parts.inner_html() != drawn


def test_what_springs_refuse_together_is_said_at_the_one_that_is_named(live: Live) -> None:
    page = live()
    with page.rerun():
        page.type("forward.returnSpring.x_0", "40")  # mm
    error = page.control("forward.balanceSpring.x_0").locator(".error")
    expect(error).to_contain_text("forward.balanceSpring.x_0 must not be less than returnSpring.x_0 = 0.04 m")
    assert page.control("forward.returnSpring.x_0").locator(".error").is_hidden()


def test_tab_goes_to_the_handle_and_on(live: Live) -> None:
    page = live().page
    page.get_by_label("Speed").focus()
    focused = []
    for _ in range(3):
        page.keyboard.press("Tab")
        focused.append(page.evaluate("document.activeElement.getAttribute('aria-label')"))
    assert focused == ["Plots", "Handle", "Remove the plot of theta"]


@pytest.mark.parametrize("count", [1, 6])
def test_records_of_many_samples_fit_the_page(live: Live, tmp_path: Path, count: int) -> None:
    time = np.linspace(0.0, 2.0, 5_000)
    arguments = []
    for i in range(count):
        theta = -(0.35 - 0.02 * i) * np.exp(-2.0 * time) * np.cos((30.0 + i) * time)
        file = tmp_path / f"fast_{i}.csv"
        np.savetxt(
            file, np.column_stack([time, theta]), delimiter=",", header="time (s),theta (rad)", comments=""
        )
        arguments += ["--record", str(file)]
    page = live(*arguments)  # which checks the size
    assert page.csv().index[-1] == pytest.approx(2.0, abs=0.01)
    data = json.loads(re.search(r'id="data">(.*?)</script>', page.file.read_text("utf-8"), re.DOTALL)[1])  # type: ignore[index]
    records = data["addition"]["records"]
    assert [record["name"] for record in records] == [f"fast_{i}" for i in range(count)]
    samples = [len(record["time"]) for record in records]
    assert 700 <= sum(samples) <= 800
    assert max(samples) - min(samples) <= 1
    assert min(record["time"][-1] for record in records) > 1.9  # thinned, not cut off


def test_play_moves_the_handle_and_stops_at_the_end(live: Live) -> None:
    page = live("--release-angle", "-10")
    page.page.get_by_label("Speed").select_option("1")
    at_rest = page.page.locator(".whole g").first.get_attribute("transform")
    page.page.get_by_role("button", name="Play").click()
    expect(page.page.locator(".whole g").first).not_to_have_attribute("transform", str(at_rest))
    expect(page.page.get_by_label("Time of the cursor")).to_have_attribute("aria-valuetext", "1.5 s")
    expect(page.page.get_by_role("button", name="Play")).to_be_visible()


def test_a_record_lies_over_the_motion_with_its_difference(live: Live) -> None:
    page = live("--record", str(_RECORD), "--record", str(_RECORDS / "synthetic_constant_2.csv"))
    record = read_record(_RECORD)
    release = guess_release(record.time, record.theta)
    shown = page.csv()["theta"]
    assert shown.iloc[0] == pytest.approx(release.angle, abs=1e-6)
    assert shown.index[-1] >= record.time[-1] - release.time
    late = (record.time >= release.time) & (record.time - release.time <= shown.index[-1])
    simulated = np.interp(record.time[late] - release.time, shown.index, shown)
    difference = np.degrees(simulated - record.theta[late])
    said = page.page.locator("span.difference").inner_text()
    rms, largest = (float(text) for text in re.findall(r"([\d.]+)°", said))
    assert rms == pytest.approx(float(np.sqrt(np.mean(difference**2))), rel=0.01)
    assert largest == pytest.approx(float(np.max(np.abs(difference))), rel=0.01)
    page.page.get_by_label("Record").select_option("synthetic_constant_2")
    with page.rerun():
        page.page.get_by_role("button", name="Release from its angle").click()
    assert page.page.locator("span.difference").inner_text() != said
    page.page.get_by_label("Record").select_option("none")
    expect(page.page.locator("figure.difference")).to_be_hidden()


@pytest.mark.parametrize("law", ["constant", "power-law"])
def test_the_values_are_saved_as_a_parameter_file(live: Live, tmp_path: Path, law: str) -> None:
    page = live("--damping", law, "--set", "m=0.9")
    changes = {
        "J": ("0.0123", 0.0123),
        "a": ("24.5", 0.0245),
        "forward.returnSpring.F_0": ("45", 45.0),
        "forward.balanceSpring.x_0": ("2.5", 0.0025),
        "backward.balanceSpring.k_s": ("3.1", 3100.0),
        ("damping.C" if law == "constant" else "damping.B"): ("0.05", 0.05),
    }
    for name, (text, _) in changes.items():
        with page.rerun():
            page.type(name, text)
    with page.page.expect_download() as download:
        page.page.get_by_role("button", name="joystick.toml").click()
    file = tmp_path / "joystick.toml"
    download.value.save_as(file)
    read = read_parameter_file(file)
    start = read_parameter_file(_written(tmp_path, law)).joystick.to_names()
    expected = start | {name: value for name, (_, value) in changes.items()}
    assert read.law == law
    assert read.joystick.to_names() == pytest.approx(expected, rel=1e-9)
    assert read.sources["geometry"] == "set by hand in the page of `pyjoystick explore`"
    assert read.sources["gravity"].startswith("standard acceleration")


def test_a_report_links_to_the_page(fmus: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("pyjoystick.fmu.files", "pyjoystick.fmu"):
        monkeypatch.setattr(f"{module}.build_folder", lambda: fmus)
    monkeypatch.setattr("pyjoystick.reports.html_report.report.SECTIONS", {})  # they take time
    report, page = tmp_path / "reports" / "report.html", tmp_path / "live pages" / "mine.html"
    assert main(["report", "--set", "m=0.9", "-o", str(report), "--live", str(page)]) == 0
    link = re.search(r'<a href="([^"#]*)">', report.read_text("utf-8"))
    assert link is not None
    assert (report.parent / unquote(link[1])).resolve() == page.resolve()
    data = json.loads(re.search(r'id="data">(.*?)</script>', page.read_text("utf-8"), re.DOTALL)[1])  # type: ignore[index]
    assert [one["start"] for one in data["variables"] if one["name"] == "m"] == [0.9]


def _written(folder: Path, law: str) -> Path:
    file = folder / "start.toml"
    assert main(["parameters", "--damping", law, "--set", "m=0.9", "-o", str(file)]) == 0
    return file


def test_friction_has_its_controls(live: Live) -> None:
    page = live("--set", "friction.T_c=0.05")
    assert page.csv()["M_f"].abs().max() == pytest.approx(0.05, rel=1e-6)
    with page.rerun():
        page.page.get_by_role("button", name="No preload").click()
    assert page.alert() == ""
    assert page.csv()["M_s"].abs().max() < 2.0


def test_friction_that_no_file_had_is_saved(live: Live, tmp_path: Path) -> None:
    page = live()
    with page.rerun():
        page.type("friction.T_c", "0.05")
    with page.page.expect_download() as download:
        page.page.get_by_role("button", name="joystick.toml").click()
    file = tmp_path / "joystick.toml"
    download.value.save_as(file)
    assert read_parameter_file(file).joystick == NOMINAL.replace({"friction.T_c": 0.05})


def test_without_a_compiler_and_a_module_in_the_fmu_the_command_says_what_is_missing(
    fmus_by_name: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "ziglang" else name)
    assert main(["explore", "-o", str(tmp_path / "page.html")]) == 1
    error = "the page could not be made: the C compiler is missing: pip install 'pyjoystick[build]' (ziglang)"
    assert error in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "page.pdf"], "must end in .html"),
        (["-o", "page.html", "--record", "missing.csv"], "missing.csv"),
        (["-o", "page.html", "--set", "nonsense=1"], "there is no parameter 'nonsense'"),
        (["-o", "page.html", "-p", "missing.toml"], "missing.toml"),
    ],
)
def test_faults(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["explore", *arguments]) != 0
    assert message in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("\nC = ", "\n  C = "),
        lambda text: text.replace("\nC = ", '\n"C" = '),
        lambda text: re.sub(r"\nx = \[(.*?),", r"\nx = [\1,\n", text, count=1),
    ],
    ids=["indented", "quoted", "lists over lines"],
)
def test_a_file_that_a_page_cannot_edit_is_written_anew(
    change: Callable[[str], str], fmus: Path, tmp_path: Path
) -> None:
    path = tmp_path / "own.toml"
    write_parameters(path, NOMINAL.replace({"damping.C": 0.05}))
    plain = read_parameter_file(path)
    text = change(path.read_text(encoding="utf-8"))
    assert text != path.read_text(encoding="utf-8")
    path.write_text(text, encoding="utf-8")
    file = read_parameter_file(path)
    page = joystick_page(fmus / "HeldJoystick.fmu", file, file.joystick, 0.3)
    data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])  # type: ignore[index]
    given = data["addition"]["toml"]
    assert re.search(r"^C = 0\.05", given, re.MULTILINE)
    path.write_text(given, encoding="utf-8")
    assert read_parameter_file(path).joystick == plain.joystick


def test_springs_that_no_file_holds_are_told(live: Live) -> None:
    page = live()
    page.page.goto(f"{page.page.url.partition('#')[0]}#forward.returnSpring.F_0=2000")
    page.page.reload()
    page.page.get_by_role("button", name="joystick.toml").click()
    expect(page.page.locator("#alert")).to_contain_text("forward: the ends of the segments must rise")
