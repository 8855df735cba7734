from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from pyjoystick.model import BACKWARD_TABLE, FORWARD_TABLE, ActuatorAssembly, RestrainedSpring, SegmentTable
from pyjoystick.support import ParameterError


def spring(**changes: Any) -> RestrainedSpring:
    return RestrainedSpring(**({"k_s": 2625.0, "k_h": 427375.0, "F_0": 52.78, "x_0": 75e-6} | changes))


@pytest.mark.parametrize("name", ["k_s", "k_h", "F_0", "x_0"])
@pytest.mark.parametrize("value", [-1.0, math.nan, math.inf])
def test_a_spring_refuses_what_no_spring_has(name: str, value: float) -> None:
    with pytest.raises(ParameterError, match=f"^{name} = {value}: must be a finite number"):
        spring(**{name: value})


@pytest.mark.parametrize("name", ["k_s", "k_h"])
def test_a_stiffness_is_above_zero(name: str) -> None:
    with pytest.raises(ParameterError, match=f"^{name} = "):
        spring(**{name: 0.0})


def test_no_preload_and_no_clearance_are_allowed() -> None:
    assert spring(F_0=0.0, x_0=0.0).x_release == 0.0


def test_the_restraint_goes_slack_where_its_unloading_equals_the_preload() -> None:
    given = spring()
    assert given.k_h * (given.x_release - given.x_0) == pytest.approx(given.F_0, rel=1e-14)


@pytest.mark.parametrize("table", [FORWARD_TABLE, BACKWARD_TABLE])
def test_the_two_forms_of_an_assembly_convert_into_each_other(table: SegmentTable) -> None:
    back = ActuatorAssembly.from_table(table.x, table.k).to_table()
    np.testing.assert_allclose(back.x, table.x, rtol=1e-14)
    np.testing.assert_allclose(back.k, table.k, rtol=1e-14)


def test_kinks_may_coincide() -> None:
    k = (430e3, 2625.0, 1028e3, 5600.0)
    touching = ActuatorAssembly.from_table((75e-6, 198.5e-6, 198.5e-6, 210e-6), k)
    assert touching.kinks == tuple(sorted(touching.kinks))
    unloaded = ActuatorAssembly.from_table((0.0, 0.0, 3e-3, 3e-3), k)
    assert unloaded.kinks == (0.0, 0.0, 3e-3, 3e-3)
    assert unloaded.return_spring.F_0 == unloaded.balance_spring.F_0 == 0.0


def test_a_balance_spring_that_engages_too_early_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"^balanceSpring\.x_0 = 0\.0001: must be at least 0\.000198"):
        ActuatorAssembly(return_spring=spring(), balance_spring=spring(x_0=1e-4))


@pytest.mark.parametrize(
    ("x", "k", "message"),
    [
        (
            (0.0, 2e-4, 1e-4, 3e-3),
            (430e3, 2625.0, 1028e3, 5600.0),
            r"x\[2\] = 0\.0001: must be at least x\[1\]",
        ),
        ((-1e-5, 2e-4, 3e-3, 4e-3), (430e3, 2625.0, 1028e3, 5600.0), r"x\[0\] = -1e-05"),
        ((0.0, 2e-4, 3e-3, 4e-3), (430e3, 0.0, 1028e3, 5600.0), r"k\[1\] = 0\.0"),
        ((0.0, 2e-4, 3e-3, 4e-3), (2e3, 2625.0, 1028e3, 5600.0), r"k\[0\] = 2000\.0: must be above k\[1\]"),
        ((0.0, 2e-4, 3e-3, 4e-3), (430e3, 2625.0, 1028e3, 2e3), r"k\[3\] = 2000\.0: must be above k\[1\]"),
        ((0.0, 2e-4, 3e-3, 4e-3), (430e3, 2625.0, 5e3, 5600.0), r"k\[2\] = 5000\.0: must be above k\[3\]"),
        ((0.0, 2e-4, 3e-3), (430e3, 2625.0, 1028e3), "four travels"),
        ((0.0, 2e-4, 3e-3), (430e3, 2625.0), "as many stiffnesses as travels"),
        ((), (), "at least one"),
        ((0.0, math.nan, 3e-3, 4e-3), (430e3, 2625.0, 1028e3, 5600.0), r"x\[1\] = nan"),
    ],
)
def test_a_curve_that_no_assembly_has_is_refused(
    x: tuple[float, ...], k: tuple[float, ...], message: str
) -> None:
    with pytest.raises(ParameterError, match=message):
        ActuatorAssembly.from_table(x, k)
