"""What a scenario leaves behind."""

from __future__ import annotations

from pathlib import Path

import pytest
from matplotlib.figure import Figure

from pyjoystick.support import OutputFileError, save_results


def test_summary_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "new" / "results"
    save_results(folder, "## Numbers", {"one": Figure(), "two": Figure()})
    assert capsys.readouterr().out == "## Numbers\n"
    assert (folder / "summary.md").read_text(encoding="utf-8") == "## Numbers\n"
    assert sorted(path.name for path in folder.iterdir()) == [
        *("one.pdf", "one.png", "summary.md", "two.pdf", "two.png")
    ]


def test_a_file_in_the_way_is_named(tmp_path: Path) -> None:
    (tmp_path / "results").write_text("in the way")
    with pytest.raises(OutputFileError, match="results"):
        save_results(tmp_path / "results", "", {"one": Figure()})
