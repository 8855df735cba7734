"""``pyjoystick design``."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from pyjoystick.cli import main

FEW = ["design", "-n", "2", "--angle", "-20deg", "--angle", "3deg", "--duration", "0.5"]


def _errors(design: dict[str, Any]) -> dict[str, float]:
    """Standard errors by name."""
    return {one["name"]: one["standard_error"] for one in design["parameters"]}


@pytest.mark.usefixtures("fmus_by_name")
def test_the_choice_is_printed_and_saved(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, figure = tmp_path / "design.json", tmp_path / "design.svg"
    assert main([*FEW, "--free", "J", "--json", str(out), "--plot", str(figure)]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("2 x release from -20 degrees\n")
    best, twice, faster, longer = json.loads(out.read_text())["designs"]
    assert best["experiments"] == [{"name": "release from -20 degrees", "count": 2}]
    for name in ("J", "damping.C"):
        error = _errors(best)[name]
        assert _errors(twice)[name] == pytest.approx(error / 2.0**0.5)
        assert _errors(faster)[name] == pytest.approx(error / 2.0**0.5, rel=0.05)
        assert _errors(longer)[name] < error
    assert figure.stat().st_size > 1000


@pytest.mark.usefixtures("fmus_by_name")
def test_an_uncertainty_of_the_file_is_knowledge(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, out = tmp_path / "joystick.toml", tmp_path / "design.json"
    assert main(["parameters", "-o", str(file)]) == 0
    text = file.read_text().replace("J = 0.01135", "J = 0.01135\nu_J = 1e-8")
    file.write_text(text)
    assert main([*FEW, "--free", "J", "-p", str(file), "--json", str(out)]) == 0
    assert "taken as known" in capsys.readouterr().err
    assert _errors(json.loads(out.read_text())["designs"][0])["J"] <= 1e-8


@pytest.mark.usefixtures("fmus_by_name")
def test_friction_wants_releases_of_all_sizes(tmp_path: Path) -> None:
    """Where T_c is asked for, small releases join the large ones and halve its standard error."""
    out = tmp_path / "design.json"
    friction = ["--set", "friction.T_c=0.02", "--free", "friction.T_c", "--determine", "friction.T_c"]
    angles = [word for angle in (-20, -10, -5, -3) for word in ("--angle", f"{angle}deg")]
    assert main(["design", *friction, *angles, "--json", str(out)]) == 0
    best, *_, alone = json.loads(out.read_text())["designs"]
    assert alone["experiments"] == [{"name": "release from -20 degrees", "count": 4}]
    errors = [_errors(one)["friction.T_c"] for one in (best, alone)]
    assert errors[0] < 0.6 * errors[1]


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--determine", "m"], "determine"),
        (["--angle", "0deg"], "not zero"),
        (["--free", "nonsense"], "nonsense"),
        (["--noise", "0"], "noise of theta"),
        (["--rate", "0"], "--rate = 0.0: must be a finite number above 0 Hz"),
        (["--torque", "nowhere.csv", "--rate", "0"], "--rate = 0.0: must be"),
        (["--duration", "0"], "--duration = 0.0: must be"),
        (["--torque", "nowhere.csv", "--angle", "3deg"], "for releases"),
        (["--torque", "nowhere.csv"], "nowhere.csv"),
        (["--settings", "driven.toml"], "offer torques"),
    ],
)
def test_what_cannot_be_is_refused(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("driven.toml").write_text('fmu.path = "Joystick"\nfree.J = {}\ncompare.inputs = ["T"]\n')
    assert main(["design", *arguments]) != 0
    assert words in capsys.readouterr().err


@pytest.mark.usefixtures("fmus_by_name")
def test_a_driven_fit_is_planned_with_its_delay(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """And the error of what is 0 has a unit instead of a percentage."""
    lines = ["time (s),T (N.m)"]
    lines += [f"{k / 100},{2.0 * math.sin(2.0 * math.pi * 2.0 * k / 100)}" for k in range(101)]
    torque = tmp_path / "sine.csv"
    torque.write_text("\n".join(lines) + "\n")
    out = tmp_path / "design.json"
    arguments = ["--torque", str(torque), "--rate", "200", "--json", str(out)]
    assert main(["design", *arguments, "--free", "J"]) == 0
    printed = capsys.readouterr().out
    best, *_ = json.loads(out.read_text())["designs"]
    assert set(_errors(best)) == {"damping.C", "J", "delay"}
    assert "delay (s)" in printed
    assert f"{_errors(best)['delay']:.2g}" in printed
    assert main(["design", *arguments]) == 0
    alone = _errors(json.loads(out.read_text())["designs"][0])
    assert set(alone) == {"damping.C", "delay"}
    assert alone["damping.C"] < _errors(best)["damping.C"]


@pytest.mark.usefixtures("fmus_by_name")
def test_a_torque_begins_where_its_file_does(tmp_path: Path) -> None:
    """Whatever the clock says then: before the first row there is no torque."""
    found = []
    for begin in (0.0, 2.0):
        file, out = tmp_path / "sine.csv", tmp_path / "design.json"
        rows = [f"{begin + k / 100},{2.0 * math.cos(4.0 * math.pi * k / 100)}" for k in range(51)]
        file.write_text("\n".join(["time (s),T (N.m)", *rows, ""]))
        assert main(["design", "--torque", str(file), "--json", str(out)]) == 0
        found.append(_errors(json.loads(out.read_text())["designs"][0]))
    assert found[1] == pytest.approx(found[0], rel=1e-6)


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("0,0\n0.2,1\n0.1,0.5\n0.3,0", "column 'time (s)', row 4: the time runs backward"),
        ("0,0\n1e6,1", "column 'time': lasts 1e+06 s; at 60 Hz, a torque lasts up to"),
        ("0,0", "column 'time': lasts 0 s"),
        ("0,0\n0.5,15000\n1,0", "column 'T': reaches 1.5e+04 N.m; a joystick takes up to 200 N.m"),
    ],
)
def test_a_torque_that_cannot_be_is_refused(
    rows: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "t.csv").write_text(f"time (s),T (N.m)\n{rows}\n")
    assert main(["design", "--torque", str(tmp_path / "t.csv")]) == 1
    assert message in " ".join(capsys.readouterr().err.split())


@pytest.mark.usefixtures("fmus_by_name")
def test_an_uncertainty_of_the_settings_is_knowledge_too(tmp_path: Path) -> None:
    settings, out = tmp_path / "fit.toml", tmp_path / "design.json"
    settings.write_text(
        '[fmu]\npath = "Joystick"\n[free]\nJ = { start = 0.01135, uncertainty = 1e-8 }\n'
        '"damping.C" = {}\ntheta_start = { per_record = true }\n'
    )
    assert main([*FEW, "--settings", str(settings), "--json", str(out)]) == 0
    error = _errors(json.loads(out.read_text())["designs"][0])["J"]
    assert error == pytest.approx(1e-8, rel=1e-3)


@pytest.mark.usefixtures("fmus_by_name")
def test_more_samples_than_anyone_records_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["design", "--rate", "1e6", "--duration", "100"]) == 1
    told = "--rate = 1000000.0: must be at most 1000000 samples, 10000 Hz for 100 s"
    assert told in capsys.readouterr().err


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize(("rate", "is_noted"), [("60", True), ("1000", False)])
def test_a_torque_between_the_samples_is_noted(
    rate: str, is_noted: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    taps = [f"{k / 1000},{4.0 * (k % 200 in range(101, 131))}" for k in range(601)]
    file = tmp_path / "taps.csv"
    file.write_text("\n".join(["time (s),T (Nm)", *taps, ""]))
    assert main(["design", "--torque", str(file), "--rate", rate]) == 0
    assert ("choose a --rate that resolves it" in capsys.readouterr().err) is is_noted
