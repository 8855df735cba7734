"""A fit that starts from a parameter file."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.identification import CONSTANT_DAMPING, FitSettings, Free, read_fit_settings, with_values
from pyjoystick.model import NOMINAL, write_parameters
from pyjoystick.support import SettingsError

_SETTINGS = """
[fmu]
path = "Joystick"
parameters = "joystick.toml"

[parameters]
m = 0.9

[free."damping.C"]
[free.J]
start = 0.013
"""


def test_values_are_fixed_or_the_start() -> None:
    settings = FitSettings(
        fmu="Joystick",
        free=(Free("damping.C"), Free("J", start=0.01)),
        ties={"h": "0.1 * a"},
        fixed={"m": 1.0},
    )
    values = NOMINAL.replace({"J": 0.02, "damping.C": 0.06}).to_names()
    found = with_values(settings, values)
    assert [(one.name, one.start) for one in found.free] == [("damping.C", 0.06), ("J", 0.01)]
    assert found.fixed["m"] == 1.0
    assert found.fixed["a"] == NOMINAL.a
    assert set(found.fixed) == set(values) - {"damping.C", "J", "h"}
    replaced = with_values(settings, values, replace_starts=True)
    assert [one.start for one in replaced.free] == [0.06, 0.02]


def test_the_release_stays_free() -> None:
    found = with_values(CONSTANT_DAMPING, NOMINAL.to_names(), replace_starts=True)
    assert found.free[1:] == CONSTANT_DAMPING.free[1:]


def test_settings_name_a_parameter_file(tmp_path: Path, fmus_by_name: Path) -> None:
    write_parameters(tmp_path / "joystick.toml", NOMINAL.replace({"J": 0.02, "damping.C": 0.06, "b": 0.004}))
    (tmp_path / "fit.toml").write_text(_SETTINGS, encoding="utf-8")
    found = read_fit_settings(tmp_path / "fit.toml")
    assert {one.name: one.start for one in found.free} == {"damping.C": 0.06, "J": 0.013}
    assert (found.fixed["m"], found.fixed["b"]) == (0.9, 0.004)


def test_a_parameter_file_for_another_fmu(tmp_path: Path, fmus_by_name: Path, mixed_path: Path) -> None:
    write_parameters(tmp_path / "joystick.toml", NOMINAL)
    text = _SETTINGS.replace('path = "Joystick"', f'path = "{mixed_path}"').replace("m = 0.9", "")
    (tmp_path / "fit.toml").write_text(text, encoding="utf-8")
    with pytest.raises(
        SettingsError, match=r"\[fmu\] parameters = .joystick.toml.: is for joysticks, and Mixed has no"
    ):
        read_fit_settings(tmp_path / "fit.toml")
