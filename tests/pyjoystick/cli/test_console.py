"""The command line's output streams and line width."""

from __future__ import annotations

import pytest
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pyjoystick.cli.comparison_tables import print_differences
from pyjoystick.cli.console import output
from pyjoystick.motion import Difference
from pyjoystick.runs import RunComparison
from pyjoystick.support import TextTable
from tests.pyjoystick.cli.conftest import Command

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


@pytest.mark.parametrize("width", [60, 80, 100, 140])
def test_tables_give_way_between_words(
    width: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    cells = ["backward.balanceSpring.k_h", "[x] stiffness of the restraint, rod or housing", "1.25 to 1.375"]
    markdown = TextTable(["a name", "what the parameter means", "95 % interval"], [cells] * 2).markdown()
    rich = Table("a name", "what the parameter means", "95 % interval", box=None)
    for _ in range(2):
        rich.add_row(*map(escape, cells))
    for table in (f"Before\n\n{markdown}\n\nAfter", rich):
        output().print(table, markup=isinstance(table, Table))
        shown = capsys.readouterr().out
        assert max(map(len, shown.splitlines())) <= width
        words = shown.split()
        assert all(words.count(word) >= 2 for cell in cells for word in cell.split())


def test_a_word_longer_than_a_terminal_is_kept(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", "30")
    output().print(TextTable(["name", "value"], [["x" * 40, "1"]]).markdown())
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 30
    assert shown.count("x") == 40


def test_a_report_is_as_it_is_where_there_is_room(capsys: pytest.CaptureFixture[str]) -> None:
    markdown = TextTable(["name", "value"], [["a", "1"]]).markdown()
    output().print(markdown)
    assert capsys.readouterr().out == f"{markdown}\n"


@pytest.mark.parametrize("width", ["0", "7"])
def test_a_width_that_no_terminal_has_hides_nothing(
    width: str, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    expected = command("parameters").out
    monkeypatch.setenv("COLUMNS", width)
    assert command("parameters").out == expected
    monkeypatch.setenv("COLUMNS", width)
    assert "there is no parameter 'nope'" in command("free-oscillation", "--set", "nope=1").err
