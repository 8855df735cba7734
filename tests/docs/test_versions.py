"""Sites of several versions side by side, and the menu that switches between them."""

from __future__ import annotations

import functools
import json
import subprocess
import sys
import threading
from collections.abc import Iterator
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import jinja2
import pytest
import versions
from playwright.sync_api import Browser, expect

from tests.docs.pages import DOCS


def _built(folder: Path, version: str, *pages: str) -> Path:
    """A site of these pages beside the first one, with the menu as the theme's template writes it."""
    template = jinja2.Template((DOCS / "_templates/sidebar/versions.html").read_text(encoding="utf-8"))
    script = (DOCS / "_static/versions.js").read_text(encoding="utf-8")
    folder.mkdir()
    for page in ("index.html", *pages):
        top = "../" * page.count("/")
        menu = template.render(site_version=version, pathto=lambda *_, top=top, **__: top)
        (folder / page).parent.mkdir(exist_ok=True)
        (folder / page).write_text(
            f"<p>{version} {page}</p>{menu}<script>{script}</script>", encoding="utf-8"
        )
    return folder


def test_the_newest_release_comes_first_when_pages_are_opened(tmp_path: Path) -> None:
    site = tmp_path / "site"
    assert versions.add(_built(tmp_path / "a", "dev"), site, "dev") == ["dev"]
    assert 'url=dev/"' in (site / "index.html").read_text(encoding="utf-8")
    for version in ("0.9.0", "0.10.0", "0.9.1"):
        found = versions.add(_built(tmp_path / version, version), site, version)
    assert found == ["dev", "0.10.0", "0.9.1", "0.9.0"]
    assert json.loads((site / "versions.json").read_text(encoding="utf-8")) == found
    assert 'url=0.10.0/"' in (site / "index.html").read_text(encoding="utf-8")


def test_a_version_is_replaced_as_a_whole(tmp_path: Path) -> None:
    site = tmp_path / "site"
    versions.add(_built(tmp_path / "old", "dev", "gone.html"), site, "dev")
    versions.add(_built(tmp_path / "new", "dev", "new.html"), site, "dev")
    assert {path.name for path in (site / "dev").iterdir()} == {"index.html", "new.html"}


@pytest.mark.parametrize("version", ["../dev", "v0.1.0", "", "0.1.0rc1"])
def test_other_names_are_refused_and_nothing_is_touched(tmp_path: Path, version: str) -> None:
    site = tmp_path / "site"
    built = _built(tmp_path / "built", "dev")
    done = subprocess.run(
        [sys.executable, DOCS / "versions.py", built, site, version],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert f"numbers with dots, not {version!r}" in done.stderr
    assert not site.exists()


def test_a_folder_without_a_site_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="make docs"):
        versions.add(tmp_path, tmp_path / "site", "dev")


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """Where a server on this machine has two versions, of which the old one lacks a page."""
    site = tmp_path / "site"
    versions.add(_built(tmp_path / "0.1", "0.1", "api/fmu.html"), site, "0.1")
    versions.add(_built(tmp_path / "dev", "dev", "api/fmu.html", "new.html"), site, "dev")

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:
            """Keep requests out of the output of the tests."""

    with ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(site))) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.mark.parametrize(
    ("page", "other"), [("api/fmu.html", "api/fmu.html"), ("new.html", "index.html"), ("", "index.html")]
)
def test_the_menu_leads_to_the_same_page_or_the_first(
    address: str, browser: Browser, page: str, other: str
) -> None:
    tab = browser.new_page()
    tab.goto(f"{address}/dev/{page}")
    menu = tab.get_by_label("Version")
    expect(menu.locator("option")).to_have_text(["dev", "0.1"])
    expect(menu.locator("option:checked")).to_have_text("dev")
    menu.select_option(label="0.1")
    expect(tab.get_by_text(f"0.1 {other}")).to_be_visible()
    tab.close()


def test_pages_built_to_be_read_in_place_have_no_menu(tmp_path: Path) -> None:
    page = _built(tmp_path / "site", "") / "index.html"
    assert "<select" not in page.read_text(encoding="utf-8")
