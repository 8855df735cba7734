"""The parameters by their names in the FMU, as a document."""

from __future__ import annotations

import json
from pathlib import Path

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    parameter_list,
    read_parameter_file,
    values_json,
    write_parameters,
)


def test_values_by_fmu_name(tmp_path: Path) -> None:
    changed = NOMINAL_POWER_LAW.replace({"m": 0.9, "damping.B": 0.06})
    uncertainties = {"body.m": 1e-3, "damping.power-law.B": 2e-4}
    write_parameters(tmp_path / "a.toml", changed, uncertainties=uncertainties, sources={"body": "balance"})
    file = read_parameter_file(tmp_path / "a.toml")
    document = json.loads(values_json(file, notes=["heavy"]))
    assert (document["title"], document["damping"], document["notes"]) == ("a", "power-law", ["heavy"])
    found = {one["name"]: one for one in document["parameters"]}
    assert {name: one["value"] for name, one in found.items()} == file.joystick.to_names()
    assert (found["m"]["standard_uncertainty"], found["m"]["source"]) == (1e-3, "balance")
    assert found["damping.B"] == {
        "name": "damping.B",
        "value": 0.06,
        "unit": "N.m.s/rad",
        "standard_uncertainty": 2e-4,
        "source": "",
        "from": "damping.power-law: B",
    }
    assert found["forward.returnSpring.F_0"]["standard_uncertainty"] is None
    assert json.loads(values_json(file, "constant"))["damping"] == "constant"


def test_a_joystick_has_units() -> None:
    """Those of its FMU, with friction and stops where it has them."""
    whole = NOMINAL.replace({"friction.T_c": 0.01, "stops.theta_stop": 0.35})
    units = {str(one["name"]): one["unit"] for one in parameter_list(whole)}
    assert list(units) == list(whole.to_names())
    assert units["forward.balanceSpring.F_0"] == "N"
    assert (units["friction.T_c"], units["stops.theta_stop"]) == ("N.m", "rad")
