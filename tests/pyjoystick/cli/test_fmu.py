"""``pyjoystick fmu``."""

from __future__ import annotations

from pathlib import Path

from tests.pyjoystick.cli.conftest import Command


def test_fmus_are_copied_as_they_are(command: Command, fmus_by_name: Path, tmp_path: Path) -> None:
    outcome = command("fmu", "Joystick", "Operator", "-o", "own/fmus")
    assert (outcome.code, outcome.out) == (0, "")
    assert outcome.err == "wrote own/fmus/Joystick.fmu\nwrote own/fmus/Operator.fmu\n"
    copies = sorted((tmp_path / "own" / "fmus").iterdir())
    assert [path.name for path in copies] == ["Joystick.fmu", "Operator.fmu"]
    for path in copies:
        assert path.read_bytes() == (fmus_by_name / path.name).read_bytes()


def test_an_unknown_name_copies_nothing(command: Command, tmp_path: Path) -> None:
    outcome = command("fmu", "Joystick", "joystick.fmu", "-o", "fmus")
    assert outcome.code == 2
    assert "no FMU 'joystick.fmu'; there are Joystick, JoystickPowerLaw" in " ".join(outcome.err.split())
    assert not (tmp_path / "fmus").exists()


def test_a_folder_that_cannot_be_written(command: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    outcome = command("fmu", "Joystick", "-o", "file")
    assert outcome.code == 1
    assert outcome.message.startswith("cannot write file/Joystick.fmu: its folder cannot be created")
