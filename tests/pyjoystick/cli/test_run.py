"""``pyjoystick new`` and ``pyjoystick run``; tests/test_your_joystick.py covers the whole path."""

from __future__ import annotations

from pathlib import Path

import pytest
from filelock import FileLock

from pyjoystick import reports
from pyjoystick.reports import ProjectRun, StepState
from tests.pyjoystick.cli.conftest import Command

PARTS = "part,mass (g),height (mm),inertia (g.cm2)\nshaft,360,70,12000\ngrip,350,150,6000\n"
#: Parts, and no FMUs.
SMALL = '[parts]\nfile = "parts.csv"\n[fmus]\nfmi = []\n'


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project that takes no time: without the report."""
    (tmp_path / "laboratory.toml").write_text(SMALL, encoding="utf-8")
    (tmp_path / "parts.csv").write_text(PARTS, encoding="utf-8")
    monkeypatch.setattr(reports, "joystick_report", lambda *_, **__: "<html></html>")
    return tmp_path


def test_a_new_project(command: Command, tmp_path: Path) -> None:
    assert command("new", "stick").code == 0
    files = {path.relative_to(tmp_path / "stick").as_posix() for path in (tmp_path / "stick").rglob("*")}
    shown = {file for file in files if not file.startswith(".pyjoystick")}
    assert shown == {"laboratory.toml", "README.md", "data", "data/markers", "data/records"}
    assert command("check", "stick/laboratory.toml").out.endswith("project, nothing wrong\n")


def test_a_new_project_replaces_nothing(command: Command, tmp_path: Path) -> None:
    (tmp_path / "stick" / "data").mkdir(parents=True)
    (tmp_path / "stick" / "README.md").write_text("mine", encoding="utf-8")
    assert command("new", "stick").code == 0
    assert (tmp_path / "stick" / "README.md").read_text(encoding="utf-8") == "mine"
    for arguments in (["new", "stick"], ["new", "stick", "--example"]):
        outcome = command(*arguments)
        assert outcome.code == 1
        assert outcome.message == "stick/laboratory.toml exists; a new project does not overwrite files"


def test_a_folder_that_is_no_project(command: Command) -> None:
    for arguments in (["run", "nowhere"], ["run", "nowhere", "--plan"]):
        outcome = command(*arguments)
        assert outcome.code == 1
        assert "nowhere has no laboratory.toml; `pyjoystick new nowhere` writes one" in outcome.message


def test_a_file_in_the_way_of_a_folder(command: Command, tmp_path: Path) -> None:
    Path("stick").mkdir()
    Path("stick/data").touch()
    outcome = command("new", "stick")
    assert outcome.code == 1
    assert "the folder cannot be created" in outcome.message


def test_a_named_file_that_is_not_there(command: Command, small: Path) -> None:
    """The rest is done, with the paper's values, but a script hears of it."""
    (small / "parts.csv").rename(small / "other.csv")
    outcome = command("run")
    assert outcome.code == 1
    assert "parts.csv does not exist, though laboratory.toml names it" in " ".join(outcome.out.split())


def test_nothing_can_be_done_yet(command: Command) -> None:
    command("new", "stick")
    outcome = command("run", "stick")
    assert outcome.code == 1
    assert "parts                not done" in outcome.out
    assert "nothing can be done yet" in outcome.err


@pytest.mark.usefixtures("small")
def test_plan_run_and_run_again(command: Command) -> None:
    assert "parts                    do       it has not been done yet" in command("run", "--plan").out
    outcome = command("run")
    assert outcome.code == 0
    assert "m = 0.71 kg" in outcome.out
    assert "parts: done" in outcome.err
    assert "note: the damping is taken from the paper's joystick" in outcome.err
    assert " nothing " in command("run", "--plan").out
    again = command("run")
    assert (again.code, again.out.count("unchanged")) == (0, 4)
    assert ": done" not in again.err


def test_what_failed_is_named_and_the_exit_code_says_so(command: Command, small: Path) -> None:
    (small / "parts.csv").write_text(PARTS.replace("350", "x"), encoding="utf-8")
    outcome = command("run")
    assert outcome.code == 1
    assert "error: parts: parts.csv, column 'mass (g)', row 3: " in outcome.err
    assert "needs parts" in outcome.out


@pytest.mark.usefixtures("small")
def test_ctrl_c(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(*_: object, **__: object) -> ProjectRun:
        return ProjectRun((StepState("fit", "not done", "stopped"),), (), interrupted=True)

    monkeypatch.setattr(reports, "run_project", stopped)
    outcome = command("run")
    assert outcome.code == 130
    assert "stopped; the next `pyjoystick run` continues from here" in outcome.err


@pytest.mark.usefixtures("small")
def test_two_runs_at_once(command: Command) -> None:
    Path(".pyjoystick").mkdir()
    with FileLock(".pyjoystick/lock"):
        outcome = command("run")
    assert outcome.code == 1
    assert outcome.message == ". is being run by another process; wait until it has ended"
