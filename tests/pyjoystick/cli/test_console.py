"""Where the command line writes, and how wide."""

from __future__ import annotations

import pytest
from rich.console import Console
from rich.table import Table

from pyjoystick.cli.comparison_tables import print_differences
from pyjoystick.cli.console import output
from pyjoystick.motion import Difference
from pyjoystick.runs import RunComparison

_NAME = "assembly.returnSpring.a_variable_with_a_long_name"


def test_what_is_piped_is_not_cut_short(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    table = Table("first", "second", box=None)
    table.add_row("x" * 200, "y" * 200)
    output().print(table)
    assert f"{'x' * 200}  {'y' * 200}" in capsys.readouterr().out


def test_a_narrow_terminal_loses_nothing_of_a_comparison(capsys: pytest.CaptureFixture[str]) -> None:
    difference = Difference(_NAME, "N.m.s/rad", 1.25e-3, 0.125, 0.5, 2.5e-4, 0.375)
    runs = [
        RunComparison("ModelExchange", label, (difference,), frozenset({_NAME}))
        for label in ("sine of -20 deg", "sine of 15 deg")
    ]
    print_differences(Console(width=80, highlight=False), runs, every_run=True)
    shown = capsys.readouterr().out
    assert "…" not in shown
    assert shown.count("exceeded") == shown.count("1.25e-03") == 2
    letters = "".join(line[: line.index(" ", 2)].strip() for line in shown.splitlines() if line.strip())
    assert letters.count(_NAME[-8:]) == 2
