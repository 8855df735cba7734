"""Tables of input steps next to Modelica sources."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fmu_build.compilers.input_steps import input_steps_file, read_input_steps
from fmu_build.support.description import InputStep
from fmu_build.support.errors import ModelicaError


def test_place_of_the_table(tmp_path: Path) -> None:
    resources = Path("Resources", "Inputs")
    assert input_steps_file(tmp_path, "L.Joystick.M") == tmp_path / resources / "Joystick" / "M.csv"
    (tmp_path / "M.mo").touch()
    assert input_steps_file(tmp_path / "M.mo", "M") == tmp_path / resources / "M.csv"


def test_rows(tmp_path: Path) -> None:
    file = tmp_path / "M.csv"
    file.write_text("time,u,arm.T\n0,1e-3,-2\n0.5,0,0\n")
    assert read_input_steps(file, ["arm.T", "u", "v"]) == (
        InputStep(0.0, {"u": 1e-3, "arm.T": -2.0}),
        InputStep(0.5, {"u": 0.0, "arm.T": 0.0}),
    )
    assert read_input_steps(tmp_path / "N.csv", ["u"]) == ()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "time,w\n0,1\n",
            "M.csv:1: the columns are time, w; allowed are time and then inputs, each once: u, v",
        ),
        ("t,u\n0,1\n", "M.csv:1: the columns are t, u; allowed are time"),
        ("time,u,u\n0,1,1\n", "each once"),
        ("time,u\n0,1\n0,2\n", "M.csv:3: the time 0 does not come after 0"),
        ("time,u\n0,one\n", "M.csv:2: 'one' is not a finite number"),
        ("time,u\n0,nan\n", "M.csv:2: 'nan' is not a finite number"),
        ("time,u\n0\n", "M.csv:2: 1 values, but 2 columns"),
        ("", "M.csv: no readable table"),
    ],
)
def test_what_is_no_table(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "M.csv").write_text(text)
    with pytest.raises(ModelicaError, match=re.escape(message)):
        read_input_steps(tmp_path / "M.csv", ["u", "v"])
