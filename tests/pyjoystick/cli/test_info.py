"""``pyjoystick info``."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.fmu.doctored import doctored


def _line(out: str, name: str) -> str:
    return next(" ".join(line.split()) for line in out.splitlines() if line.split()[:1] == [name])


def test_what_an_fmu_is(command: Command) -> None:
    outcome = command("info", "Joystick")
    assert (outcome.code, outcome.err) == (0, "")
    assert _line(outcome.out, "model") == "model PreloadedSprings.Joystick.Joystick"
    assert _line(outcome.out, "FMI") == "FMI 2.0, CoSimulation and ModelExchange"
    assert _line(outcome.out, "runs") == "runs in this process; an instance is reset between runs"
    assert "tolerance 1e-08" in _line(outcome.out, "experiment")
    assert _line(outcome.out, "theta_start").startswith("theta_start rad 0.0")
    assert _line(outcome.out, "m").startswith("m kg 0.87 > 0 Mass of the handle")
    assert _line(outcome.out, "h").startswith("h m 0.082 >= 0 Distance")
    assert _line(outcome.out, "T").startswith("T N.m 0.0")
    for title in ("Inputs", "Outputs", "Parameters"):
        assert title in outcome.out
    assert "forward.returnSpring.isEngaged" not in outcome.out
    assert "local variables (--all shows them)" in outcome.out


def test_names_are_whole_in_a_narrow_terminal(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    out = command("info", "JoystickPowerLaw").out
    assert "backward.balanceSpring.k_h" in out
    assert max(map(len, out.splitlines()[7:])) <= 80


def test_local_variables_too(command: Command) -> None:
    out = command("info", "Joystick", "--all").out
    assert "Boolean" in _line(out, "forward.returnSpring.isEngaged")
    assert "--all shows them" not in out


def test_a_start_value_of_several_lines_stays_in_its_row(
    command: Command, echo3_path: Path, tmp_path: Path
) -> None:
    several = '<Start value="a&#10;b&#9;c"/>'
    doctored(
        echo3_path,
        tmp_path / "echo.fmu",
        description=lambda text: text.replace('<Start value="a"/>', several),
    )
    assert _line(command("info", "echo.fmu").out, "text").split()[2] == r"a\nb\tc"


def test_a_path_and_square_brackets(command: Command, fmus_by_name: Path, tmp_path: Path) -> None:
    path = tmp_path / "[bold]own[bold].fmu"
    path.write_bytes((fmus_by_name / "JoystickInverse.fmu").read_bytes())
    outcome = command("info", path.name)
    assert outcome.code == 0
    assert _line(outcome.out, "file") == f"file {path.name}"
    assert "T_stiffness" in outcome.out


@pytest.mark.parametrize(
    ("replacement", "way"),
    [
        ("false", "in a separate process, as another tool made it; each on a new instance"),
        ("true", "each in a new process, as the FMU allows one instance per process"),
    ],
)
def test_where_an_fmu_of_another_tool_runs(
    command: Command, fmus_by_name: Path, tmp_path: Path, replacement: str, way: str
) -> None:
    once = "canBeInstantiatedOnlyOncePerProcess="
    doctored(
        fmus_by_name / "Joystick.fmu",
        tmp_path / "other.fmu",
        description=lambda text: text.replace('"pyjoystick', '"other').replace(
            f'{once}"false"', f'{once}"{replacement}"'
        ),
    )
    assert _line(command("info", "other.fmu").out, "runs") == f"runs {way}"


def test_files_that_are_no_fmu(command: Command, tmp_path: Path) -> None:
    assert command("info", "nowhere.fmu").message.startswith("there is no FMU nowhere.fmu")
    (tmp_path / "text.fmu").write_text("text")
    assert command("info", "text.fmu").message == "text.fmu: not an FMU: not a ZIP archive"
    with zipfile.ZipFile(tmp_path / "zip.fmu", "w") as archive:
        archive.writestr("a", "b")
    assert command("info", "zip.fmu").message == "zip.fmu: not an FMU: there is no modelDescription.xml in it"
    assert command("info", "zip.fmu").code == 1
