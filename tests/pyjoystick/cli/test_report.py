"""``pyjoystick report``."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.cli import main
from tests.pyjoystick.reports.html_report.reading import read_page


def test_it_writes_one_page(fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    parameters, target = tmp_path / "joystick.toml", tmp_path / "new" / "report.html"
    assert main(["parameters", "--set", "m=0.95", "-o", str(parameters)]) == 0
    arguments = [
        "--parameters",
        str(parameters),
        "--set",
        "J=0.012",
        "--release-angle",
        "-15",
        "--title",
        "Mine",
    ]
    assert main(["report", *arguments, "--output", str(target)]) == 0
    assert "wrote" in capsys.readouterr().err
    read = read_page(target.read_text(encoding="utf-8"))
    assert read.headings[0] == "Mine"
    assert {"0.95", "0.012"} <= set(read.cells)
    assert [path.name for path in target.parent.iterdir()] == ["report.html"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "report.pdf"], "must end in .html"),
        (["-o", "report.html", "--set", "nonsense=1"], "there is no parameter 'nonsense'"),
        (["-o", "report.html", "--release-angle", "95"], "must lie between"),
        (["-o", "report.html", "--parameters", "missing.toml"], "missing.toml"),
        ([], "--output"),
    ],
)
def test_what_cannot_be_reported_leaves_nothing(
    arguments: list[str],
    message: str,
    fmus_by_name: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["report", *arguments]) != 0
    assert message in " ".join(capsys.readouterr().err.replace("│", " ").split())
    assert list(tmp_path.iterdir()) == []
