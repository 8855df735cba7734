"""Start values and parameters that rumoca does not compute, as Booleans with operators."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import UnsupportedModelError, build_fmu
from pyjoystick import Fmu

_F = "function f input Real u; output Real y; algorithm y := u + 3; end f;"
_A = "model A parameter Boolean p = false; Real x = if p then 1 else 0; end A;"
_WHEN = "equation when time > 2 then b = not pre(b); end when;"


def _built(declarations: str, folder: Path) -> Path:
    file = folder / "M.mo"
    file.write_text(f"model M {declarations} end M;", "utf-8")
    return build_fmu("M", folder, library=[file]).path


def _at_start(declarations: str, folder: Path, name: str) -> float:
    with Fmu(_built(declarations, folder)) as fmu:
        return float(fmu.run([0.0, 0.5], outputs=[name])[name].iloc[0])


@pytest.mark.parametrize(
    "value",
    ["5 > 2", "not false", "true and 2 == 2", "q > 1", "if q > 1 then true else false", "sqrt(q) >= 1"],
)
def test_a_boolean_of_a_component(value: str, tmp_path: Path) -> None:
    assert _at_start(f"{_A} parameter Real q = 3; A a(p = {value});", tmp_path, "a.x") == 1.0


def test_a_value_that_follows_a_parameter(tmp_path: Path) -> None:
    with Fmu(_built(f"{_A} parameter Real q = 3; A a(p = q > 1);", tmp_path)) as fmu:
        assert fmu.run([0.0, 0.5], outputs=["a.x"], parameters={"q": 0.5})["a.x"].iloc[0] == 0.0


@pytest.mark.parametrize("values", ["{i <> 2 for i in 1:3}", "{5 > 2, 2 > 5, not false}"])
def test_elements_of_an_array(values: str, tmp_path: Path) -> None:
    array = "model A parameter Boolean p[3] = {false, true, false}; Real x[3] = if p[1] and p[3] and not p[2]"
    text = f"{array} then ones(3) else zeros(3); end A; A a(p = {values});"
    assert _at_start(text, tmp_path, "a.x[3]") == 1.0


@pytest.mark.parametrize("start", ["5 > 2", "c", "on", "not on or c"])
def test_the_start_of_a_discrete_variable(start: str, tmp_path: Path) -> None:
    constants = "constant Boolean c = 5 > 2; parameter Boolean on = true;"
    text = f"{constants} Boolean b(start = {start}, fixed = true); {_WHEN}"
    assert _at_start(text, tmp_path, "b") == 1.0


def test_the_starts_of_inputs(tmp_path: Path) -> None:
    text = "input Boolean u(start = 5 > 2); input Real v = 1 + 2; Real x = if u then v else 0;"
    assert _at_start(text, tmp_path, "x") == 3.0


@pytest.mark.parametrize(
    "declarations",
    [
        f"{_F} {_A} A a(p = f(2) > 1);",
        f"{_F} Boolean b(start = f(2) > 1, fixed = true); {_WHEN}",
        f"{_F} input Boolean u(start = f(2) > 1); Real x = if u then 1 else 0;",
    ],
)
def test_a_value_that_is_not_known_is_refused(declarations: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError, match="not plain arithmetic"):
        _built(declarations, tmp_path)
