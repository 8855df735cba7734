"""The documents of ``--json``: one schema for all commands, files and standard output."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft7Validator
from typer.main import get_command

from pyjoystick.cli import LazyCommand, app, main
from pyjoystick.model import NOMINAL
from pyjoystick.reports import new_project, schemas
from tests.pyjoystick.cli.conftest import Command

RECORDS = [
    str(path)
    for path in sorted((Path(__file__).parents[3] / "scenarios" / "data").glob("synthetic_constant_?.csv"))
]
SCHEMA = schemas()["document.schema.json"]
#: A short run of every command with a document, in the laboratory of the fixture; some in two forms.
CASES = [
    ("info", "info Joystick"),
    ("parameters", "parameters --set m=0.9 --damping power-law"),
    ("parameters", "parameters --fmu-names"),
    ("import record", "import record RECORD --preview log.png"),
    ("import markers", "import markers DATA/synthetic_trial_2.csv --top TOP --base BASE1 BASE2 -o t2.csv"),
    (
        "import accelerometer",
        "import accelerometer DATA/synthetic_acceleration_1.csv --angle LAB/trial_1.csv --distance 0.25",
    ),
    ("import load-curve", "import load-curve DATA/synthetic_forward.csv"),
    ("import swing", "import swing DATA/synthetic_swing.csv"),
    ("import swing", "import swing --time 8.09 --time 8.14 --time 8.05 --swings 10 --amplitude 10"),
    ("import parts", "import parts DATA/synthetic_parts.csv"),
    ("peaks", "peaks RECORD"),
    ("fit", "fit RECORD"),
    ("fit", "fit RECORD --settings LAB/fit.toml"),
    ("fit", "fit DRIVEN --driven"),
    ("design", "design --angle 5deg --angle 20deg --records 1 --check 2"),
    ("budget", "budget RECORD -p LAB/joystick.toml --uncertainty m=0.001"),
    ("free-oscillation", "free-oscillation"),
    ("free-oscillation", "free-oscillation --release-angle -45 --trusted"),
    ("torque", "torque"),
    ("torque", "torque RECORD --damping constant"),
    ("response", "response --torque 0.6 --frequency 4"),  # chaotic
    ("response", "response --torque 0.6 --frequency 4 --set stops.theta_stop=20deg"),
    ("response", "response --torque 12 --frequency 6 --vary torque 11.99 12"),
    ("vibration", "vibration --angle 0 --hand-mass 0.3 --acceleration 1"),
    ("compare", "compare -d 0.1"),
    ("compare", "compare Joystick Joystick -d 0.1"),
]


#: A fit with what others do not have: ties, those of a record among them, and a bootstrap.
SETTINGS = """
fmu.path = "Joystick"
ties = { omega_start = "0.001 * theta_start", J = "0.0130 * m" }
uncertainty = { bootstrap = 2, resampling = "residuals" }
[free]
"damping.C" = { start = 0.05, minimum = 0.0, maximum = 0.5 }
theta_start = { per_record = true }
release_time = { per_record = true }
m = { start = 0.87 }
"""


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a synthetic laboratory, with the record of its first trial."""
    folder = tmp_path_factory.mktemp("documents") / "lab"
    new_project(folder, example=True)
    source, record = folder / "data" / "synthetic_trial_1.csv", folder / "trial_1.csv"
    markers = ["--top", "TOP", "--base", "BASE1", "BASE2", "-o", str(record)]
    assert main(["import", "markers", str(source), *markers]) == 0
    assert main(["parameters", "-o", str(folder / "joystick.toml")]) == 0
    (folder / "fit.toml").write_text(SETTINGS, encoding="utf-8")
    return folder


def _read(text: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    return found


def test_the_schema_is_one() -> None:
    Draft7Validator.check_schema(SCHEMA)
    commands = SCHEMA["properties"]["command"]["enum"]
    assert list(dict.fromkeys(command for command, _ in CASES)) == commands


@pytest.mark.parametrize(("name", "line"), CASES, ids=[line for _, line in CASES])
def test_documents_satisfy_the_schema(
    command: Command, lab: Path, tmp_path: Path, name: str, line: str
) -> None:
    """And say everything that was printed on standard error but for what was written."""
    line = line.replace("RECORD", RECORDS[0]).replace("DATA", str(lab / "data")).replace("LAB", str(lab))
    line = line.replace("DRIVEN", RECORDS[0].replace("constant_1", "driven_1"))
    outcome = command(*line.split(), "--json", "document.json")
    assert outcome.code in (0, 3), outcome.err
    found = _read((tmp_path / "document.json").read_text(encoding="utf-8"))
    problems = [
        f"{'/'.join(map(str, one.absolute_path))}: {one.message[:300]}"
        for one in Draft7Validator(SCHEMA).iter_errors(found)
    ]
    assert problems == []
    assert found["command"] == name
    assert found["made_with"]["pyjoystick"]
    told = [one for one in outcome.err.splitlines() if not one.startswith(("wrote ", "error: do not trust"))]
    assert found["notes"] == told


def test_every_command_with_the_option_is_in_the_schema() -> None:
    """`export` has a flag of that name: it writes the document of `parameters` into its folder."""

    def loaded(group: Any, before: str = "") -> dict[str, Any]:
        found = {}
        for name, one in group.commands.items():
            if hasattr(one, "commands"):
                found |= loaded(one, f"{name} ")
            else:
                found[before + name] = one.load() if isinstance(one, LazyCommand) else one
        return found

    commands = {
        name: [one for one in command.params if "--json" in one.opts]
        for name, command in loaded(get_command(app)).items()
    }
    with_file = {name for name, options in commands.items() for one in options if not one.is_flag}
    assert with_file == set(SCHEMA["properties"]["command"]["enum"])
    assert {name for name, options in commands.items() for one in options if one.is_flag} == {"export"}


def test_strays_are_refused(command: Command, tmp_path: Path) -> None:
    """The schema sees a key too many, one that is missing, a text for a number, and an unknown command."""
    assert command("free-oscillation", "--json", "a.json").code == 0
    right = _read((tmp_path / "a.json").read_text(encoding="utf-8"))
    for wrong in (
        right | {"more": 1},
        {key: value for key, value in right.items() if key != "made_with"},
        right | {"duration": "1.5"},
        right | {"command": "oscillation"},
        right | {"peaks": [{"time": 1.0, "theta": 0.1}]},
    ):
        assert not Draft7Validator(SCHEMA).is_valid(wrong)
    assert Draft7Validator(SCHEMA).is_valid(right)


def test_numbers_are_those_of_the_table(command: Command, tmp_path: Path) -> None:
    outcome = command("free-oscillation", "--set", "m=0.9", "--json", "a.json")
    found = _read((tmp_path / "a.json").read_text(encoding="utf-8"))
    first, second = found["peaks"][:2]
    rows = [line.split() for line in outcome.out.splitlines()[2:4]]
    assert [f"{first['time']:.5f}", f"{second['half_period']:.5f}"] == [rows[0][1], rows[1][3]]
    assert second["half_period"] == pytest.approx(second["time"] - first["time"], rel=1e-12)
    assert first["half_period"] is None
    assert {one["name"]: one["value"] for one in found["parameters"]} == NOMINAL.replace(
        {"m": 0.9}
    ).to_names()


def _named(rows: list[dict[str, Any]], name: str) -> dict[str, Any]:
    (found,) = (one for one in rows if one["name"] == name)
    return found


def _parameter(document: dict[str, Any], name: str) -> dict[str, Any]:
    return _named(document["parameters"], name)


#: Cells of a printed table, with what they must be by the document: in SI units, where the table has others.
CELLS: list[tuple[str, str, Callable[[dict[str, Any]], str]]] = [
    ("import parts DATA/synthetic_parts.csv", "h (m)", lambda d: f"{_parameter(d, 'h')['value']:.6g}"),
    ("import swing DATA/synthetic_swing.csv", "T (s)", lambda d: f"{d['period']['value']:.6g}"),
    (
        "import swing DATA/synthetic_swing.csv",
        "T_c (N m)",
        lambda d: f"{_parameter(d, 'friction.T_c')['standard_uncertainty']:.2g}",
    ),
    (
        "import load-curve DATA/synthetic_forward.csv --side forward -p a.toml",
        "returnSpring.x_0",
        lambda d: f"{1e3 * d['springs'][3]['value']:.5f}",
    ),
    (
        "import load-curve DATA/synthetic_forward.csv",
        "friction",
        lambda d: f"{d['friction']['standard_error']:.4f}",
    ),
    (
        "import markers DATA/synthetic_trial_2.csv --top TOP --base BASE1 BASE2 -o t2.csv",
        "noise of the angle (deg)",
        lambda d: f"{math.degrees(d['noise']):.3f}",
    ),
    (
        "import markers DATA/synthetic_trial_2.csv --top TOP --base BASE1 BASE2 -o t2.csv",
        "angle (deg)",
        lambda d: f"{math.degrees(d['theta_min']):+.2f} to {math.degrees(d['theta_max']):+.2f}",
    ),
    (
        "import accelerometer DATA/synthetic_acceleration_1.csv --angle LAB/trial_1.csv --distance 0.25",
        "difference, less gravity",
        lambda d: f"{100 * d['alpha'][0]['rms_difference'] / d['differentiated']['rms']:.1f} % rms",
    ),
    (
        "import record RECORD --preview log.png",
        "Angle (deg)",
        lambda d: " to ".join(f"{math.degrees(d['columns'][1][key]):+.6g}" for key in ("minimum", "maximum")),
    ),
    ("vibration", "50", lambda d: f"{math.degrees(d['responses'][-1]['gain']):.3g}"),
    (
        "torque --damping constant",
        "inertia",
        lambda d: f"{_named(d['laws'][0]['parts'], 'inertia')['rms']:.3f}",
    ),
    ("peaks RECORD", "C, velocity", lambda d: f"{_named(d['constants'], 'velocity')['corrected']:.4f}"),
    ("parameters --fmu-names", "J", lambda d: f"{_parameter(d, 'J')['value']:.9g}"),
    ("info Joystick", "theta_start", lambda d: f"{_named(d['variables'], 'theta_start')['unit']}"),
]


@pytest.mark.parametrize(("line", "row", "expected"), CELLS, ids=[f"{a.split()[0]}-{b}" for a, b, _ in CELLS])
def test_documents_say_what_the_tables_say(
    command: Command,
    lab: Path,
    tmp_path: Path,
    line: str,
    row: str,
    expected: Callable[[dict[str, Any]], str],
) -> None:
    line = line.replace("RECORD", RECORDS[0]).replace("DATA", str(lab / "data")).replace("LAB", str(lab))
    outcome = command(*line.split(), "--json", "document.json")
    assert outcome.code == 0, outcome.err
    found = _read((tmp_path / "document.json").read_text(encoding="utf-8"))
    cells = [re.split(r" *\| *|  +", one.strip("| ")) for one in outcome.out.splitlines()]
    (printed,) = [one for one in cells if one[0] == row][:1]
    assert expected(found) in printed


def test_standard_output_can_take_the_document_alone(command: Command, tmp_path: Path) -> None:
    piped = command("free-oscillation", "--json", "-", "--csv", "a.csv")
    assert _read(piped.out)["command"] == "free-oscillation"
    assert "free oscillation from -20 deg" in piped.err
    assert "wrote a.csv" in piped.err
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]
    quiet = command("--quiet", "free-oscillation", "--json", "-")
    assert (quiet.out, quiet.err) == (piped.out, "")
    plain = command("free-oscillation")
    assert plain.out.startswith("Joystick.fmu: free oscillation")


def test_an_error_leaves_no_document(command: Command, tmp_path: Path) -> None:
    outcome = command("free-oscillation", "--json", "-", "--set", "J=-1")
    assert (outcome.code, outcome.out) == (1, "")
    assert list(tmp_path.iterdir()) == []
