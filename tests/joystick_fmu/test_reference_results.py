"""The reference results in the joystick FMUs: correct, in the cross-check's format, reproducible."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pandas as pd
import pytest
from fmpy.cross_check.validate_vendor_repo import read_csv, validate_test_fmu
from fmpy.util import read_ref_opt_file
from lxml import etree

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, inverse_torque, simulate

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
PARAMETERS = {
    "Joystick": NOMINAL,
    "JoystickPowerLaw": NOMINAL_POWER_LAW,
    "JoystickInverse": NOMINAL,
    "JoystickInversePowerLaw": NOMINAL_POWER_LAW,
}
each_fmu = pytest.mark.parametrize("name", PARAMETERS)


def _table(fmus: Path, name: str, ending: str) -> pd.DataFrame:
    with zipfile.ZipFile(fmus / f"{name}.fmu") as archive:
        return pd.read_csv(io.BytesIO(archive.read(f"{FOLDER}/{name}{ending}")), index_col="time")


def _held(inputs: pd.DataFrame, time: pd.Index) -> pd.DataFrame:
    """The inputs of the step that ends at each time; at the first one, those that the run starts with."""
    last = inputs[~inputs.index.duplicated(keep="last")]
    return last.reindex(np.maximum(time - 1e-9, time[0]), method="ffill")


def _in_cross_check_folder(fmus: Path, name: str, folder: Path) -> Path:
    """FMU and tables as the rules of the cross-check have them."""
    model = folder / "2.0" / "cs" / fmpy.platform / "pyjoystick" / "0" / name
    model.mkdir(parents=True)
    (model / f"{name}.fmu").write_bytes((fmus / f"{name}.fmu").read_bytes())
    with zipfile.ZipFile(fmus / f"{name}.fmu") as archive:
        for ending in ("_ref.csv", "_ref.opt", "_in.csv"):
            (model / f"{name}{ending}").write_bytes(archive.read(f"{FOLDER}/{name}{ending}"))
    return model


@pytest.mark.parametrize("name", ["Joystick", "JoystickPowerLaw"])
def test_motion_is_that_of_the_reference(name: str, joystick_fmus: Path) -> None:
    table, inputs = (_table(joystick_fmus, name, ending) for ending in ("_ref.csv", "_in.csv"))
    last = inputs[~inputs.index.duplicated(keep="last")]["T"]
    expected = simulate(
        PARAMETERS[name],
        time=table.index,
        theta_start=0.0,
        torque=lambda time: float(last.asof(time)),
        torque_breakpoints=last.index,
    )
    assert np.abs(expected.theta).max() > 0.3
    np.testing.assert_allclose(table["theta"], expected.theta, rtol=0, atol=1e-9)
    np.testing.assert_allclose(table["omega"], expected.omega, rtol=0, atol=1e-7)


@pytest.mark.parametrize("name", ["JoystickInverse", "JoystickInversePowerLaw"])
def test_torque_is_that_of_the_reference(name: str, joystick_fmus: Path) -> None:
    table, inputs = (_table(joystick_fmus, name, ending) for ending in ("_ref.csv", "_in.csv"))
    held = _held(inputs, table.index)
    expected = inverse_torque(PARAMETERS[name], held["theta"], held["omega"], held["alpha"])
    for share in ("T", "T_inertia", "T_damping", "T_stiffness"):
        assert np.ptp(table[share]) > 0.1
        np.testing.assert_allclose(table[share], getattr(expected, share), rtol=1e-9, atol=1e-10)


@each_fmu
def test_form_of_the_cross_check(name: str, joystick_fmus: Path, tmp_path: Path) -> None:
    model = _in_cross_check_folder(joystick_fmus, name, tmp_path)
    assert validate_test_fmu(str(model)) == []
    for table in model.glob("*.csv"):
        header, *rows = table.read_text().splitlines()
        assert all(column == f'"{column[1:-1]}"' for column in header.split(","))
        assert not any('"' in row or " " in row for row in rows)
    options = read_ref_opt_file(model / f"{name}_ref.opt")
    assert (options["StartTime"], options["StopTime"], options["RelTol"]) == (0.0, 1.5, 1e-10)


@each_fmu
def test_another_tool_gets_the_same_from_them(name: str, joystick_fmus: Path, tmp_path: Path) -> None:
    model = _in_cross_check_folder(joystick_fmus, name, tmp_path)
    options = read_ref_opt_file(model / f"{name}_ref.opt")
    expected = read_csv(model / f"{name}_ref.csv")
    result = fmpy.simulate_fmu(
        str(model / f"{name}.fmu"),
        fmi_type="CoSimulation",
        start_time=options["StartTime"],
        stop_time=options["StopTime"],
        relative_tolerance=options["RelTol"],
        output_interval=options["OutputIntervalLength"],
        input=read_csv(model / f"{name}_in.csv"),
        output=list(expected.dtype.names[1:]),
    )
    np.testing.assert_allclose(result["time"], expected["time"], rtol=0, atol=1e-12)
    for column in expected.dtype.names[1:]:
        scale = np.abs(expected[column]).max()
        np.testing.assert_allclose(result[column], expected[column], rtol=0, atol=1e-8 * scale)


@each_fmu
def test_manifest_lists_the_tables(name: str, joystick_fmus: Path) -> None:
    with zipfile.ZipFile(joystick_fmus / f"{name}.fmu") as archive:
        manifest = etree.fromstring(archive.read(f"{FOLDER}/fmi-ls-manifest.xml"))
        present = {Path(n).name for n in archive.namelist() if n.startswith(FOLDER)}
    namespace = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert manifest.tag == "fmiReferences"
    assert manifest.get(f"{namespace}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    assert {f"{namespace}fmi-ls-{key}" for key in ("name", "version", "description")} == set(manifest.attrib)
    related = {entry.get("source"): entry.get("role") for entry in manifest.iterfind("Related")}
    assert related == {
        f"{name}_ref.csv": "result",
        f"{name}_ref.opt": "configuration",
        f"{name}_in.csv": "testcase",
    }
    assert present == {*related, "fmi-ls-manifest.xml"}
