"""``pyjoystick --quiet``: keeps results, errors and warnings; drops progress and notes."""

from __future__ import annotations

import json
import logging
import re
from pathlib import Path

import pytest

from pyjoystick import cli
from pyjoystick.cli.console import print_progress, progress_console
from pyjoystick.cli.invocation import invocation
from tests.pyjoystick.cli.conftest import Command

MODULES = sorted(Path(cli.__file__).parent.glob("*.py"))


def test_results_stay_and_progress_goes(command: Command, tmp_path: Path) -> None:
    told = command("free-oscillation", "--csv", "a.csv")
    assert told.err == "wrote a.csv\n"
    for option in ("--quiet", "-q"):
        quiet = command(option, "free-oscillation", "--csv", "b.csv")
        assert (quiet.code, quiet.out, quiet.err) == (0, told.out, "")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_doubts_and_errors_stay(command: Command) -> None:
    beyond = ("free-oscillation", "--release-angle", "-45", "--duration", "0.1")
    assert "beyond the stops" in command(*beyond).err
    assert command("--quiet", *beyond).err == command(*beyond).err
    refused = command("--quiet", "free-oscillation", "--set", "J=-1")
    assert (refused.code, refused.message[:8]) == (1, "J = -1.0")


def test_notes_go_but_for_documents(command: Command, tmp_path: Path) -> None:
    small = ("free-oscillation", "--release-angle", "-0.35", "--json")
    told = command(*small, "a.json")
    note, wrote = told.err.splitlines()
    assert note.startswith("note: --release-angle -0.35 is in degrees")
    assert wrote == "wrote a.json"
    assert command("--quiet", *small, "b.json").err == ""
    for name in ("a.json", "b.json"):
        assert json.loads((tmp_path / name).read_text(encoding="utf-8"))["notes"] == [note]


def test_a_call_does_not_inherit_from_the_one_before(command: Command) -> None:
    assert command("--quiet", "free-oscillation", "--csv", "a.csv").err == ""
    assert command("free-oscillation", "--csv", "a.csv").err == "wrote a.csv\n"


def test_quiet_and_verbose_exclude_each_other(command: Command) -> None:
    outcome = command("--quiet", "--verbose", "free-oscillation")
    assert outcome.code == 2
    assert "use --quiet or --verbose, not both" in outcome.err


def test_compiling_is_told(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def compile_loop() -> None:
        logging.getLogger("pyjoystick.fmu.stepping.compiled").info("compiling")

    monkeypatch.setattr("pyjoystick.support.remove_abandoned", compile_loop)  # called before any command
    assert command("parameters").err == "compiling\n"
    assert command("--quiet", "parameters").err == ""
    assert "pyjoystick.fmu.stepping.compiled: compiling" in command("--verbose", "parameters").err


def test_nothing_moves(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    for is_quiet in (False, True):
        monkeypatch.setattr(invocation, "quiet", is_quiet)
        with progress_console().status("simulating"):
            print_progress("on the way")
        assert ("on the way" in capsys.readouterr().err) is not is_quiet


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.stem)
def test_no_command_goes_around_the_console(module: Path) -> None:
    """Only `console` writes to standard error; what else prints takes a console from there."""
    if module.stem in ("console", "narrow_tables"):
        return
    text = module.read_text(encoding="utf-8").replace('typer.echo(f"pyjoystick {support', "")
    assert not re.search(r"\bConsole\(|(?<![\w.])print\(|typer\.echo|sys\.std(out|err)|stderr=True", text)
    progress = re.findall(r"(?:Progress|Live)\([^)]*console=(\w+)(\(\))?", text)
    assert all(name == "console" or name + call == "progress_console()" for name, call in progress)
