"""The documentation as a site: it is built once, and a warning is an error."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from pkgutil import iter_modules

import pytest

import pyjoystick
from pyjoystick.fmu import MODELS
from tests.docs.pages import DOCS, NOTEBOOKS, ROOT

pytest.importorskip("sphinx", reason="the extra docs is not installed")

# One worker builds the site for all of these.
pytestmark = pytest.mark.xdist_group("site")

_LOADED = re.compile(r"<(?:script|link|img|iframe)\b[^>]*?\b(?:src|href)=\"(https?:[^\"]+)\"")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the site; its notebooks run the FMUs of ``make fmu``."""
    if not all((ROOT / "build" / "fmi2" / f"{name}.fmu").is_file() for name in MODELS):
        pytest.skip("the notebooks need the FMUs of make fmu")
    folder = tmp_path_factory.mktemp("site")
    options = [
        "--fail-on-warning",
        "--keep-going",
        "--nitpicky",
        "--quiet",
        "--doctree-dir",
        f"{folder}/doctrees",
    ]
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", *options, str(DOCS), str(folder / "html")],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder / "html"


def test_every_page_is_there(site: Path) -> None:
    sources = [path.relative_to(DOCS) for path in DOCS.rglob("*.md")]
    assert [page for page in sources if not (site / page.with_suffix(".html")).is_file()] == []


def test_notebooks_have_run(site: Path) -> None:
    for notebook in NOTEBOOKS:
        page = (site / "notebooks" / notebook.with_suffix(".html").name).read_text(encoding="utf-8")
        assert "cell_output" in page
        assert ".svg" in page
        assert "Traceback" not in page


def test_pages_need_no_network(site: Path) -> None:
    for page in site.rglob("*.html"):
        assert _LOADED.findall(page.read_text(encoding="utf-8")) == [], page


def test_formulas_are_mathml(site: Path) -> None:
    page = (site / "equations.html").read_text(encoding="utf-8")
    assert page.count("<math") > 40
    assert page.count('class="eqno"') == page.count("\\tag") + 8
    assert "$$" not in page


def test_links_between_classes_of_the_library(site: Path) -> None:
    page = (site / "modelica.html").read_text(encoding="utf-8")
    wanted = set(re.findall(r'href="#(preloadedsprings[\w-]*)"', page))
    assert wanted
    assert wanted - set(re.findall(r'id="([\w-]+)"', page)) == set()


#: What serves the rest of the package, not its users; the command line has a page of its own.
INNER = {"__main__", "_types", "checks", "cli", "defaults", "toml_table", "versions"}


def test_every_part_of_the_package_is_in_the_reference() -> None:
    modules = {module.name for module in iter_modules(pyjoystick.__path__)}
    pages = "".join(page.read_text(encoding="utf-8") for page in DOCS.glob("api/*.md"))
    documented = set(re.findall(r"auto(?:module|class):: pyjoystick\.(\w+)", pages))
    assert modules - documented == INNER
