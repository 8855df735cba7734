"""Connectors of the exported model itself: what the FMU lists and what it computes."""

from __future__ import annotations

import re
from pathlib import Path

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest

FLANGE = """connector Flange Real phi; flow Real tau; end Flange;"""


def _generated(tmp_path: Path, name: str, body: str) -> tuple[set[str], str]:
    """The names of the variables, and the C code."""
    library = tmp_path / "Shafts.mo"
    library.write_text(f"package Shafts {FLANGE} {body} end Shafts;", "utf-8")
    generated, _ = generate_model(BuildRequest(f"Shafts.{name}", tmp_path, library))
    return {variable.name for variable in generated.description.variables}, generated.c_source


ROTOR = """model Rotor
  Flange flange; Real phi(start = 1, fixed = true); Real w(start = 0, fixed = true);
equation
  phi = flange.phi; der(phi) = w; 2*der(w) = -3*phi + flange.tau;
end Rotor;"""


def test_a_second_name_and_a_zero_are_left_out(tmp_path: Path) -> None:
    names, code = _generated(tmp_path, "Rotor", ROTOR)
    assert {"phi", "w"} <= names
    assert not {"flange.phi", "flange.tau"} & names
    assert not re.search(r"v_flange_(phi|tau)", code)


def test_a_potential_that_is_a_state_stays(tmp_path: Path) -> None:
    names, _ = _generated(
        tmp_path, "Free", "model Free Flange flange; equation der(flange.phi) = 2 + flange.tau; end Free;"
    )
    assert {"flange.phi", "flange.tau"} <= names


def test_of_a_component_the_variables_stay_and_the_flow_is_not_added(tmp_path: Path) -> None:
    names, code = _generated(tmp_path, "Machine", f"{ROTOR} model Machine Rotor rotor; end Machine;")
    assert {"rotor.flange.phi", "rotor.flange.tau"} <= names
    assert not re.search(r"[-+*/] v_rotor_flange_tau|v_rotor_flange_tau [-+*/]", code)


def test_connected_flows_stay(tmp_path: Path) -> None:
    pair = "model Pair Rotor a; Rotor b; equation connect(a.flange, b.flange); end Pair;"
    rotor = ROTOR.replace("(start = 1, fixed = true)", "").replace("(start = 0, fixed = true)", "")
    names, code = _generated(tmp_path, "Pair", f"{rotor} {pair}")
    assert {"a.flange.tau", "b.flange.tau"} <= names
    assert "Y_a_flange_tau" in code
