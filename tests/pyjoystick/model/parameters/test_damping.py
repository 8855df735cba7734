from __future__ import annotations

import dataclasses
import math

import pytest

from pyjoystick.model import NOMINAL_POWER_LAW, ConstantDamping, PowerLawDamping
from pyjoystick.support import ParameterError


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
