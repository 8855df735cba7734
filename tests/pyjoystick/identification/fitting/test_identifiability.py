"""What the data cannot tell apart is said."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.identification import RELEASE, FitSettings, Free, Search, Uncertainty, fit
from pyjoystick.identification.fitting.identifiability import identifiability
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from tests.pyjoystick.identification.fitting.made import releases


def test_a_sum_is_named() -> None:
    time = np.linspace(0.0, 1.0, 50)
    jacobian = np.column_stack((time, time, time**2))
    known = identifiability(jacobian, np.array([2.0, 1.0, 5.0]), np.ones(3), ("a", "b", "c"), np.zeros(3))
    assert known.rank == 2
    assert known.undetermined.tolist() == [True, True, False]
    # a and b only act by their sum: one percent of b is half a percent of a.
    assert known.sentences == ("b +1 %, a -0.5 % together change nothing that was measured: fix one of them",)


def test_two_separate_combinations_are_named_separately() -> None:
    time = np.linspace(0.0, 1.0, 50)
    jacobian = np.column_stack((time, time, time**2, -(time**2), np.zeros(50)))
    known = identifiability(jacobian, np.ones(5), np.ones(5), tuple("abcde"), np.zeros(5))
    assert known.rank == 2
    assert any("a" in one and "b" in one and "c " not in one for one in known.sentences)
    assert any("c +1 %" in one and "d +1 %" in one and "a " not in one for one in known.sentences)
    assert "e has no influence on what was measured" in known.sentences


def _fit(fmu: str, names: list[str], fixed: dict[str, float] | None = None) -> FitSettings:
    return FitSettings(
        fmu=fmu,
        free=(*(Free(name) for name in names), *RELEASE),
        fixed=fixed or {},
        # A search along an open valley has no end of its own.
        search=Search(evaluations=15),
        uncertainty=Uncertainty(profiles=()),
    )


def test_only_ratios_to_the_inertia_are_determined(fmus_by_name: Path) -> None:
    """M and h act by their product: one of the two can be had, not both."""
    found = fit(releases(NOMINAL), _fit("Joystick", ["m", "h", "damping.C"]))
    assert not found.trusted
    assert found.identifiability.deficient
    assert any("m +1 %, h -1 %" in one or "h +1 %, m -1 %" in one for one in found.identifiability.sentences)
    assert np.isinf(found.error("m"))
    assert found.error("damping.C") < 1e-6


def test_the_weight_of_the_power_law_is_not_determined(fmus_by_name: Path) -> None:
    names = ["alpha", "A_pos", "A_neg", "B"]
    found = fit(releases(NOMINAL_POWER_LAW), _fit("JoystickPowerLaw", [f"damping.{name}" for name in names]))
    (sentence,) = found.identifiability.sentences
    assert all(f"damping.{name}" in sentence for name in names)


def test_velocity_term_without_weight(fmus_by_name: Path) -> None:
    joystick = NOMINAL_POWER_LAW.replace({"damping.alpha": 1.0})
    settings = _fit("JoystickPowerLaw", ["damping.A_pos", "damping.B", "damping.m"], {"damping.alpha": 1.0})
    found = fit(releases(joystick), settings)
    assert set(found.identifiability.sentences) == {
        "damping.B has no influence on what was measured",
        "damping.m has no influence on what was measured",
    }
    assert found.value("damping.A_pos") == pytest.approx(0.086, rel=1e-6)
