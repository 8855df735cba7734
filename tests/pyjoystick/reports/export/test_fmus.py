"""Exported FMUs in other tools: an importer that sets only the release gets the file's joystick."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.ssp.ssd import read_ssd

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    PAPER,
    JoystickParameters,
    LawName,
    ParameterFile,
    fmu_values,
    inverse_torque,
    read_parameter_file,
    simulate,
    write_parameters,
)
from pyjoystick.reports import FmuExportError, default_name, export_fmus, export_ssp, fit_page, modelica_class
from pyjoystick.runs import read_ssp
from pyjoystick.support import InputFileError, ParameterError
from tests.other_tools import test_ecos, test_pyfmi
from tests.other_tools.programs import require, run

TIME = np.arange(1501) * 1e-3
RELEASE = -0.3
SYSTEM = """
from ecospy import EcosLib, EcosSimulation
EcosLib.set_log_level("warn")
with EcosSimulation(ssp_path=path, step_size=1e-3) as simulation:
    simulation.set_real("LeftStick::theta_start", release)
    simulation.init(parameter_set="parameters")
    values = [simulation.get_real("LeftStick::theta")]
    for _ in range(1500):
        simulation.step()
        values.append(simulation.get_real("LeftStick::theta"))
print(json.dumps(values))
"""


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


@pytest.mark.parametrize(("law", "suffix"), [("constant", ""), ("power-law", "PowerLaw")])
def test_a_joystick_with_friction_extends_the_model_that_has_it(
    law: LawName, suffix: str, tmp_path: Path
) -> None:
    file = _file(tmp_path, law)
    for friction, base in ((0.0, "Joystick"), (0.0072, "JoystickFriction")):
        write_parameters(file.path, file.joystick.replace({"friction.T_c": friction}))
        values = fmu_values(read_parameter_file(file.path))
        text = modelica_class("Stick", values, law=law)
        assert f"extends PreloadedSprings.Joystick.{base}{suffix}(" in text
        assert ("T_c = 0.0072" in text) == bool(friction)
        inverse = modelica_class("Stick", values, direction="inverse", law=law)
        assert f"extends PreloadedSprings.Joystick.JoystickInverse{suffix}(" in inverse


def test_a_joystick_with_stops_is_a_mounted_one(tmp_path: Path) -> None:
    """Its inverse has none: motions end at the stops."""
    file = _file(tmp_path, "constant")
    write_parameters(file.path, file.joystick.replace({"stops.theta_stop": 0.3, "friction.T_c": 0.01}))
    values = fmu_values(read_parameter_file(file.path))
    text = modelica_class("Stick", values, law="constant")
    assert "extends PreloadedSprings.Operator.MountedJoystick(" in text
    assert "theta_stop = 0.3" in text
    inverse = modelica_class("Stick", values, direction="inverse", law="constant")
    assert "extends PreloadedSprings.Joystick.JoystickInverse(" in inverse
    assert "stops(" not in inverse
    assert "theta_stop" not in inverse
    assert "Valid within the stops only</b>, at 17.1887 degrees" in inverse
    assert "the stops" not in modelica_class("Stick", fmu_values(file), direction="inverse", law="constant")


def _starts(path: Path) -> dict[str, float]:
    variables = fmpy.read_model_description(str(path)).modelVariables
    return {v.name: float(v.start) for v in variables if v.causality == "parameter"}


@pytest.fixture(scope="module", params=[("constant", "2.0"), ("power-law", "3.0")], ids=["FMI 2", "FMI 3"])
def exported(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[ParameterFile, Path]:
    """The file of a joystick and its FMU."""
    law, version = request.param
    file = _file(tmp_path_factory.mktemp("exported"), law)
    (path,) = export_fmus(file, file.path.parent / "out", directions=("forward",), fmi_version=version)
    return file, path


def _reference(file: ParameterFile) -> np.ndarray:
    return simulate(file.joystick, time=TIME, theta_start=RELEASE).theta


def test_an_exported_fmu_is_the_joystick_of_the_file(exported: tuple[ParameterFile, Path]) -> None:
    file, path = exported
    assert path.name == "LeftStick.fmu"
    assert _starts(path) == file.joystick.to_names() | {"theta_start": 0.0, "omega_start": 0.0}
    run = fmpy.simulate_fmu(
        str(path),
        stop_time=1.5,
        output_interval=1e-3,
        relative_tolerance=1e-8,
        start_values={"theta_start": RELEASE},
        output=["theta"],
    )
    assert np.max(np.abs(run["theta"] - _reference(file))) < 1e-7
    nominal = NOMINAL if file.law == "constant" else NOMINAL_POWER_LAW
    stock = simulate(nominal, time=TIME, theta_start=RELEASE, tolerance=1e-9)
    assert np.max(np.abs(run["theta"] - stock.theta)) > 1e-3


def test_in_ecos(exported: tuple[ParameterFile, Path]) -> None:
    require("ecospy")
    file, path = exported
    theta = run(test_ecos.PROGRAM, fmu=str(path), release=RELEASE, step=1e-3, count=1500)
    assert np.max(np.abs(np.array(theta) - _reference(file))) < 1e-7


def test_in_pyfmi(exported: tuple[ParameterFile, Path]) -> None:
    require("pyfmi")
    file, path = exported
    if file.law != "constant":
        pytest.skip("PyFMI does not support Co-Simulation of FMI 3")
    time, theta = run(test_pyfmi.PROGRAM, fmu=str(path), kind="CS", release=RELEASE)
    expected = simulate(file.joystick, time=time, theta_start=RELEASE).theta
    assert np.max(np.abs(np.array(theta) - expected)) < 1e-7


@pytest.mark.skipif(sys.platform != "linux", reason="the importer loads shared libraries as Linux has them")
def test_in_an_importer_in_c(exported: tuple[ParameterFile, Path], tmp_path: Path) -> None:
    file, path = exported
    description = fmpy.read_model_description(str(path))
    version = description.fmiVersion[0]
    source, program = Path(test_ecos.__file__).with_name("importer.c"), tmp_path / "importer"
    headers = Path(fmpy.__file__).parent / "c-code"
    # The compiler of the machine where it has one: zig makes its C library first, which takes a minute.
    compiler = [found] if (found := shutil.which("cc")) else [sys.executable, "-m", "ziglang", "cc"]
    options = [f"-DFMI={version}", f"-I{headers}", str(source), "-o", str(program), "-ldl"]
    subprocess.run([*compiler, *options], check=True)
    names = {one.name: str(one.valueReference) for one in description.modelVariables}
    token = description.guid if version == "2" else description.instantiationToken
    (binary,) = Path(fmpy.extract(str(path), str(tmp_path / "fmu"))).glob("binaries/*/*.so")
    given = [token, names["theta_start"], repr(RELEASE), names["theta"], "1e-3", "1500"]
    done = subprocess.run([str(program), str(binary), *given], capture_output=True, text=True, check=True)
    theta = np.array(done.stdout.split(), dtype=np.float64)
    assert np.max(np.abs(theta - _reference(file))) < 1e-7


def test_as_a_system_with_its_values(exported: tuple[ParameterFile, Path], tmp_path: Path) -> None:
    file, path = exported
    ssp = tmp_path / "stick.ssp"
    export_ssp(file, path, ssp)
    binding = read_ssd(str(ssp), validate=True).system.elements[0].parameterBindings[0]
    assert binding.source == "resources/LeftStick.ssv"
    (values,) = binding.parameterValues  # the file is valid by the schema of SSV too
    assert {one.name: float(one.value) for one in values.parameters} == file.joystick.to_names()
    assert {one.name: one.unit for one in values.parameters}["J"] == "kg.m2"
    system = read_ssp(ssp, tmp_path / "unpacked")
    assert system.components[0].parameters == file.joystick.to_names()
    with zipfile.ZipFile(ssp) as archive:
        text = archive.read("resources/LeftStick.ssv").decode()
        archive.extractall(tmp_path / "whole")
    assert 'description="standard uncertainty 0.001 kg; balance, \\ 3 May"' in text
    assert '<pj:Measured standardUncertainty="0.001" source="balance, \\ 3 May"' in text
    # What is in the file is what tools set: another mass there is another mass.
    heavier = tmp_path / "heavier.ssp"
    (old,) = re.findall(r'name="m" [^>]*>\s*<ssv:Real unit="kg" value="([^"]*)"', text)
    with zipfile.ZipFile(heavier, "w") as archive:
        for one in (tmp_path / "whole").rglob("*"):
            if one.is_file():
                content = one.read_bytes().replace(f'value="{old}"'.encode(), b'value="1.5"')
                name = one.relative_to(tmp_path / "whole").as_posix()
                archive.writestr(name, content if one.suffix == ".ssv" else one.read_bytes())
    assert read_ssp(heavier, tmp_path / "heavier").components[0].parameters["m"] == 1.5


@pytest.mark.parametrize("changed", [False, True])
def test_the_system_in_ecos(exported: tuple[ParameterFile, Path], changed: bool, tmp_path: Path) -> None:
    require("ecospy")
    file, path = exported
    joystick = file.joystick.replace({"J": 0.02}) if changed else file.joystick
    write_parameters(tmp_path / "one.toml", joystick)
    ssp = tmp_path / "stick.ssp"
    export_ssp(read_parameter_file(tmp_path / "one.toml"), path, ssp)
    theta = run(SYSTEM, path=str(ssp), release=RELEASE)
    assert np.max(np.abs(np.array(theta) - simulate(joystick, time=TIME, theta_start=RELEASE).theta)) < 1e-7


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


def _fit(file: ParameterFile, **changes: object) -> Path:
    """As `pyjoystick fit --output` writes it, as far as the page needs it."""
    C = file.joystick.to_names()["damping.C"]  # noqa: N806  # the symbol
    fitted = {"name": "damping.C", "record": None, "unit": "N.m.s/rad", "standard_error": 1e-4}
    release = {"name": "theta_start", "record": "a", "unit": "rad", "value": 0.1, "standard_error": 1e-3}
    content = {
        "parameters": [
            {**fitted, "value": C + 5e-6, "interval": [0.9 * C, 1.1 * C]},
            {**release, "interval": [0, 1]},
        ],
        "records": [{"name": "a <1>", "data": [1.0, 2.0]}, {"name": "b", "data": [3.0]}],
        "checks": [{"name": "whiteness", "passed": True, "message": "it is"}],
        "settings": {"uncertainty": {"level": 0.95}},
        "made_with": {"pyjoystick": "1.2.3"},
    }
    path = file.path.with_name("fit.json")
    path.write_text(json.dumps({**content, **changes}), encoding="utf-8")
    return path


def test_the_page_of_the_fit(tmp_path: Path) -> None:
    file = _file(tmp_path, "constant")
    values = fmu_values(file)
    page = fit_page(_fit(file), values)
    assert "Fitted to a &lt;1&gt;, b, 3 numbers in all. It passed every check." in page
    assert "pyjoystick 1.2.3" in page
    assert "damping.C" in page
    assert "theta_start" not in page
    text = modelica_class("Stick", values, law="constant", more=page)
    assert text.count("<h2>The fit</h2>") == 1
    failed = {"name": "noise", "passed": False, "message": "is colored"}
    assert "It failed noise: is colored." in fit_page(_fit(file, checks=[failed]), values)


def test_a_fit_of_another_joystick_is_refused(tmp_path: Path) -> None:
    file = _file(tmp_path, "constant")
    other = fmu_values(read_parameter_file(PAPER.path))
    with pytest.raises(InputFileError, match=r"is of another joystick: its damping.C is 0\.0\d+, not 0.045"):
        fit_page(_fit(file), other)
    for content in ("", "[]", '{"parameters": 3}', '{"parameters": [{}]}'):
        (tmp_path / "fit.json").write_text(content, encoding="utf-8")
        with pytest.raises(InputFileError, match=r"fit.json: is not a fit.json"):
            fit_page(tmp_path / "fit.json", other)


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
