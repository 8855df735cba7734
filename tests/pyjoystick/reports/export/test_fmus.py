"""Exported FMUs, in FMPy: an importer that sets nothing but what moves it gets the file's joystick."""

from __future__ import annotations

import json
import re
from pathlib import Path

import fmpy
import numpy as np
import pytest

from fmu_build import FmiVersion
from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    JoystickParameters,
    ParameterFile,
    inverse_torque,
    read_parameter_file,
    simulate,
    write_parameters,
)
from pyjoystick.reports import FmuExportError, default_name, export_fmus, values_json
from pyjoystick.support import ParameterError

TIME = np.arange(1501) * 1e-3


def _file(folder: Path, law: str, name: str = "left_stick.toml") -> ParameterFile:
    """A joystick of which every number differs from the library's."""
    nominal: JoystickParameters = NOMINAL if law == "constant" else NOMINAL_POWER_LAW
    rng = np.random.default_rng(1)
    changed = nominal.replace({k: v * rng.uniform(1.0, 1.05) for k, v in nominal.to_names().items()})
    write_parameters(
        folder / name,
        changed,
        title='"Left" <stick> & co.',
        uncertainties={"body.m": 1e-3, f"damping.{law}.{'C' if law == 'constant' else 'B'}": 2e-4},
        sources={"body": "balance, \\ 3 May"},
    )
    return read_parameter_file(folder / name)


def _starts(path: Path) -> dict[str, float]:
    variables = fmpy.read_model_description(str(path)).modelVariables
    return {v.name: float(v.start) for v in variables if v.causality == "parameter"}


@pytest.mark.parametrize(("law", "version"), [("constant", "2.0"), ("power-law", "3.0")])
def test_an_exported_fmu_is_the_joystick_of_the_file(law: str, version: FmiVersion, tmp_path: Path) -> None:
    file = _file(tmp_path, law)
    (path,) = export_fmus(file, tmp_path / "out", directions=("forward",), fmi_version=version)
    assert path.name == "LeftStick.fmu"
    assert _starts(path) == file.joystick.to_names() | {"theta_start": 0.0, "omega_start": 0.0}
    run = fmpy.simulate_fmu(
        str(path),
        stop_time=1.5,
        output_interval=1e-3,
        relative_tolerance=1e-8,
        start_values={"theta_start": -0.3},
        output=["theta"],
    )
    reference = simulate(file.joystick, time=TIME, theta_start=-0.3)
    assert np.max(np.abs(run["theta"] - reference.theta)) < 1e-7
    stock = simulate(
        NOMINAL if law == "constant" else NOMINAL_POWER_LAW, time=TIME, theta_start=-0.3, tolerance=1e-9
    )
    assert np.max(np.abs(run["theta"] - stock.theta)) > 1e-3


def test_inverse_fmu_and_what_the_archive_says(tmp_path: Path) -> None:
    file = _file(tmp_path, "constant")
    (path,) = export_fmus(file, tmp_path, name="Stick", directions=("inverse",))
    assert path.name == "StickInverse.fmu"
    moving = np.array(
        [(0.0, 0.1, 2.0, -30.0)], dtype=[(name, float) for name in ("time", "theta", "omega", "alpha")]
    )
    run = fmpy.simulate_fmu(str(path), stop_time=0.1, input=moving, output=["T"])
    expected = inverse_torque(file.joystick, 0.1, 2.0, -30.0).T
    assert run["T"][-1] == pytest.approx(float(expected), rel=1e-12)
    folder = Path(fmpy.extract(str(path), str(tmp_path / "unpacked")))
    page = (folder / "documentation" / "index.html").read_text("utf-8")
    assert "&lt;stick&gt; &amp; co." in page
    assert "balance, \\ 3 May" in page
    assert "0.001" in page
    assert list(folder.rglob("*.csv"))


def test_values_by_fmu_name(tmp_path: Path) -> None:
    file = _file(tmp_path, "power-law")
    found = json.loads(values_json(file))["parameters"]
    assert {name: one["value"] for name, one in found.items()} == file.joystick.to_names()
    assert found["m"]["standard_uncertainty"] == 1e-3
    assert found["damping.B"] == {
        "value": file.joystick.to_names()["damping.B"],
        "unit": "N.m.s/rad",
        "standard_uncertainty": 2e-4,
        "source": "",
        "from": "damping.power-law: B",
    }
    assert found["forward.returnSpring.F_0"]["standard_uncertainty"] is None


@pytest.mark.parametrize(
    ("file", "name"),
    [
        ("left_stick.toml", "LeftStick"),
        ("joystick.toml", "MyJoystick"),
        ("2nd.toml", "My2nd"),
        ("Größe 3.toml", "GrE3"),
    ],
)
def test_default_name(file: str, name: str, tmp_path: Path) -> None:
    assert default_name(_file(tmp_path, "constant", file)) == name


@pytest.mark.parametrize("name", ["stick", "My Stick", "Größe", "PreloadedSprings", "../Evil"])
def test_names_that_no_fmu_can_have(name: str, tmp_path: Path) -> None:
    file = _file(tmp_path, "constant")
    with pytest.raises(ParameterError, match=re.escape(name)):
        export_fmus(file, tmp_path / "out", name=name)
    assert not (tmp_path / "out").exists()


def test_without_a_compiler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pyjoystick.reports.export.fmus.find_spec", lambda name: None)
    with pytest.raises(FmuExportError, match=r"pip install 'pyjoystick\[build\]'"):
        export_fmus(_file(tmp_path, "constant"), tmp_path / "out")
    assert not (tmp_path / "out").exists()
