"""Live pages in the site: they replace their picture, which remains if scripts are disabled."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from tests.docs.pages import DOCS

pytest.importorskip("sphinx", reason="the extra docs is not installed")

from extensions import live_page
from sphinx.errors import ExtensionError


@pytest.fixture(scope="module")
def site(joystick_fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the live page, the site's script and a page that has both, as Sphinx writes it."""
    folder = tmp_path_factory.mktemp("site")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(live_page, "find_fmu", lambda name: joystick_fmus / f"{name}.fmu")
        live_page.make_page(folder)
    script = (DOCS / "_static" / "live.js").read_text(encoding="utf-8")
    link = f"<a class='live reference' href='{live_page.PAGE}#theta_start=-0.1'><img alt='A joystick'></a>"
    (folder / "index.html").write_text(f"<body>{link}<script>{script}</script>", encoding="utf-8")
    return folder


def test_it_takes_the_place_of_its_picture(site: Path, browser: Browser) -> None:
    page = browser.new_page()
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.goto((site / "index.html").as_uri())
    frame = page.frame_locator("iframe[title='Live page: A joystick']")
    frame.locator("body[data-runs]").wait_for(timeout=20_000)
    assert frame.locator('[data-name="theta_start"] input.number').input_value() == "-5.729578"
    expect(page.locator("a.live")).to_have_count(0)
    page.close()
    assert said == []


def test_without_scripts_the_picture_stays(site: Path, browser: Browser) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    expect(page.locator("a.live img")).to_have_attribute("alt", "A joystick")
    expect(page.locator("iframe")).to_have_count(0)
    context.close()


def test_a_page_that_has_grown_is_an_error(
    site: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live_page, "find_fmu", Path)
    monkeypatch.setattr(live_page, "joystick_page", lambda *_, **__: "ü" * 125_001)
    with pytest.raises(ExtensionError, match="has 250002 bytes; at most 250000"):
        live_page.make_page(tmp_path)
    assert not list(tmp_path.iterdir())
