"""A parameter by which the compiler selects a branch becomes a constant of the FMU."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import build_fmu
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest
from pyjoystick import Fmu

_D = "discrete Real d(start = 0, fixed = true);"
_X = "Real x(start = 0, fixed = true);"


def _library(folder: Path, parameter: str, declarations: str, equations: str) -> Path:
    file = folder / "M.mo"
    file.write_text(f"model M\n  {parameter}\n  {declarations}\n{equations}\nend M;\n", "utf-8")
    return file


@pytest.mark.parametrize(
    ("parameter", "declarations", "equations"),
    [
        ("Real q = 2", _D, "equation when time > 0.2 then d = if 3 < q then pre(d) + 1 else -1; end when;"),
        (
            "Real q = 2",
            _D,
            "equation when time > 0.2 then d = if q < -3e2 then pre(d) + 1 else -1; end when;",
        ),
        (
            "Real q = 2",
            _D,
            "equation when time > 0.2 then d = if q > 3 and q < 3.1 then pre(d) else 1; end when;",
        ),
        (
            "Real q = 2, r = 3",
            _D,
            "equation when time > 0.2 then d = if q > r then pre(d) + 1 else -1; end when;",
        ),
        (
            "Integer q = 1",
            _D,
            "equation when time > 0.2 then d = if q == 4 then pre(d) + 1 else -1; end when;",
        ),
        (
            "Integer q = 1",
            _D,
            "equation when time > 0.2 then d = if q > 4 then pre(d) + 1 else -1; end when;",
        ),
        ("Boolean q = true", _D, "equation when time > 0.2 then d = if q then pre(d) + 1 else -1; end when;"),
        (
            "Real q = 2",
            _D,
            "equation when time > 0.2 then if q > 3 then d = pre(d); else d = 1; end if; end when;",
        ),
        ("Real q = 2", _D, "algorithm when time > 0.2 then d := if q > 3 then pre(d) else 1; end when;"),
        (
            "Real q = 2",
            _X,
            "equation der(x) = 1; when x > 1 then reinit(x, if q > 3 then x else 0); end when;",
        ),
    ],
)
def test_a_choice_that_is_made_is_no_parameter(
    tmp_path: Path, parameter: str, declarations: str, equations: str
) -> None:
    file = _library(tmp_path, f"parameter {parameter};", declarations, equations)
    generated, _ = generate_model(BuildRequest("M", tmp_path, file))
    (q,) = [one for one in generated.description.variables if one.name == "q"]
    assert q.causality == "local"
    assert q.variability == "constant"


def test_a_choice_that_is_left_follows_the_parameter(tmp_path: Path) -> None:
    equations = "equation when time > 0.2 then d = pre(d) + (if 3 < q then 1 else -1); end when;"
    file = _library(tmp_path, "parameter Real q = 2;", _D, equations)
    with Fmu(build_fmu("M", tmp_path, library=file).path) as fmu:
        found = [fmu.run([0.0, 1.0], parameters={"q": q}, outputs=["d"])["d"].iloc[-1] for q in (2.0, 4.0)]
    assert found == [-1.0, 1.0]
