"""Parameters are recovered from exact records of the reference, to six digits if they are determined."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from pyjoystick.identification import RELEASE, FitSettings, Free, Uncertainty, fit
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters
from tests.pyjoystick.identification.fitting.made import releases

#: The FMU's integration is then exact to 1e-11 rad, which the weakest combinations below need.
EXACT = 1e-10
NO_PROFILES = Uncertainty(profiles=())
SIX_DIGITS = 1e-6


def _settings(fmu: str, starts: dict[str, float], fixed: dict[str, float] | None = None) -> FitSettings:
    free = (*(Free(name, start=start) for name, start in starts.items()), *RELEASE)
    return FitSettings(fmu=fmu, free=free, fixed=fixed or {}, tolerance=EXACT, uncertainty=NO_PROFILES)


@pytest.mark.parametrize("rate", [60.0, 600.0])
@pytest.mark.parametrize(
    "factors",
    [
        {"damping.C": 1.4},
        {"damping.C": 1.2, "J": 0.95},
        {"damping.C": 0.8, "J": 1.05, "h": 1.1},
        {"forward.returnSpring.F_0": 1.03, "backward.returnSpring.F_0": 0.97},
        {"forward.returnSpring.k_s": 1.1, "backward.returnSpring.k_s": 0.9, "damping.C": 1.1},
        {"forward.balanceSpring.k_s": 1.1, "backward.balanceSpring.F_0": 0.9, "damping.C": 1.1},
        {"forward.balanceSpring.x_0": 1.1, "forward.returnSpring.k_h": 0.9, "a": 1.02, "b": 0.9},
        {
            "J": 1.02,
            "damping.C": 0.9,
            "forward.returnSpring.F_0": 1.02,
            "backward.returnSpring.F_0": 0.98,
            "forward.returnSpring.k_s": 1.02,
            "backward.returnSpring.k_s": 0.98,
        },
        {"forward.returnSpring.x_0": 1.2, "backward.returnSpring.x_0": 0.8, "damping.C": 1.1},
    ],
    ids=lambda factors: "+".join(factors),
)
def test_parameters_of_the_joystick(fmus_by_name: Path, factors: dict[str, float], rate: float) -> None:
    truth = NOMINAL.to_names()
    starts = {name: factor * truth[name] for name, factor in factors.items()}
    found = fit(releases(NOMINAL, rate=rate), _settings("Joystick", starts))
    assert found.trusted, found.checks
    for name in factors:
        assert found.value(name) == pytest.approx(truth[name], rel=SIX_DIGITS)
    assert found.value("release_time [run 0]") == pytest.approx(0.1, rel=SIX_DIGITS)
    assert found.value("theta_start [run 0]") == pytest.approx(-0.3490658503988659, rel=SIX_DIGITS)


@pytest.mark.parametrize("rate", [60.0, 150.0])
def test_power_law_but_for_its_weight(fmus_by_name: Path, rate: float) -> None:
    """Six of the seven parameters; alpha acts only in products with them."""
    truth = {name: value for name, value in NOMINAL_POWER_LAW.to_names().items() if "damping" in name}
    wanted = [name for name in truth if not name.endswith(("alpha", "eps_theta", "eps_omega"))]
    starts = {name: 1.03 * truth[name] for name in wanted}
    settings = _settings("JoystickPowerLaw", starts, {"damping.alpha": 0.9})
    found = fit(releases(NOMINAL_POWER_LAW, 2, rate=rate), settings)
    for name in wanted:
        assert found.value(name) == pytest.approx(truth[name], rel=SIX_DIGITS), name


def test_ties_and_auxiliary_parameters(fmus_by_name: Path) -> None:
    """A fixed ratio, and a coefficient at 0.1 rad in place of one at 1 rad."""
    joystick = NOMINAL_POWER_LAW.replace(
        {"damping.alpha": 1.0, "damping.A_neg": 0.043, "damping.n_neg": 0.084}
    )
    settings = FitSettings(
        fmu="JoystickPowerLaw",
        fixed={"damping.alpha": 1.0},
        free=(Free("C_pos", start=0.06), Free("damping.n_pos", start=0.0), *RELEASE),
        ties={
            "damping.A_pos": "C_pos * 0.1**(-damping.n_pos)",
            "damping.A_neg": "0.5 * damping.A_pos",
            "damping.n_neg": "damping.n_pos",
        },
        tolerance=EXACT,
        uncertainty=NO_PROFILES,
    )
    found = fit(releases(joystick), settings)
    derived = {one.name: one.value for one in found.derived}
    assert found.value("C_pos") == pytest.approx(0.086 * 0.1**0.084, rel=SIX_DIGITS)
    assert derived["damping.A_pos"] == pytest.approx(0.086, rel=SIX_DIGITS)
    assert derived["damping.A_neg"] == pytest.approx(0.043, rel=SIX_DIGITS)
    assert derived["damping.n_neg"] == pytest.approx(0.084, rel=SIX_DIGITS)


def _constant(**changes: object) -> FitSettings:
    return dataclasses.replace(_settings("Joystick", {"damping.C": 0.06}), **changes)  # type: ignore[arg-type]


def test_damping_of_records_that_begin_at_the_release(fmus_by_name: Path) -> None:
    joystick: JoystickParameters = NOMINAL.replace({"damping.C": 0.052})
    record = releases(joystick)[0].between(0.12)
    found = fit([record], _constant())
    assert found.value("damping.C") == pytest.approx(0.052, rel=SIX_DIGITS)
    assert found.value("release_time [run 0]") == pytest.approx(0.1, rel=SIX_DIGITS)


def test_peaks_compared_as_the_paper_does(fmus_by_name: Path) -> None:
    """The measured peaks come from a spline, which is good to a percent or so, and so is the damping."""
    found = fit(releases(NOMINAL, 2), _constant(comparison="peaks"))
    assert found.trusted, found.checks
    assert found.value("damping.C") == pytest.approx(0.045, rel=0.01)
