"""The parameters of a joystick, its damping laws, and their names."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, ConstantDamping, JoystickParameters, PowerLawDamping
from pyjoystick.support import ParameterError, UnknownParameterError


@pytest.mark.parametrize("value", [-0.01, math.nan, math.inf])
def test_a_constant_coefficient_out_of_range_is_refused(value: float) -> None:
    with pytest.raises(ParameterError, match=r"^C = "):
        ConstantDamping(C=value)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("alpha", -0.1),
        ("alpha", 1.1),
        ("A_pos", -1.0),
        ("A_neg", math.nan),
        ("B", -1.0),
        ("n_pos", math.inf),
        ("n_neg", math.nan),
        ("m", math.inf),
        ("eps_theta", 0.0),
        ("eps_omega", -1e-3),
    ],
)
def test_a_power_law_value_out_of_range_is_refused(name: str, value: float) -> None:
    with pytest.raises(ParameterError, match=f"^{name} = "):
        dataclasses.replace(NOMINAL_POWER_LAW.damping, **{name: value})


def test_the_weights_add_up_to_one() -> None:
    law = NOMINAL_POWER_LAW.replace({"damping.alpha": 0.7}).damping
    assert isinstance(law, PowerLawDamping)
    assert law.alpha + law.beta == 1.0
    assert dataclasses.replace(law, alpha=1).beta == 0.0


def test_a_law_is_frozen() -> None:
    law = ConstantDamping(C=0.045)
    with pytest.raises(AttributeError):
        law.C = 0.1  # type: ignore[misc]


SPRING_NAMES = {
    f"{side}.{spring}.{name}"
    for side in ("forward", "backward")
    for spring in ("returnSpring", "balanceSpring")
    for name in ("k_s", "k_h", "F_0", "x_0")
}
BODY_NAMES = {"J", "m", "h", "g", "a", "b"}
POWER_LAW_NAMES = {"alpha", "A_pos", "n_pos", "A_neg", "n_neg", "B", "m", "eps_theta", "eps_omega"}


def test_the_names_are_those_of_the_fmus() -> None:
    assert set(NOMINAL.to_names()) == BODY_NAMES | SPRING_NAMES | {"damping.C"}
    power_law = {f"damping.{name}" for name in POWER_LAW_NAMES}
    assert set(NOMINAL_POWER_LAW.to_names()) == BODY_NAMES | SPRING_NAMES | power_law


@pytest.mark.parametrize("parameters", [NOMINAL, NOMINAL_POWER_LAW])
def test_each_name_changes_its_own_value_only(parameters: JoystickParameters) -> None:
    names = parameters.to_names()
    for name, value in names.items():
        changed = parameters.replace({name: 0.999 * value})
        assert changed.to_names() == names | {name: 0.999 * value}


@settings(max_examples=50, derandomize=True, deadline=None)
@given(st.dictionaries(st.sampled_from(sorted(NOMINAL.to_names())), st.floats(0.8, 1.2)))
def test_names_and_values_go_round(factors: dict[str, float]) -> None:
    changes = {name: factor * NOMINAL.to_names()[name] for name, factor in factors.items()}
    changed = NOMINAL.replace(changes)
    assert changed.to_names() == NOMINAL.to_names() | changes
    assert NOMINAL.replace(changed.to_names()) == changed


def test_a_change_of_two_values_is_judged_together() -> None:
    later = {"forward.returnSpring.x_0": 4e-3, "forward.balanceSpring.x_0": 6e-3}
    with pytest.raises(ParameterError, match=r"^forward\.balanceSpring\.x_0 = 0\.002932: must be at least"):
        NOMINAL.replace({"forward.returnSpring.x_0": 4e-3})
    assert NOMINAL.replace(later).forward.kinks[2] == 6e-3


@pytest.mark.parametrize("name", sorted(NOMINAL_POWER_LAW.to_names()))
@pytest.mark.parametrize("value", [math.nan, math.inf, "text"])
def test_no_name_takes_what_is_no_finite_number(name: str, value: Any) -> None:
    with pytest.raises(ParameterError) as caught:
        NOMINAL_POWER_LAW.replace({name: value})
    assert caught.value.field == name
    assert caught.value.value is value


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("J", 0.0),
        ("m", -0.1),
        ("h", -0.1),
        ("a", 0.0),
        ("b", -1e-3),
        ("b", 0.02398),
        ("forward.returnSpring.k_s", 0.0),
        ("backward.balanceSpring.k_h", -1.0),
        ("backward.returnSpring.F_0", -1.0),
        ("forward.returnSpring.x_0", -1e-9),
        ("damping.C", -1e-9),
    ],
)
def test_impossible_values_are_refused_by_their_full_name(name: str, value: float) -> None:
    with pytest.raises(ParameterError) as caught:
        NOMINAL.replace({name: value})
    assert caught.value.field == name


def test_unknown_names_are_refused() -> None:
    with pytest.raises(UnknownParameterError, match=r"did you mean damping\.C"):
        NOMINAL.replace({"damping.c": 0.1})
    with pytest.raises(UnknownParameterError, match=r"damping\.alpha"):
        NOMINAL.replace({"damping.alpha": 0.1})
    with pytest.raises(UnknownParameterError, match="theta_start"):
        NOMINAL.replace({"theta_start": 0.1})


def test_beta_is_calculated_and_cannot_be_set() -> None:
    with pytest.raises(ParameterError, match=r"^damping\.beta = 0\.5: must be left out"):
        NOMINAL_POWER_LAW.replace({"damping.beta": 0.5})


def test_construction_checks_too() -> None:
    with pytest.raises(ParameterError, match=r"^J = -1: must be a finite number above 0 kg\.m2$"):
        dataclasses.replace(NOMINAL, J=-1)
