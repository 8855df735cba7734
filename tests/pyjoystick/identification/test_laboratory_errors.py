"""The effect of single uncertainties on a run and on a fit."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    Bench,
    Contribution,
    contribution_table,
    fit_contributions,
    scaled_forces,
)
from pyjoystick.identification.fitting.fit import fitted_values
from pyjoystick.identification.laboratory_errors import curve_axes, run_contribution, settings_of_refit
from pyjoystick.laboratory import fit_load_curve, mean_period, synthetic_record
from pyjoystick.model import FORWARD_TABLE, NOMINAL, JoystickParameters, simulate
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray
from tests.pyjoystick.laboratory.load_curve.machine import curve

RELEASE = math.radians(-20.0)


def test_the_mean_period_is_that_between_passages_of_zero() -> None:
    time = np.arange(0.0, 3.0, 1e-3)
    assert mean_period(time, -np.cos(2.0 * np.pi * time / 0.7)) == pytest.approx(0.7, rel=1e-6)


def test_axes_of_a_curve_span_its_covariance() -> None:
    fit = fit_load_curve(curve(FORWARD_TABLE, 1))
    moved = curve_axes(NOMINAL, "forward", fit)
    tables = [one.forward.to_table() for one in moved]
    steps = np.array([(*one.x, *one.k) for one in tables]) - np.array((*fit.table.x, *fit.table.k))
    errors = np.concatenate((fit.x_errors, fit.k_errors))
    np.testing.assert_allclose(
        steps.T @ steps / np.outer(errors, errors),
        fit.covariance[:8, :8] / np.outer(errors, errors),
        atol=1e-5,
    )
    assert all(one.backward == NOMINAL.backward for one in moved)


def test_several_axes_add_up_by_their_squares() -> None:
    undamped = NOMINAL.replace({"damping.C": 0.0})
    moved = [undamped.replace({"J": NOMINAL.J * 1.001})]
    one = run_contribution("J", undamped, moved, release_angle=RELEASE)
    two = run_contribution("J", undamped, 2 * moved, release_angle=RELEASE)
    assert two.theta == pytest.approx(math.sqrt(2.0) * one.theta, rel=1e-12)
    # Without damping time is stretched by the root of J, and nothing else happens.
    assert one.period == pytest.approx(5e-4, rel=0.02)
    run, other = (simulate(j, time=np.arange(901) / 600.0, theta_start=RELEASE) for j in (undamped, *moved))
    assert one.theta == pytest.approx(float(np.sqrt(np.mean((run.theta - other.theta) ** 2))), rel=1e-9)


@pytest.mark.usefixtures("fmus_by_name")
def test_what_is_measured_before_reaches_the_fitted_values() -> None:
    records = [_record(NOMINAL, noise=2e-4)]
    errors = {"m": 0.002, "J": 1e-4}
    bench = Bench(joystick=NOMINAL, curves={}, uncertainties=errors, scale=2e-3, time_base=1e-3)
    with Fmu("Joystick") as fmu:
        found, contributions = fit_contributions(records, bench, fmu, release_angle=RELEASE)

        # A joystick that is heavier than was measured, and an angle that is scaled, mislead the fit as much.
        def refit(record: Record) -> dict[str, float]:
            return fitted_values([record], settings_of_refit(NOMINAL), fmu)

        misled = refit(_record(NOMINAL.replace({"m": NOMINAL.m + 0.002})))
        exact = _record(NOMINAL)
        scaled = refit(dataclasses.replace(exact, theta=1.002 * exact.theta))
        slower = refit(dataclasses.replace(exact, time=1.001 * exact.time))
    scale, clock, zero, mass, inertia, noise = contributions
    assert pytest.approx(_off(slower), rel=0.05) == (clock.J, clock.C)
    # Time that is longer by a part makes J larger by twice that, and C by as much: J/t2 and C/t stay.
    assert pytest.approx((2e-3, 1e-3), rel=0.05) == (clock.J, clock.C)
    assert pytest.approx(_off(misled), rel=0.05) == (mass.J, mass.C)
    assert pytest.approx(_off(scaled), rel=0.05) == (scale.J, scale.C)
    joystick = NOMINAL.replace(found.shared())
    assert scale.theta == pytest.approx(2e-3 * _rms(_theta(joystick)), rel=1e-9)
    assert zero.theta == pytest.approx(2e-4 / math.sqrt(15.0), rel=0.2)
    # J is fitted: what was measured of it before says nothing more, but a run with it would be off.
    assert math.isnan(inertia.J)
    assert inertia.period > 3e-3
    # The errors of J and C and their correlation, propagated to the angle by its derivatives.
    slopes = np.array([_slope(joystick, name) for name in ("J", "damping.C")])
    variance = np.einsum("it,ij,jt->t", slopes, found.standard_errors.covariance[:2, :2], slopes)
    assert noise.theta == pytest.approx(math.sqrt(float(np.mean(variance))), rel=1e-3)
    assert pytest.approx(found.error("J") / found.value("J")) == noise.J


@pytest.mark.usefixtures("fmus_by_name")
def test_a_load_cell_that_shows_too_much_misleads_the_fit_of_j() -> None:
    """Springs, J and C that are larger by the same part give the same motion, but for the weight."""
    bench = Bench(joystick=NOMINAL, curves={}, uncertainties={}, force_scale=5e-3)
    with Fmu("Joystick") as fmu:
        _, contributions = fit_contributions(
            [_record(NOMINAL, noise=2e-4)], bench, fmu, release_angle=RELEASE
        )
        weaker = scaled_forces(NOMINAL, 1.0 / 1.005)
        misled = fitted_values([_record(weaker)], settings_of_refit(NOMINAL), fmu)
    force = next(one for one in contributions if one.stage == "scale of the force, 0.5 %")
    assert pytest.approx(_off(misled), rel=0.05) == (force.J, force.C)
    # The weight, which the load cell does not measure, is a tenth of the moments.
    assert pytest.approx((5e-3, 5e-3), rel=0.15) == (force.J, force.C)


def _record(joystick: JoystickParameters, noise: float = 1e-7) -> Record:
    random = np.random.default_rng(3)
    return synthetic_record(joystick, release_angle=RELEASE, random=random, noise=noise)


def _off(found: dict[str, float]) -> tuple[float, float]:
    """How far J and C are from those of the paper, in parts of them."""
    true = NOMINAL.to_names()
    inertia, damping = (abs(found[name] / true[name] - 1.0) for name in ("J", "damping.C"))
    return inertia, damping


def _theta(joystick: JoystickParameters) -> FloatArray:
    return simulate(joystick, time=np.arange(901) / 600.0, theta_start=RELEASE).theta


def _slope(joystick: JoystickParameters, name: str) -> FloatArray:
    value = joystick.to_names()[name]
    high, low = (_theta(joystick.replace({name: factor * value})) for factor in (1.0 + 1e-5, 1.0 - 1e-5))
    return (high - low) / (2e-5 * value)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def test_the_table_leaves_out_what_has_no_part_and_adds_up() -> None:
    rows = [Contribution("a", theta=math.radians(0.5), J=0.003), Contribution("b", J=0.004, C=0.01)]
    table = contribution_table(rows).splitlines()
    cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table[2:]]
    assert cells[0] == ["a", "0.500", "", "", "0.300", ""]
    assert cells[-1] == ["all", "", "", "", "0.500", "1.000"]


@pytest.mark.usefixtures("fmus_by_name")
def test_friction_that_is_uncertain_reaches_the_fitted_values() -> None:
    """As much as a plunger that rubs more than was thought misleads the fit."""
    rubbing = NOMINAL.replace({"friction.F_c": 0.3})
    bench = Bench(joystick=rubbing, curves={}, uncertainties={"friction.F_c": 0.03})
    with Fmu(bench.fmu) as fmu:
        _, contributions = fit_contributions(
            [_record(rubbing, noise=2e-4)], bench, fmu, release_angle=RELEASE
        )
        rougher = _record(NOMINAL.replace({"friction.F_c": 0.33}))
        misled = fitted_values([rougher], settings_of_refit(rubbing), fmu)
    friction = next(one for one in contributions if one.stage.startswith("friction.F_c"))
    assert pytest.approx(_off(misled), rel=0.05) == (friction.J, friction.C)
    assert friction.C > 3e-3
