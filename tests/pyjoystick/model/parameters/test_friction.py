"""Dry friction among the parameters: values, names in the FMU, files."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.model import (
    FRICTION_NAMES,
    NOMINAL,
    NOMINAL_POWER_LAW,
    PAPER,
    Friction,
    ImplausibleError,
    fmu_values,
    read_parameter_file,
    require_plausible,
    updated_text,
    write_parameters,
)
from pyjoystick.support import ParameterError

WITH = NOMINAL.replace({"friction.T_c": 0.0072, "friction.F_c": 0.3})


def test_no_friction_is_no_parameter_of_the_plain_fmus() -> None:
    assert not NOMINAL.friction
    assert not set(FRICTION_NAMES) & set(NOMINAL.to_names())
    assert not set(FRICTION_NAMES) & {value.name for value in fmu_values(PAPER)}
    assert set(FRICTION_NAMES) < set(WITH.to_names())
    assert WITH.replace(dict.fromkeys(FRICTION_NAMES, 0.0)) == NOMINAL
    assert WITH.replace({"J": 0.012}).friction == WITH.friction


@pytest.mark.parametrize(
    ("values", "field"),
    [
        ({"T_c": -0.1}, "T_c"),
        ({"F_c": float("nan")}, "F_c"),
        ({"T_c": 0.1, "T_s": 0.05}, "T_s"),
        ({"T_c": 0.1, "T_s": 0.2}, "omega_s"),
    ],
)
def test_values_that_cannot_be(values: dict[str, float], field: str) -> None:
    with pytest.raises(ParameterError) as caught:
        Friction(**values)
    assert caught.value.field == field
    with pytest.raises(ParameterError, match=f"friction.{field}"):
        NOMINAL.replace({f"friction.{name}": value for name, value in values.items()})


def test_a_file_keeps_it(tmp_path: Path) -> None:
    path = tmp_path / "joystick.toml"
    write_parameters(path, WITH, uncertainties={"friction.T_c": 1e-4, "friction.T_s": 1e-3})
    file = read_parameter_file(path)
    assert file.joystick == WITH
    assert file.with_law("power-law").friction == WITH.friction
    assert file.uncertainties == {"friction.T_c": 1e-4, "friction.T_s": 1e-3}
    assert "Coulomb friction moment" in path.read_text()
    values = {value.name: value for value in fmu_values(file)}
    assert (values["friction.T_c"].value, values["friction.T_c"].unit) == (0.0072, "N.m")
    assert values["friction.T_c"].uncertainty == 1e-4
    write_parameters(path, NOMINAL)
    assert read_parameter_file(path).joystick == NOMINAL


def test_a_file_without_friction_stays_as_it_is() -> None:
    assert updated_text(PAPER, NOMINAL) == PAPER.path.read_text(encoding="utf-8")
    assert "friction" not in updated_text(PAPER, NOMINAL_POWER_LAW)


def test_what_no_joystick_has() -> None:
    require_plausible("friction.F_c", 0.3)
    with pytest.raises(ImplausibleError, match="300 mN"):
        require_plausible("friction.F_c", 300.0)
