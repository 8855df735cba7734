"""The documentation builds as a site; a warning is an error."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from extensions.imports import door, rooms

from pyjoystick.fmu import MODELS
from tests.docs.pages import DOCS, NOTEBOOKS, ROOT

pytest.importorskip("sphinx", reason="the extra docs is not installed")

_LOADED = re.compile(r"<(?:script|link|img|iframe)\b[^>]*?\b(?:src|href)=\"(https?:[^\"]+)\"")


def test_the_site(tmp_path: Path, subtests: pytest.Subtests) -> None:
    """One test, so that the site is built once whatever process runs which test."""
    if not all((ROOT / "build" / "fmi2" / f"{name}.fmu").is_file() for name in MODELS):
        pytest.skip("the notebooks need the FMUs of make fmu")
    site = _built(tmp_path)
    for check in (
        every_page_is_there,
        notebooks_have_run,
        pages_need_no_network,
        the_live_page_is_in_two_pages,
        formulas_are_mathml,
        links_between_classes_of_the_library,
        names_of_pages_are_links,
        every_name_of_a_door_is_in_the_reference,
    ):
        with subtests.test(check.__name__):
            check(site)


def _built(folder: Path) -> Path:
    """The folder of the site; its notebooks run the FMUs of ``make fmu``."""
    options = ["--fail-on-warning", "--keep-going", "--nitpicky", "--quiet"]
    places = ["--doctree-dir", f"{folder}/doctrees", str(DOCS), str(folder / "html")]
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", *options, *places],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder / "html"


def every_page_is_there(site: Path) -> None:
    sources = [path.relative_to(DOCS) for path in DOCS.rglob("*.md")]
    assert [page for page in sources if not (site / page.with_suffix(".html")).is_file()] == []


def notebooks_have_run(site: Path) -> None:
    for notebook in NOTEBOOKS:
        page = (site / "notebooks" / notebook.with_suffix(".html").name).read_text(encoding="utf-8")
        assert "cell_output" in page
        assert ".svg" in page
        assert "Traceback" not in page


def names_of_pages_are_links(site: Path) -> None:
    """In the changelog, the claims and the docstrings; those of files that are no pages stay as they are."""
    left = [
        (path.name, name)
        for path in site.rglob("*.html")
        for name in re.findall(r"docs/([\w-]+)\.md", path.read_text(encoding="utf-8"))
        if (DOCS / f"{name}.md").is_file()
    ]
    assert left == []
    changelog = (site / "changelog.html").read_text(encoding="utf-8")
    assert '<a class="reference internal" href="fitting.html"><span class="doc">Fitting' in changelog


def pages_need_no_network(site: Path) -> None:
    for page in site.rglob("*.html"):
        assert _LOADED.findall(page.read_text(encoding="utf-8")) == [], page


def the_live_page_is_in_two_pages(site: Path) -> None:
    assert (site / "live" / "joystick.html").stat().st_size <= 250_000
    for name in ("index", "period"):
        page = (site / f"{name}.html").read_text(encoding="utf-8")
        link = r'<a class="live [^>]*href="live/joystick\.html[^>]*>\s*<img alt="The mech'
        assert re.search(link, page), name
        assert "_static/live.js" in page


def formulas_are_mathml(site: Path) -> None:
    page = (site / "equations.html").read_text(encoding="utf-8")
    assert page.count("<math") > 40
    assert page.count('class="eqno"') == page.count("\\tag") + 8
    assert "$$" not in page


def links_between_classes_of_the_library(site: Path) -> None:
    page = (site / "modelica.html").read_text(encoding="utf-8")
    wanted = set(re.findall(r'href="#(preloadedsprings[\w-]*)"', page))
    assert wanted
    assert wanted - set(re.findall(r'id="([\w-]+)"', page)) == set()


def every_name_of_a_door_is_in_the_reference(site: Path) -> None:
    for room in rooms("pyjoystick") - {"cli"}:
        page = (site / "api" / f"{room}.html").read_text(encoding="utf-8")
        names = {f"pyjoystick.{room}.{name}" for name in door(f"pyjoystick.{room}")}
        assert names
        assert names - set(re.findall(r'id="([\w.]+)"', page)) == set()
