"""The project's metadata agree in all files."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
#: Where conda-forge has another name; its matplotlib has a graphical interface besides.
CONDA_NAMES = {"lazy-loader": "lazy_loader", "matplotlib": "matplotlib-base"}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_the_citation_is_of_this_version() -> None:
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    found = dict(re.findall(r"^(version|license): (.+)$", text, re.MULTILINE))
    assert found == {"version": PROJECT["version"], "license": PROJECT["license"]}


def test_the_install_page_names_every_extra() -> None:
    """Beside those that only work on the project itself needs."""
    page = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")
    table = page[page.index("| extra |") : page.index("## ")]
    extras = {name for row in table.splitlines() if row.startswith("| `") for name in _names(row)}
    assert extras == set(PROJECT["optional-dependencies"]) - {"dev", "docs"}


def test_the_install_page_names_the_wheel() -> None:
    page = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")
    assert f"dist/pyjoystick-{PROJECT['version']}-py3-none-any.whl" in page


def test_the_conda_recipe_asks_for_what_the_wheel_needs() -> None:
    """The same packages from the same versions on, by the names of conda-forge."""
    recipe = yaml.safe_load((ROOT / "conda" / "recipe.yaml").read_text(encoding="utf-8"))
    assert recipe["context"]["version"] == PROJECT["version"]
    assert recipe["about"]["license"] == PROJECT["license"]
    needed = {f"python {PROJECT['requires-python']}"}
    for requirement in PROJECT["dependencies"]:
        name, least = requirement.split(">=")
        needed.add(f"{CONDA_NAMES.get(name, name)} >={least}")
    assert set(recipe["requirements"]["run"]) == needed
    (fast,) = PROJECT["optional-dependencies"]["fast"]
    assert recipe["requirements"]["run_constraints"] == [fast.replace(">=", " >=")]


def _names(row: str) -> list[str]:
    return re.findall(r"`(\w+)`", row.split("|")[1])
