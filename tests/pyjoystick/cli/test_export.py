from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.cli.fmus import opened
from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, read_parameters, simulate, write_parameters

from .conftest import Command


@pytest.fixture
def stick(command: Command, tmp_path: Path) -> Path:
    assert command("parameters", "--set", "a=0.025", "--set", "damping.C=0.06", "-o", "stick.toml").code == 0
    return tmp_path / "stick.toml"


def test_formats_that_need_no_compiler(
    command: Command, stick: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pyjoystick.reports.export.fmus.find_spec", lambda name: None)
    done = command("export", "-p", "stick.toml", "-o", "out", "--no-fmu", "--modelica", "--json")
    assert done.code == 0, done.err
    assert sorted(path.name for path in Path("out").iterdir()) == ["Stick.json", "Stick.mo"]
    values = json.loads(Path("out/Stick.json").read_text("utf-8"))["parameters"]
    assert {one["name"]: one["value"] for one in values}["a"] == 0.025
    assert "a = 0.025" in Path("out/Stick.mo").read_text("utf-8")
    assert "pip install" in command("export", "-p", "stick.toml", "-o", "out").message


def test_an_exported_fmu_is_its_own_joystick_in_commands(command: Command, stick: Path) -> None:
    done = command("export", "-p", "stick.toml", "-o", "out", "--name", "Left")
    assert done.code == 0, done.err
    assert sorted(path.name for path in Path("out").iterdir()) == ["Left.fmu", "LeftInverse.fmu"]
    with opened(None, "out/Left.fmu", None) as (_, joystick):
        assert joystick == read_parameters(stick)
    with opened(None, "out/Left.fmu", ["damping.C=0.05"]) as (_, joystick):
        assert joystick.to_names() == read_parameters(stick).to_names() | {"damping.C": 0.05}
    assert command("free-oscillation", "--fmu", "out/Left.fmu", "--csv", "own.csv").code == 0
    assert command("free-oscillation", "-p", "stick.toml", "--csv", "set.csv").code == 0
    own, given = (pd.read_csv(name, comment="#") for name in ("own.csv", "set.csv"))
    np.testing.assert_allclose(own, given, rtol=0.0, atol=1e-9)
    with Fmu("out/Left.fmu") as fmu:
        end = fmu.run([0.0, 0.5], parameters={"theta_start": -0.3})["theta"].iloc[-1]
    assert end == pytest.approx(
        simulate(read_parameters(stick), time=[0.0, 0.5], theta_start=-0.3).theta[-1], abs=1e-7
    )
    assert end != pytest.approx(simulate(NOMINAL, time=[0.0, 0.5], theta_start=-0.3).theta[-1], abs=1e-3)


def test_stops_of_an_exported_fmu(command: Command, stick: Path) -> None:
    """Commands take them as the FMU's own, and a joystick without stops switches them off."""
    write_parameters(stick, read_parameters(stick).replace({"stops.theta_stop": 0.3}))
    assert command("export", "-p", "stick.toml", "-o", "out", "--name", "Left").code == 0
    with opened(None, "out/Left.fmu", None) as (_, joystick):
        assert joystick == read_parameters(stick)
    assert command("torque", "-p", "stick.toml", "--angle", "15deg").code == 0
    assert "within the stops" in command("torque", "-p", "stick.toml", "--angle", "20deg").message
    release = ("--release-angle", "-20deg", "--csv")
    assert command("free-oscillation", "--fmu", "out/Left.fmu", *release, "own.csv").code == 0
    off = ("--set", "stops.theta_stop=0")
    assert command("free-oscillation", "--fmu", "out/Left.fmu", *off, *release, "off.csv").code == 0
    assert command("free-oscillation", "-p", "stick.toml", *off, *release, "free.csv").code == 0
    own, without, free = (
        pd.read_csv(f"{name}.csv", comment="#").iloc[:, 1] for name in ("own", "off", "free")
    )
    np.testing.assert_allclose(without, free, rtol=0.0, atol=1e-5)
    assert np.abs(own - free).max() > 0.01
    assert command("compare", "out/Left.fmu", *off).code == 0


def test_an_fmu_that_is_no_joystick(command: Command) -> None:
    assert (
        "does not have the parameters of Joystick" in command("free-oscillation", "--fmu", "Operator").message
    )


def test_fmu_names(command: Command, stick: Path) -> None:
    lines = command("parameters", "-p", "stick.toml", "--fmu-names").out.splitlines()
    (row,) = [line for line in lines if "backward.balanceSpring.k_h" in line]
    assert [cell.strip() for cell in row.strip("|").split("|")][1] == "backward: k[2] - k[3]"
    assert "--set" in command("parameters", "--fmu-names", "--set", "a=0.025").err


def test_nothing_is_written_for_a_wrong_name_or_for_nothing(command: Command, stick: Path) -> None:
    for name in ("../out", "stick"):
        done = command("export", "-p", "stick.toml", "-o", "out", "--no-fmu", "--json", "--name", name)
        assert done.code == 1
        assert f"name = {name}" in done.message
    done = command("export", "-p", "stick.toml", "-o", "out", "--no-fmu")
    assert done.code == 2
    assert "--no-fmu" in done.err
    assert [path.name for path in stick.parent.iterdir()] == ["stick.toml"]
