"""Plateaus of the energy, jumps of the damping function, and constants that stand for it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, Trajectory, damping_coefficient, simulate
from pyjoystick.reports import (
    damping_jumps,
    equivalent_damping,
    mean_damping,
    plateaus,
    plot_damping_function,
    plot_energy,
)

TIME = np.arange(1501) * 0.5e-3
RELEASE = math.radians(-20.0)


@pytest.fixture(scope="module")
def power_law() -> Trajectory:
    return simulate(NOMINAL_POWER_LAW, time=TIME, theta_start=RELEASE)


@pytest.fixture(scope="module")
def constant() -> Trajectory:
    return simulate(NOMINAL, time=TIME, theta_start=RELEASE)


@pytest.fixture(scope="module", params=["power_law", "constant"])
def run(request: pytest.FixtureRequest) -> Trajectory:
    found: Trajectory = request.getfixturevalue(request.param)
    return found


def test_a_plateau_lies_around_each_turning_point_and_takes_little(run: Trajectory) -> None:
    rests = plateaus(run)
    turns = [point.time for point in run.turning_points][: len(rests)]
    assert len(rests) == len(run.turning_points) - 1
    assert rests["time"].to_numpy() == pytest.approx(turns, abs=0.5e-3)
    assert (rests["start"] < rests["time"]).all()
    assert (rests["end"] > rests["time"]).all()
    assert (rests["lost"] >= 0.0).all()
    assert (rests["lost"] < 0.05 * rests["swing_lost"]).all()
    # What the swings take is what is gone.
    assert rests["swing_lost"].sum() == pytest.approx(run.E[0] - rests["energy"].iloc[-1], rel=1e-12)


def test_the_power_on_a_plateau_is_below_a_part_of_that_beside_it(constant: Trajectory) -> None:
    rests = plateaus(constant)
    power = constant.C * constant.omega**2
    for row in rests.itertuples():
        inside = (constant.time >= row.start) & (constant.time <= row.end)
        assert np.max(power[inside]) < 0.05 * np.max(power)


def test_a_constant_does_not_jump_and_is_its_own_mean(constant: Trajectory) -> None:
    assert damping_jumps(constant)["jump"].max() == 0.0
    assert mean_damping(constant) == pytest.approx(0.045, rel=1e-14)
    # The trapezoid rule over the kinks of omega is what limits this.
    assert equivalent_damping(constant) == pytest.approx(0.045, rel=1e-5)


def test_every_zero_is_a_row(power_law: Trajectory) -> None:
    jumps = damping_jumps(power_law)
    assert jumps["time"].is_monotonic_increasing
    counted = jumps["zero"].value_counts()
    assert counted["omega"] == len(power_law.turning_points)
    assert counted["theta"] == sum(event.kind == "theta = 0" for event in power_law.events)
    assert jumps["amplitude"].iloc[0] == pytest.approx(abs(RELEASE))
    assert jumps.loc[jumps["zero"] == "omega", "amplitude"].to_numpy() == pytest.approx(
        [abs(point.theta) for point in power_law.turning_points]
    )


def test_the_jump_is_that_between_the_samples_around_the_middle(power_law: Trajectory) -> None:
    first = damping_jumps(power_law).iloc[0]
    at = int(np.searchsorted(power_law.time, first["time"]))
    sides = damping_coefficient(
        NOMINAL_POWER_LAW.damping, power_law.theta[at - 1 : at + 1], power_law.omega[at - 1 : at + 1]
    )
    assert first["jump"] == pytest.approx(abs(sides[1] - sides[0]), rel=1e-12)


def test_the_equivalent_constant_takes_the_energy_that_is_gone() -> None:
    fine = simulate(NOMINAL_POWER_LAW, time=np.linspace(0.0, 0.3, 60001), theta_start=RELEASE)
    mean_square = np.trapezoid(fine.omega**2, fine.time)
    found = np.trapezoid(fine.C * fine.omega**2, fine.time) / mean_square
    # The trapezoid rule is what limits this, at the spikes of C.
    assert equivalent_damping(fine) == pytest.approx(found, rel=1e-3)


def test_the_figures_have_units_on_their_axes(power_law: Trajectory) -> None:
    figures = [
        plot_energy(power_law, plateaus(power_law), title="Title"),
        plot_damping_function(power_law, constant=0.045, equivalent=0.06, title="Title"),
    ]
    labels = [axes.get_ylabel() for figure in figures for axes in figure.axes]
    assert labels == ["Energy (mJ)", "Power lost (W)", "C (N m s/rad)", "Displacement (deg)"]
    assert all("(s)" in figure.axes[1].get_xlabel() for figure in figures)


def test_without_damping_there_is_no_plateau() -> None:
    run = simulate(NOMINAL.replace({"damping.C": 0.0}), time=TIME, theta_start=RELEASE)
    assert plateaus(run).empty
    assert "start" in plateaus(run)


def test_a_run_that_does_not_turn_has_no_plateau() -> None:
    short = simulate(NOMINAL, time=[0.0, 0.01, 0.02], theta_start=RELEASE)
    assert plateaus(short).empty
