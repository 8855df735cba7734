"""From a fit to the numbers of a parameter file."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from pyjoystick.identification import (
    RELEASE,
    Fit,
    FitError,
    FitSettings,
    Free,
    Uncertainty,
    fit,
    fitted_joystick,
    require_joystick_in,
)
from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    JoystickParameters,
    read_parameter_file,
    rounded_error,
    write_parameters as write,
)
from tests.pyjoystick.identification.fitting.made import releases

NOISE = math.radians(0.1)
QUICK = Uncertainty(profiles=())
SPRING = "forward.returnSpring"


def _fit(joystick: JoystickParameters, settings: FitSettings, records: int = 1) -> Fit:
    return fit(releases(joystick, records, noise=NOISE), settings)


def test_the_preload_of_a_spring_moves_kinks_of_its_curve(fmus_by_name: Path, tmp_path: Path) -> None:
    names = (f"{SPRING}.F_0", f"{SPRING}.k_s")
    settings = FitSettings(
        fmu="Joystick", free=(*map(Free, names), *RELEASE), fixed={"m": 0.9}, uncertainty=QUICK
    )
    found = _fit(NOMINAL.replace({"m": 0.9}), settings)
    before = {f"forward.{key}[{i}]": 1e-6 for key in ("x", "k") for i in range(4)} | {"body.m": 0.001}
    fitted = fitted_joystick(found, NOMINAL, before)
    assert fitted.joystick.m == 0.9
    preload, stiffness = (found.error(name) for name in names)
    written = fitted.joystick.forward.return_spring.F_0
    assert abs(written - found.value(names[0])) < 0.01 * preload
    assert len(f"{written:.12g}") < 9
    assert fitted.joystick.backward == NOMINAL.backward
    assert (fitted.tables, fitted.fixed) == (("forward",), ("body",))
    errors = fitted.uncertainties
    # x_1 = x_0 + F_0/k_h, k_0 = k_s + k_h, k_1 = k_s, k_2 = k_s + k'_s + k'_h, k_3 = k_s + k'_s.
    kink = rounded_error(preload / NOMINAL.forward.return_spring.k_h)
    assert errors["forward.x[1]"] == pytest.approx(kink, rel=1e-12)
    assert [errors[f"forward.k[{i}]"] for i in range(4)] == [rounded_error(stiffness)] * 4
    assert [errors[f"forward.x[{i}]"] for i in (0, 2, 3)] == [1e-6] * 3
    assert "body.m" not in errors
    write(tmp_path / "joystick.toml", fitted.joystick, uncertainties=errors)
    assert read_parameter_file(tmp_path / "joystick.toml").uncertainties == errors


def test_a_tied_parameter_has_the_error_that_follows(fmus_by_name: Path) -> None:
    settings = FitSettings(
        fmu="JoystickPowerLaw",
        fixed={"damping.alpha": 1.0},
        free=(Free("damping.A_pos", start=0.08), *RELEASE),
        ties={"damping.A_neg": "0.5 * damping.A_pos"},
        uncertainty=QUICK,
    )
    truth = NOMINAL_POWER_LAW.replace({"damping.alpha": 1.0, "damping.A_neg": 0.043})
    found = _fit(truth, settings, 2)
    assert [(one.name, one.record) for one in found.derived] == [("damping.A_neg", "")]
    fitted = fitted_joystick(found, NOMINAL_POWER_LAW)
    assert fitted.tables == ("damping.power-law",)
    assert fitted.joystick.to_names()["damping.alpha"] == 1.0
    error = found.error("damping.A_pos")
    assert fitted.uncertainties == {
        "damping.power-law.A_pos": rounded_error(error),
        "damping.power-law.A_neg": rounded_error(0.5 * error),
    }


def test_open_values_have_no_uncertainty(fmus_by_name: Path) -> None:
    """M and h act by their product only."""
    settings = FitSettings(
        fmu="Joystick", free=(Free("m"), Free("h"), Free("damping.C"), *RELEASE), uncertainty=QUICK
    )
    fitted = fitted_joystick(_fit(NOMINAL, settings), NOMINAL)
    assert set(fitted.uncertainties) == {"damping.constant.C"}
    assert fitted.tables == ("body", "damping.constant")


def test_a_joystick_has_one_value_for_all_records(fmus_by_name: Path) -> None:
    with pytest.raises(FitError, match=r"damping\.C: each record has a value of its own"):
        require_joystick_in(FitSettings(fmu="Joystick", free=(Free("damping.C", per_record=True),)))
    with pytest.raises(FitError, match="none of its parameters is fitted"):
        require_joystick_in(FitSettings(fmu="Joystick", free=RELEASE))
    tied = FitSettings(
        fmu="Joystick",
        free=(Free("c", start=0.1, per_record=True), *RELEASE),
        ties={"damping.C": "0.5 * c"},
        uncertainty=QUICK,
    )
    found = _fit(NOMINAL, tied, 2)
    assert [one.record for one in found.derived] == ["run 0", "run 1"]
    with pytest.raises(FitError, match=r"damping\.C: each record has a value of its own"):
        fitted_joystick(found, NOMINAL)
