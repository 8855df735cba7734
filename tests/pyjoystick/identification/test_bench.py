"""Parameters treated as exact, and the FMU that the fits of a bench need."""

from __future__ import annotations

from pathlib import Path

from pyjoystick.identification import Bench, stated_uncertainties
from pyjoystick.model import NOMINAL, read_parameter_file, write_parameters


def test_what_has_no_uncertainty_is_exact() -> None:
    bench = Bench(joystick=NOMINAL, curves={}, uncertainties={"m": 0.001, "h": 0.0, "J": 0.0})
    curves = ("load curve forward", "load curve backward")
    none = "the absence of dry friction"
    assert bench.exact == (
        "h",
        "g",
        "a",
        "b",
        none,
        *curves,
        "scale of the angle",
        "time base",
        "scale of the force",
    )
    known = Bench(
        joystick=NOMINAL.replace({"friction.F_c": 0.3}),
        curves={},
        uncertainties=dict.fromkeys("mhgab", 1e-6),
        scale=1e-3,
        time_base=1e-4,
        force_scale=5e-3,
    )
    assert known.exact == ("friction.F_c", *curves)


def test_friction_of_which_only_the_uncertainty_is_not_zero_needs_an_fmu_that_has_it(tmp_path: Path) -> None:
    path = tmp_path / "joystick.toml"
    write_parameters(path, NOMINAL, uncertainties={"friction.T_c": 0.01, "body.m": 0.002})
    file = read_parameter_file(path)
    stated = stated_uncertainties(file)
    assert {name: one for name, one in stated.items() if one} == {"m": 0.002, "friction.T_c": 0.01}
    assert Bench(joystick=file.joystick, curves={}, uncertainties=stated).fmu == "JoystickFriction"
    assert Bench(joystick=file.joystick, curves={}, uncertainties={"m": 0.002}).fmu == "Joystick"
