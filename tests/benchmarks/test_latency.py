"""The latency benchmark detects what a command imports."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks import latency


def test_imports_are_counted_by_package(tmp_path: Path) -> None:
    found = latency.imported(["-c", "import numpy.linalg, json"], tmp_path)
    assert found["numpy"] > found["json"] > 0
    assert "pandas" not in found


@pytest.mark.usefixtures("joystick_fmus")
def test_a_command_without_figure_and_statistics_imports_none(tmp_path: Path) -> None:
    found = latency.imported(["-m", "pyjoystick", "free-oscillation"], tmp_path)
    assert found["pandas"] > 0
    assert not {"matplotlib", "scipy", "numba", "asteval", "rumoca"} & set(found)


@pytest.mark.usefixtures("joystick_fmus")
def test_a_page_imports_no_package_for_figures(tmp_path: Path) -> None:
    found = latency.imported(["-m", "pyjoystick", "explore", "-o", "page.html"], tmp_path)
    assert found["fmpy"] > 0
    assert "matplotlib" not in found
    assert (tmp_path / "page.html").is_file()


def test_the_table_has_every_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(latency, "COMMANDS", {"--help": ["--help"]})
    row, alone = latency.commands_table(tmp_path, 1).splitlines()[2:]
    name, seconds, ratio, packages = (cell.strip() for cell in row.strip("|").split("|"))
    assert name == "`--help`"
    assert float(seconds) > 0.0
    # Help loads none of the packages that it is compared with, and draws nothing.
    assert float(ratio) < 1.0
    assert float(alone.split("|")[2]) > float(seconds)
    assert "pandas" not in packages
