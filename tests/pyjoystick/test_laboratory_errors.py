"""What single uncertainties make of a run and of a fit."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.laboratory_errors import (
    Contribution,
    contribution_table,
    curve_axes,
    noise_contribution,
    refit,
    run_contribution,
    with_fitted,
)
from pyjoystick.load_curve import fit_load_curve
from pyjoystick.measurement_errors import mean_period
from pyjoystick.parameters import FORWARD_TABLE, NOMINAL
from pyjoystick.reference import simulate
from pyjoystick.synthetic_records import synthetic_record
from tests.pyjoystick.load_curve.machine import curve

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


def test_a_wrong_mass_and_a_wrong_scale_reach_the_fitted_values(fmus_by_name: object) -> None:
    random = np.random.default_rng(3)
    records = [synthetic_record(NOMINAL, release_angle=RELEASE, random=random, noise=1e-3)]
    with Fmu("Joystick") as fmu:
        found = refit(records, NOMINAL, fmu)
        stiffer = {f"{side}.returnSpring.F_0": 1.01 for side in ("forward", "backward")}
        values = NOMINAL.to_names()
        forces = NOMINAL.replace({name: factor * values[name] for name, factor in stiffer.items()})
        moved = with_fitted(Contribution("forces"), found, [refit(records, forces, fmu)])
        assert found.value("J") == pytest.approx(NOMINAL.J, rel=3e-3)
        # All forces grow together with inertia and damping; the preload is most of the force.
        assert 0.005 < moved.J < 0.01
        assert 0.005 < moved.C < 0.01
        noise = noise_contribution("fit", NOMINAL, found, release_angle=RELEASE)
    assert pytest.approx(found.error("J") / found.value("J")) == noise.J
    assert 0.0 < noise.theta < 1e-3


def test_the_table_leaves_out_what_has_no_part_and_adds_up() -> None:
    rows = [Contribution("a", theta=math.radians(0.5), J=0.003), Contribution("b", J=0.004, C=0.01)]
    table = contribution_table(rows).splitlines()
    cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table[2:]]
    assert cells[0] == ["a", "0.500", "", "", "0.300", ""]
    assert cells[-1] == ["all", "", "", "", "0.500", "1.000"]
