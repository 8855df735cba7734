"""Restrained preloaded springs: the equilibrium of eq. (6), the two forms of an assembly, stored energy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from pyjoystick.model import (
    BACKWARD_TABLE,
    FORWARD_TABLE,
    NOMINAL,
    ActuatorAssembly,
    RestrainedSpring,
    SegmentTable,
    assembly_energy,
    assembly_force,
    spring_energy,
    spring_force,
    table_force,
)
from pyjoystick.support import FloatArray
from tests.pyjoystick.random_parameters import random_cases

SPRING = NOMINAL.forward.return_spring
RANDOM = [case.parameters for case in random_cases(NOMINAL, 25)]
RANDOM_ASSEMBLIES = [assembly for joystick in RANDOM for assembly in (joystick.forward, joystick.backward)]


def around_kinks(assembly: ActuatorAssembly) -> FloatArray:
    """Travels from 0 to 10 mm, with every kink and points from rounding to a thousandth beside it."""
    kinks = np.array(assembly.kinks)
    beside = [kinks * (1.0 + part) for part in (-1e-3, -1e-9, -2e-16, 0.0, 2e-16, 1e-9, 1e-3)]
    return np.sort(np.concatenate([np.linspace(0.0, 0.01, 501), *beside]))


def test_contact_spring_and_restraint_are_in_equilibrium() -> None:
    """Eq. (6): f_spring = f_x + f_restraint; the spring carries k_s*(x_so + delta)."""
    x = around_kinks(NOMINAL.forward)
    compression = np.maximum(x - SPRING.x_0, 0.0)
    in_spring = SPRING.F_0 + SPRING.k_s * compression
    in_restraint = np.maximum(SPRING.F_0 - SPRING.k_h * compression, 0.0)
    np.testing.assert_allclose(spring_force(SPRING, x), in_spring - in_restraint, rtol=1e-12, atol=1e-12)


def test_nothing_is_felt_before_contact_and_a_kink_is_no_jump() -> None:
    assert spring_force(SPRING, [-1.0, 0.0, SPRING.x_0]).tolist() == [0.0, 0.0, 0.0]
    for kink in (SPRING.x_0, SPRING.x_release):
        below, above = spring_force(SPRING, [kink * (1.0 - 1e-12), kink * (1.0 + 1e-12)])
        assert above - below == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize("assembly", RANDOM_ASSEMBLIES)
def test_an_assembly_of_springs_equals_its_table(assembly: ActuatorAssembly) -> None:
    x = around_kinks(assembly)
    by_springs = assembly_force(assembly, x)
    by_table = table_force(assembly.to_table(), x)
    # Where the force has only just left zero its digits are those of x - x_0, so they count against k_0*x_0.
    floor = 1e-12 * assembly.to_table().k[0] * assembly.kinks[0]
    np.testing.assert_allclose(by_springs, by_table, rtol=1e-12, atol=floor)


@pytest.mark.parametrize(
    ("assembly", "table"), [(NOMINAL.forward, FORWARD_TABLE), (NOMINAL.backward, BACKWARD_TABLE)]
)
def test_the_papers_table_gives_the_same_force_as_its_springs(
    assembly: ActuatorAssembly, table: SegmentTable
) -> None:
    x = np.linspace(0.0, 0.01, 1001)
    np.testing.assert_allclose(assembly_force(assembly, x), table_force(table, x), rtol=1e-12, atol=1e-12)


def test_a_table_may_have_any_number_of_segments() -> None:
    one = SegmentTable((1e-3,), (2000.0,))
    np.testing.assert_allclose(table_force(one, [0.0, 1e-3, 3e-3]), [0.0, 0.0, 4.0], rtol=1e-15)
    five = SegmentTable((0.0, 1.0, 2.0, 3.0, 4.0), (1.0, 2.0, 3.0, 4.0, 5.0))
    np.testing.assert_allclose(table_force(five, [-1.0, 0.5, 1.5, 4.0, 5.0]), [0.0, 0.5, 2.0, 10.0, 15.0])


@pytest.mark.parametrize("assembly", [NOMINAL.forward, NOMINAL.backward, *RANDOM_ASSEMBLIES[:4]])
def test_energy_is_the_integral_of_force(assembly: ActuatorAssembly) -> None:
    for x in (0.5 * assembly.kinks[0], *assembly.kinks, 1e-4, 2e-3, 8e-3):
        integral, _ = quad(
            lambda travel: float(assembly_force(assembly, travel)),
            0.0,
            x,
            points=assembly.kinks,
            epsabs=1e-15,
        )
        assert float(assembly_energy(assembly, x)) == pytest.approx(integral, rel=1e-12, abs=1e-17)


def test_a_spring_without_preload_or_restraint_effect_is_linear() -> None:
    plain = RestrainedSpring(k_s=1000.0, k_h=1e6, F_0=0.0, x_0=0.0)
    x = np.linspace(0.0, 0.01, 11)
    np.testing.assert_allclose(spring_force(plain, x), 1000.0 * x, rtol=1e-15)
    np.testing.assert_allclose(spring_energy(plain, x), 500.0 * x**2, rtol=1e-15)


def test_shapes_and_nan_pass_through() -> None:
    x = np.array([[1e-3, np.nan], [2e-3, 0.0]])
    force = assembly_force(NOMINAL.forward, x)
    assert force.shape == (2, 2)
    assert np.isnan(force).tolist() == [[False, True], [False, False]]
    assert np.isnan(table_force(FORWARD_TABLE, x)).tolist() == [[False, True], [False, False]]
