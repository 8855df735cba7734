"""``pyjoystick compare`` with FMUs as arguments."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.support import ParameterError
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.fmu.doctored import doctored

SAME = ("--set", "n=3", "--set", "inverted=0")


@pytest.fixture
def first(pair: Path) -> str:
    return str(pair / "First.fmu")


@pytest.fixture
def second(pair: Path) -> str:
    return str(pair / "Second.fmu")


def _rows(out: str, name: str) -> list[list[str]]:
    """The rows of a variable, one an interface."""
    return [line.split() for line in out.splitlines() if line.split()[:1] == [name]]


def test_two_fmus_that_part(command: Command, first: str, second: str) -> None:
    outcome = command("compare", first, second, *SAME)
    assert (outcome.code, outcome.err) == (1, "")
    lines = [" ".join(line.split()) for line in outcome.out.splitlines()]
    assert lines[0].startswith(f"first {first} Pair.First made by pyjoystick")
    assert lines[1].startswith(f"second {second} Pair.Second made by pyjoystick")
    assert "only in the first: own" in lines
    assert "only in the second: z" in lines
    assert "internal variables of only one FMU: 1 of the first, 2 of the second (--all)" in lines
    assert "k unit 1/s Hz" in lines
    assert "k max none 4.0" in lines
    assert "Model Exchange, CVode at tolerance 1e-10: 0 to 2 s" in lines
    assert "Co-Simulation, tolerance 1e-08: 0 to 2 s" in lines
    assert sum("not judged, because each FMU has its own solver" in line for line in lines) == 1
    exchange, simulation = _rows(outcome.out, "x")
    assert exchange == ["x", "m", "1.35e-03", "1.3e-03", "0.996", "1.0e-04", "0.516", "exceeded"]
    assert simulation == exchange[:-1]
    assert [row[-1] for row in _rows(outcome.out, "integral")] == ["ok", "1.0e-04"]


def test_results_that_are_not_finite_are_told_once(command: Command, first: str) -> None:
    settings = ("--set", "own=1e308", "--set", "x=5", "--variable", "inside", "--json", "a.json")
    outcome = command("compare", first, first, *settings, "--limit", "inside=1", "--cs-limit", "inside=1")
    message = "First.fmu: results are not finite: inside is inf at t = 0 s"
    assert [line for line in outcome.err.splitlines() if "finite" in line] == [message]
    assert message in json.loads(Path("a.json").read_text())["notes"]


def test_limits(command: Command, first: str, second: str) -> None:
    assert command("compare", first, second, *SAME, "--limit", "x=2e-3").code == 0
    assert command("compare", first, second, *SAME, "--relative-limit", "2e-3").code == 0
    judged = command("compare", first, second, *SAME, "--interface", "cs", "--cs-limit", "x=1e-3")
    assert judged.code == 1
    assert "not judged" not in judged.out
    assert "Model Exchange" not in judged.out
    assert _rows(judged.out, "x")[0][-1] == "exceeded"
    assert command("compare", first, second, *SAME, "--interface", "cs", "--cs-limit", "x=2e-3").code == 0


def test_everything_of_joysticks(command: Command) -> None:
    arguments = ("compare", "Joystick", "JoystickPowerLaw", "-a", "-20deg", "-a", "0.1rad", "-d", "0.1")
    outcome = command(*arguments, "--interface", "me")
    assert outcome.code == 1
    assert "CVode at tolerance 1e-10: -20 deg; 5.72958 deg" in outcome.out
    assert _rows(outcome.out, "theta")[0][2] in ("-20", "5.72958")
    assert len(_rows(outcome.out, "theta")) == 1
    everything = command(*arguments, "--interface", "me", "--all").out
    assert [row[2] for row in _rows(everything, "theta")] == ["-20", "5.72958"]
    assert "internal, only in the second: damping.beta" in everything


def test_an_fmu_that_fails(command: Command, first: str, pair: Path) -> None:
    outcome = command("compare", first, str(pair / "Stops.fmu"), "--interface", "cs", "--set", "k=1")
    assert outcome.code == 1
    assert "0 to 2 s: failed: second FMU, Stops.fmu at t = 0.356 s: " in outcome.out
    assert "x is too small" in outcome.out
    assert _rows(outcome.out, "x") == []


def test_inputs_from_a_file(command: Command, first: str, second: str, tmp_path: Path) -> None:
    (tmp_path / "in.csv").write_text("time (s);u (N)\n0;0\n1;2\n1;0.5\n2;0\n")
    outcome = command(
        "compare", first, second, "--inputs", "in.csv", "--variable", "integral", "--json", "a.json"
    )
    assert outcome.code == 0
    assert "0 to 2 s, driven" in outcome.out
    runs = json.loads((tmp_path / "a.json").read_text())["runs"]
    assert [run["differences"][0]["variable"] for run in runs] == ["integral", "integral"]
    # The integral ends at 1.25, so that a ten-thousandth of its largest value is the limit.
    assert runs[0]["differences"][0]["limit"] == pytest.approx(1.25e-4)


def test_json(command: Command, first: str, second: str, tmp_path: Path) -> None:
    outcome = command("compare", first, second, "--json", "out/all.json")
    assert outcome.err == "wrote out/all.json\n"
    content = json.loads((tmp_path / "out" / "all.json").read_text())
    assert [fmu["path"] for fmu in content["fmus"]] == [first, second]
    assert content["within_limits"] is False
    assert "fmpy" in content["made_with"]


def test_json_of_a_comparison_with_the_reference(command: Command, tmp_path: Path) -> None:
    assert command("compare", "-d", "0.1", "--json", "one.json").code == 0
    content = json.loads((tmp_path / "one.json").read_text())
    assert len(content["fmus"]) == len(content["runs"]) == 1
    assert content["within_limits"] is True


def test_the_output_is_checked_before_the_runs(
    command: Command, first: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def runs(*_: object, **__: object) -> None:
        raise AssertionError

    monkeypatch.setattr(Fmu, "run", runs)
    (tmp_path / "file").touch()
    for fmus in ((first, first), ()):
        outcome = command("compare", *fmus, "--json", "file/all.json", "--interface", "cs")
        assert (outcome.code, outcome.out) == (1, "")
        assert outcome.message.startswith("cannot write file/all.json: ")


def test_one_fmu_is_compared_with_the_reference(command: Command, fmus_by_name: Path) -> None:
    path = str(fmus_by_name / "JoystickPowerLaw.fmu")
    arguments = ("-a", "12deg", "-a", "-5deg", "-d", "0.3", "--set", "damping.alpha=0.4")
    outcome = command("compare", path, *arguments)
    assert outcome.code == 0
    assert "free oscillation from 12 deg, -5 deg, 0.3 s, tolerance 1e-08" in outcome.out
    assert outcome.out.splitlines()[2:] == command("compare", "--fmu", path, *arguments).out.splitlines()[2:]
    exchange = command("compare", path, *arguments, "--interface", "me", "--cvode-tolerance", "1e-9")
    assert exchange.code == 0
    assert "JoystickPowerLaw.fmu against the reference" in exchange.out
    assert "CVode at tolerance 1e-09" in exchange.out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("a.fmu", "b.fmu", "c.fmu"), "at most two FMUs can be compared, not 3"),
        (("a.fmu", "--fmu", "b.fmu"), "give the FMU as an argument or by --fmu, not both"),
        (("a.fmu", "b.fmu", "--damping", "constant"), "given FMUs have their own damping laws"),
        (("a.fmu", "--damping", "constant"), "an FMU has its own damping law"),
        (("--cs-limit", "theta=1"), "is for two FMUs"),
        (("--relative-limit", "1"), "is for two FMUs"),
        (("--inputs", "in.csv"), "is for two FMUs"),
        (("a.fmu", "--variable", "x"), "is for two FMUs"),
        (("a.fmu", "b.fmu", "--cs-limit", "x"), "'x' must be NAME=NUMBER"),
        (("a.fmu", "b.fmu", "--interface", "both"), "'both' is not one of 'me', 'cs'"),
    ],
)
def test_wrong_usage(command: Command, arguments: tuple[str, ...], message: str) -> None:
    outcome = command("compare", *arguments)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in " ".join(outcome.err.replace("│", " ").split())


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--set", "own=2"), "there is no parameter 'own'"),
        (("--limit", "v=2"), "there is no variable 'v'"),
        (("--variable", "z"), "there is no variable 'z'"),
        (("--relative-limit", "0"), "relative_limit = 0.0: must be a finite number above 0"),
        (("-a", "3deg"), "release_angle = 0.0523599 rad: must be left out for FMUs that are not joysticks"),
        (("-d", "-1"), "duration = -1.0: must be a finite number above 0 s"),
        (("--inputs", "nowhere.csv"), "nowhere.csv: cannot be read"),
        (("--inputs", "text.csv"), "text.csv, column 'u', row 3: is not a number"),
        (("--inputs", "other.csv"), "there is no input 'v'; "),
    ],
)
def test_wrong_input_is_one_message(
    command: Command, first: str, second: str, tmp_path: Path, arguments: tuple[str, ...], message: str
) -> None:
    (tmp_path / "text.csv").write_text("time,u\n0,1\n1,high\n")
    (tmp_path / "other.csv").write_text("time,v\n0,1\n1,2\n")
    outcome = command("compare", first, second, *arguments)
    assert (outcome.code, outcome.out) == (1, "")
    assert message in outcome.message


def _in_mm(fmu: str, folder: Path) -> str:
    """First.fmu with a parameter and an output that only have the names of a joystick's."""

    def renamed(text: str) -> str:
        for name, other, unit in (("k", "a", "1/s"), ("x", "h", "m")):
            text, changed = re.subn(
                f'name="{name}"(.*?) unit="{unit}"',
                rf'name="{other}"\1 unit="mm"',
                text,
                count=1,
                flags=re.DOTALL,
            )
            assert changed
        return text

    return str(doctored(Path(fmu), folder / "mm.fmu", description=renamed))


def test_units_are_those_that_the_fmu_declares(command: Command, first: str, tmp_path: Path) -> None:
    arguments = ("compare", *2 * [_in_mm(first, tmp_path)], "--interface", "me", "--variable", "h")
    assert command(*arguments, "--set", "a=0.5kg").message.startswith(
        "a = 0.5kg: must be a number, or one with"
    )
    assert command(*arguments, "--limit", "h=2mm", "--json", "a.json").code == 0
    (run,) = json.loads((tmp_path / "a.json").read_text())["runs"]
    assert run["differences"][0]["limit"] == 2.0


def test_a_value_is_set_in_the_unit_that_the_fmu_declares(
    command: Command, first: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = []

    def experiments(*_: object, settings: object, **__: object) -> None:
        given.append(settings)
        raise ParameterError("a", 0.0, "seen")

    monkeypatch.setattr("pyjoystick.runs.experiments_for", experiments)
    for text in ("a=0.5mm", "a=0.05cm", "a=0.5"):
        command("compare", *2 * [_in_mm(first, tmp_path)], "--set", text)
    assert given == 3 * [{"a": 0.5}]


def test_a_joystick_in_other_units_is_not_run_as_one(
    command: Command, fmus_by_name: Path, tmp_path: Path
) -> None:
    def in_mm(text: str) -> str:
        # One of another maker, whose binary has the same units.
        text = text.replace('generationTool="pyjoystick', 'generationTool="another')
        return text.replace(
            'start="0.02398" quantity="Length" min="1e-60" unit="m"', 'start="23.98" unit="mm"'
        )

    path = str(doctored(fmus_by_name / "Joystick.fmu", tmp_path / "mm.fmu", description=in_mm))
    told = "mm.fmu: declares a in mm; that of a joystick is in m"
    command("parameters", "-o", "joystick.toml")
    for arguments in (
        ("compare", path),
        ("free-oscillation", "--fmu", path),
        ("compare", path, path, "--parameters", "joystick.toml"),
    ):
        assert told in command(*arguments).message
    assert command("compare", path, path, "--set", "a=24mm", "-d", "0.01", "--interface", "me").code == 0


def test_an_fmu_that_is_missing(command: Command, first: str) -> None:
    assert command("compare", first, "nowhere.fmu").message.startswith("there is no FMU nowhere.fmu")
