"""The page in a real browser: every control, errors at the right place, links, files, no network access."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect
from typer.testing import CliRunner

from fmu_build import BuildError
from fmu_build.explore import Preset, Settings, explore_page
from fmu_build.explore.command import app
from tests.browser import LivePage
from tests.fmu_build.explore.conftest import Pages

Live = Callable[..., LivePage]
#: Whether a canvas has a point of a color.
_HAS = """(canvas, color) => {
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  for (let i = 0; i < data.length; i += 4) if (color.every((part, j) => data[i + j] === part)) return true;
  return false;
}"""


def test_one_small_file_that_allows_nothing_but_itself(pages: Pages) -> None:
    text = pages.file("Joystick").read_text("utf-8")
    assert len(text.encode()) <= 250_000
    assert "default-src 'none'; script-src 'sha256-" in text
    assert "unsafe-inline" not in text
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "").replace("http-equiv", "")


def test_texts_of_the_model_stay_text(live: Live) -> None:
    page = live("Models.Ball").page
    assert page.locator("header p").inner_text() == "A ball that bounces </script><b>on a floor</b>"
    assert page.locator("#control-1-about, .about").first.inner_text() == "Coefficient of <i>restitution</i>"
    assert page.locator("b, aside i").count() == 0


def test_slider_by_keyboard_says_its_value_and_reset_takes_it_back(live: Live) -> None:
    page = live("Joystick")
    control = page.control("damping.C")
    slider = control.get_by_role("slider")
    assert slider.get_attribute("aria-valuetext") == "0.045 N m s/rad"
    slider.focus()
    with page.rerun():
        page.page.keyboard.press("End")
    assert slider.get_attribute("aria-valuetext") == "0.225 N m s/rad"
    assert control.locator("input.number").input_value() == "0.225"
    assert page.csv()["C"].iloc[0] == pytest.approx(0.225, rel=1e-12)
    with page.rerun():
        slider.press("ArrowLeft")
    # A log scale of 400 steps from 0.009 to 0.225, three digits.
    assert page.csv()["C"].iloc[0] == pytest.approx(float(f"{0.225 / 25 ** (1 / 400):.3g}"), rel=1e-12)
    with page.rerun():
        control.get_by_role("button", name="Reset damping.C").click()
    assert control.locator("input.number").input_value() == "0.045"
    assert page.address() == ""


def test_every_control_of_a_model_changes_its_run(live: Live) -> None:
    page = live("Models.Chain")
    names = [c.get_attribute("data-name") for c in page.page.locator(".control").all()]
    assert {"m[1]", "m[2]", "k", "kind", "strands", "F", "x[1]", "v[2]"} <= set(names)
    with page.rerun():
        page.type("F", "5")
    for name in names:
        control = page.control(str(name))
        before = page.words()
        with page.rerun():
            if control.locator("select").count():
                control.locator("select").select_option("hard")
            else:
                control.get_by_role("slider").press("Home")
        assert page.words() != before, name


def test_a_constant_takes_the_place_of_a_table(live: Live) -> None:
    page = live("Joystick")
    table = page.control("T").locator("textarea")
    assert table.is_visible()
    with page.rerun():
        page.type("T", "0.5")
    assert table.is_hidden()
    constant = page.csv()
    assert constant.equals(live("Joystick", f"#{page.address()}").csv())
    with page.rerun():
        page.control("T").get_by_role("button", name="Reset T").click()
    assert table.input_value().startswith("0, 0\n0.1, 0\n0.1, -1.7")
    assert not page.csv().equals(constant)


def test_the_table_is_saved_as_a_file(live: Live) -> None:
    page = live("Models.Ball")
    assert page.csv(download=True).equals(page.csv())


def test_a_box_is_a_boolean(live: Live) -> None:
    page = live("Models.Ball")
    with page.rerun():
        page.control("isFlying").locator("input").uncheck()
    assert page.csv()["h"].tolist() == [1.0] * 601
    assert page.address() == "isFlying=0"


def test_a_link_is_a_state(live: Live) -> None:
    page = live("Joystick")
    with page.rerun():
        page.type("theta_start", "-20")
    with page.rerun():
        page.type("forward.returnSpring.k_s", "3")  # N/mm
    with page.rerun():
        page.page.get_by_label("Stop time").fill("0.5")
    with page.rerun():
        page.control("T").get_by_label("over time", exact=True).uncheck()
    table = page.csv()
    assert len(table) == 501
    again = live("Joystick", f"#{page.address()}")
    assert again.csv().equals(table)
    assert again.control("theta_start").locator("input.number").input_value() == "-20"
    with page.rerun():
        page.page.get_by_role("button", name="Reset all").click()
    assert page.address() == ""
    assert len(page.csv()) == 1501


def test_a_link_from_another_model_is_not_believed(live: Live) -> None:
    page = live("Models.Ball", "#e=0.5&mass=3&h=high&:stop=-1")
    assert page.csv().index[-1] == 3.0
    assert page.control("e").locator("input.number").input_value() == "0.5"
    page = live("Models.Ball", "#mass=3&:step=1e-9")
    assert page.control("e").locator("input.number").input_value() == "0.8"
    assert page.csv().index[1] > 1e-4
    expect(page.page.locator("#note")).to_contain_text("does not take: mass, :stop, :step")


def test_what_the_model_refuses_is_said_at_its_control(live: Live) -> None:
    page = live("Joystick")
    with page.rerun():
        page.type("J", "-1")
    said = 'Variable "J" cannot be -1: the allowed range is 1e-60 to inf.'
    assert page.control("J").locator(".error").inner_text() == said
    assert page.alert() == f"The run stopped (error). {said}"
    assert page.control("m").locator(".error").first.is_hidden()
    with page.rerun():
        page.type("J", "0.02")
    assert page.alert() == ""
    assert page.control("J").locator(".error").is_hidden()


def test_a_refused_run_saves_no_file_of_the_run_before(live: Live) -> None:
    page = live("Joystick")
    with page.rerun():
        page.type("J", "-1")
    refused = page.alert()
    saved = page.page.evaluate(
        """() => {
          let files = 0;
          const { click } = HTMLAnchorElement.prototype;
          HTMLAnchorElement.prototype.click = () => { files += 1; };
          for (const one of document.querySelectorAll(".actions button")) {
            if (["CSV", "PNG"].includes(one.textContent)) one.click();
          }
          HTMLAnchorElement.prototype.click = click;
          return files;
        }"""
    )
    assert saved == 0
    assert page.alert() == f"Nothing was saved: what is shown is an earlier run. {refused}"
    with page.rerun():
        page.type("J", "0.02")
    assert page.alert() == ""
    assert len(page.csv()) > 1


def test_a_long_run_does_not_stand_under_the_message_of_the_one_before(live: Live) -> None:
    page = live("Models.Chain")
    with page.rerun():
        page.page.evaluate("location.hash = '#k=-1'")
    assert "k" in page.alert()
    with page.rerun():  # some 1e8 oscillations in an hour
        page.page.evaluate("location.hash = '#F=1&k=1e9&:stop=3600&:step=1'")
        said = "The model is computing. What is shown is an earlier run."
        expect(page.page.locator("#alert")).to_have_text(said, timeout=3000)
        expect(page.control("k").locator(".error")).to_be_hidden()
    assert page.alert() == "The run stopped (fatal). The run did not end within 5 s and was stopped."


def test_a_run_that_breaks_off_shows_its_rows_and_the_message(live: Live) -> None:
    page = live("Models.Chain")
    with page.rerun():
        page.type("F", "1e5")
    assert "x[1] left the room" in page.alert()
    rows = len(page.csv())
    assert 1 < rows < 401
    expect(page.page.locator("#status")).to_contain_text(f"{rows} rows in")


@pytest.mark.parametrize("text", ["", "abc", "1e999", "1,2,3"])
def test_what_is_no_number_is_said_while_it_is_typed(live: Live, text: str) -> None:
    page = live("Models.Ball")
    page.type("e", text)
    expect(page.control("e").locator(".error")).to_have_text("Type a number, such as 0.5 or 1e-3.")
    with page.rerun():
        page.type("e", "0.5")
    assert page.control("e").locator(".error").is_hidden()


def test_faults_in_tables_and_in_the_experiment(live: Live) -> None:
    page = live("Models.Chain")
    control = page.control("F")
    with page.rerun():
        control.get_by_label("over time", exact=True).check()
    for text, message in {
        "0 0\n1": "Line 2, “1”, must be a time and a value.",
        "1 0\n0 1": "Line 2: the time 0 is before that of the line above.",
        "": "Type at least one line: a time and a value.",
    }.items():
        control.locator("textarea").fill(text)
        expect(control.locator(".table .error")).to_have_text(message)
    page.page.get_by_label("Step", exact=True).fill("1e-9")
    expect(page.page.locator(".experiment .error")).to_have_text("The step must be at least 0.00008 s.")
    page.page.get_by_label("Stop time").fill("-1")
    expect(page.page.locator(".experiment .error")).to_have_text("The stop time must be a number above 0 s.")


def test_a_model_that_does_not_end_is_stopped(live: Live, pages: Pages) -> None:
    # Some 1e8 oscillations in an hour.
    page = live("Models.Chain", "#F=1&k=1e9&:stop=3600&:step=1")
    assert page.alert() == "The run stopped (fatal). The run did not end within 5 s and was stopped."
    with page.rerun():
        page.page.get_by_role("button", name="Reset all").click()
    assert page.alert() == ""
    assert len(page.csv()) == 401


def test_a_stop_time_between_two_steps_ends_with_the_step_before(live: Live) -> None:
    page = live("Models.Ball", "#:stop=1.0026&:step=0.005")
    assert page.alert() == ""
    assert page.csv().index[-1] == pytest.approx(1.0)


def test_presets_and_start_values_of_the_settings(live: Live, pages: Pages) -> None:
    presets = (Preset("Dead", {"e": 0.1}), Preset("High", {"h": 4.0}))
    settings = Settings(title="A <ball>", values={"e": 0.5}, first=("h",), presets=presets)
    page = live("Models.Ball", file=pages.file("Models.Ball", settings, "presets"))
    assert page.page.locator("h1").inner_text() == "A <ball>"
    first = page.csv()
    fresh = live("Models.Ball", "#e=0.5").csv()
    assert first.equals(fresh)
    with page.rerun():
        page.page.get_by_role("button", name="High").click()
    assert page.csv().equals(live("Models.Ball", "#e=0.5&h=4").csv())
    with page.rerun():
        page.page.get_by_role("button", name="Dead").click()
    assert page.csv().equals(live("Models.Ball", "#e=0.1").csv())


def test_plots_are_chosen_and_said_in_words_and_numbers(live: Live) -> None:
    page = live("Models.Ball")
    assert page.page.locator("figure").count() == 3
    page.page.locator("#plot-y").select_option("bounces")
    with page.rerun():
        page.page.get_by_role("button", name="Add plot").click()
    last = page.page.locator("figure").last
    expect(last.locator("canvas")).to_have_attribute("aria-label", "bounces from 0 to 6; over time")
    page.page.get_by_text("Values as a table").click()
    rows = page.page.locator("table tbody tr")
    assert rows.first.inner_text().split() == ["0", "1", "0", "0"]
    with page.rerun():
        page.page.get_by_role("button", name="Remove the plot of bounces").click()
    assert page.page.locator("figure").count() == 3


def test_cursor_by_keyboard_and_playback(live: Live) -> None:
    page = live("Models.Ball")
    cursor = page.page.get_by_label("Time of the cursor")
    cursor.press("End")
    expect(cursor).to_have_attribute("aria-valuetext", "3 s")
    height = page.csv()["h"].iloc[-1]
    expect(page.page.locator("figure .value").first).to_have_text(f"{float(f'{height:.4g}')} m")
    page.page.get_by_label("Speed").select_option("1")
    page.page.get_by_role("button", name="Play").click()
    page.page.get_by_role("button", name="Pause").click()
    assert cursor.get_attribute("aria-valuetext") != "3 s"


def test_png_has_the_size_of_the_plots(live: Live) -> None:
    page = live("Models.Ball")
    with page.page.expect_download() as download:
        page.page.get_by_role("button", name="PNG").click()
    content = Path(download.value.path()).read_bytes()
    width, height = struct.unpack(">II", content[16:24])
    assert content.startswith(b"\x89PNG")
    assert width > 600
    assert height > 400


def test_a_phone_shows_plots_and_controls_side_by_side_of_nothing(live: Live) -> None:
    page = live("Joystick", width=390)
    assert page.page.locator("body").bounding_box()["width"] <= 390  # type: ignore[index]
    page.control("J").get_by_role("slider").scroll_into_view_if_needed()
    assert page.page.locator("figure").first.is_visible()


def test_paper_shows_all_plots_in_dark_ink(pages: Pages, browser: Browser) -> None:
    live = LivePage.of(browser, pages.file("Models.Ball"), color_scheme="dark")
    live.settle()
    page, curve = live.page, live.page.locator("canvas").first
    assert not curve.evaluate(_HAS, [0x00, 0x72, 0xB2])
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 700, "height": 1000})  # of A4
    for figure in page.locator("figure").all():
        box = figure.bounding_box()
        assert box is not None
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 700
    assert curve.evaluate(_HAS, [0x00, 0x72, 0xB2])
    expect(page.get_by_role("button", name="CSV")).to_be_hidden()
    live.close()


def test_without_scripts_the_page_says_what_it_is(pages: Pages, browser: Browser) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(pages.file("Models.Ball").as_uri())
    expect(page.get_by_role("heading", name="Ball")).to_be_visible()
    expect(page.locator("noscript p")).to_contain_text("needs JavaScript")
    expect(page.locator("#controls")).to_be_hidden()
    context.close()


def test_the_command_writes_a_page_of_an_fmu(pages: Pages, tmp_path: Path) -> None:
    settings = tmp_path / "ball.toml"
    settings.write_text('[explore]\ntitle = "From the command line"\n')
    target = tmp_path / "new" / "ball.html"
    fmu = str(pages.fmu("Models.Ball"))
    result = CliRunner().invoke(app, [fmu, "-o", str(target), "--settings", str(settings)])
    assert result.exit_code == 0
    assert result.stdout == f"{target}\n"
    assert "<title>From the command line</title>" in target.read_text("utf-8")


def test_faults_of_the_command(tmp_path: Path) -> None:
    result = CliRunner().invoke(app, [str(tmp_path / "no.fmu"), "-o", str(tmp_path / "page.html")])
    assert result.exit_code == 1
    assert "no.fmu" in result.stderr
    result = CliRunner().invoke(app, ["No.Model", "-o", str(tmp_path / "page.pdf")])
    assert (result.exit_code, "must end in .html" in result.stderr) == (1, True)


def test_an_fmu_of_fmi_3_is_refused(joystick_fmus3: Path) -> None:
    with pytest.raises(BuildError, match=r"no Co-Simulation of FMI 2\.0"):
        explore_page(joystick_fmus3 / "Joystick.fmu")
