"""Behaviour common to all commands: file names, options without their values, and help."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

from pyjoystick.cli import app
from pyjoystick.identification import read_fit_settings
from pyjoystick.runs import read_settings
from tests.pyjoystick.cli.conftest import Command

PYTHON_TYPES = re.compile(r"<(?:bool|int|float|str|path|list\[.*|tuple\[.*)>")


def _commands(group: Any, *before: str) -> Iterator[tuple[str, ...]]:
    for name, one in group.commands.items():
        if hasattr(one, "commands"):
            yield from _commands(one, *before, name)
        else:
            yield (*before, name)


@pytest.mark.parametrize(
    ("arguments", "suffixes"),
    [
        ("free-oscillation --csv out.xlsx", ".csv"),
        ("free-oscillation --csv out", ".csv"),
        ("free-oscillation --plot out.gif", ".png, .pdf, .svg"),
        ("torque --csv out.json", ".csv"),
        ("torque --json out.csv", ".json"),
        ("compare --json out.html", ".json"),
        ("peaks trial.csv --json out.txt", ".json"),
        ("peaks trial.csv --csv out.xlsx", ".csv"),
        ("budget trial.csv -p joystick.toml --json out.txt", ".json"),
        ("budget trial.csv -p joystick.toml --csv out.xlsx", ".csv"),
        ("sweep none.toml --indices out.xlsx", ".csv"),
        ("sweep none.toml --scatter a.png --scatter out.xlsx", ".png, .pdf, .svg"),
        ("parameters --output out.json", ".toml"),
        ("report -o out.pdf", ".html, .htm"),
        ("ssp out.zip", ".ssp"),
        ("import markers none.c3d --top T --base A B -o out.xlsx", ".csv"),
        ("import markers none.c3d --top T --base A B -o a.csv --motion out.mat", ".csv"),
        ("import accelerometer none.csv --angle a.csv --distance 1 -o out.xlsx", ".csv"),
        ("import load-curve none.csv --plot out.jpg", ".png, .pdf, .svg"),
    ],
)
def test_a_file_is_of_the_kind_that_its_name_says(
    arguments: str, suffixes: str, command: Command, tmp_path: Path
) -> None:
    outcome = command(*arguments.split())
    assert (outcome.code, outcome.out) == (1, "")
    assert re.fullmatch(rf"cannot write out[.\w]*: the name must end in {suffixes}", outcome.message)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("markers a.c3d --top T --base B1 -o x.csv", "Invalid value for --base: needs 2 values before -o"),
        ("markers a.c3d --top --base B1 B2 -o x.csv", "Invalid value for --top: needs a value before --base"),
        ("markers a.c3d --rest 3 --top T", "Invalid value for --rest: needs 2 values before --top"),
    ],
)
def test_an_option_without_its_value_takes_no_other_option(
    arguments: str, message: str, command: Command
) -> None:
    outcome = command("import", *arguments.split())
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err


def test_a_value_may_begin_with_a_dash(command: Command) -> None:
    assert command("free-oscillation", "-a", "-10deg", "-d", "0.01").code == 0


def test_help_stands_alone_and_speaks_no_python(command: Command) -> None:
    """A wheel holds no pages that it could refer to."""
    for words in [(), ("import",), *_commands(typer.main.get_command(app))]:
        outcome = command(*words, "--help")
        assert outcome.code == 0
        assert "docs/" not in outcome.out, words
        assert not PYTHON_TYPES.search(outcome.out), words


@pytest.mark.parametrize(("words", "reader"), [("fit", read_fit_settings), ("sweep", read_settings)])
@pytest.mark.usefixtures("fmus_by_name")
def test_settings_in_a_help_are_settings(words: str, reader: Any, command: Command, tmp_path: Path) -> None:
    lines = [line.strip(" │\n") for line in command(words, "--help").out.splitlines()]
    (tmp_path / "settings.toml").write_text(
        "\n".join(line for line in lines if "= " in line), encoding="utf-8"
    )
    assert 'fmu.path = "Joystick"' in lines
    reader(tmp_path / "settings.toml")


@pytest.mark.parametrize("option", ["--radius=266", "--radius=266mm"])
def test_lengths_of_options_have_units(option: str, command: Command) -> None:
    outcome = command("import", "markers", "none.c3d", "--top=T", "--base", "A", "B", "-o", "a.csv", option)
    assert ("none.c3d" if option.endswith("mm") else "--radius = 266.0: must be") in outcome.message


def test_a_length_in_another_unit_is_refused(command: Command) -> None:
    outcome = command("torque", "--pivot-to-handle", "3kg")
    assert outcome.code == 2
    assert "'3kg' must be a number, or one with a unit: m, cm, mm, um" in outcome.err
