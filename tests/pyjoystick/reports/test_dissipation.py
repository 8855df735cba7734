"""Plateaus of the energy, jumps of the damping function, and equivalent constants."""

from __future__ import annotations

import math
from typing import cast

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, PowerLawDamping, Trajectory, simulate
from pyjoystick.reports import (
    damping_jumps,
    equivalent_damping,
    mean_damping,
    plateaus,
    plot_damping_function,
    plot_energy,
    sampled_closely,
)

DURATION = 0.75
RELEASE = math.radians(-20.0)


@pytest.fixture(scope="module")
def power_law() -> Trajectory:
    return sampled_closely(NOMINAL_POWER_LAW, release_angle=RELEASE, duration=DURATION)


@pytest.fixture(scope="module")
def constant() -> Trajectory:
    return sampled_closely(NOMINAL, release_angle=RELEASE, duration=DURATION)


@pytest.fixture(scope="module", params=["power_law", "constant"])
def run(request: pytest.FixtureRequest) -> Trajectory:
    found: Trajectory = request.getfixturevalue(request.param)
    return found


def test_a_plateau_lies_around_each_turning_point_and_takes_little(run: Trajectory) -> None:
    rests = plateaus(run)
    turns = [point.time for point in run.turning_points][: len(rests)]
    assert len(rests) == len(run.turning_points) - 1
    assert rests["time"].to_numpy() == pytest.approx(turns, abs=1e-8)
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


def test_the_change_in_the_middle_is_that_of_the_limits_of_eq_11(power_law: Trajectory) -> None:
    """At theta = 0 the terms in theta are A*eps^n on either side, and the velocity hardly changes."""
    law = cast("PowerLawDamping", NOMINAL_POWER_LAW.damping)
    limits = [
        law.alpha * coefficient * law.eps_theta**exponent
        for coefficient, exponent in ((law.A_pos, law.n_pos), (law.A_neg, law.n_neg))
    ]
    jumps = damping_jumps(power_law)
    found = jumps.loc[jumps["zero"] == "theta", "jump"].to_numpy()
    assert found == pytest.approx(limits[1] - limits[0], rel=1e-4)


def test_the_change_where_it_turns_is_the_peak_of_the_velocity_term(power_law: Trajectory) -> None:
    law = cast("PowerLawDamping", NOMINAL_POWER_LAW.damping)
    turn = power_law.turning_points[0]
    speed = abs(np.interp(turn.time + 1e-3, power_law.time, power_law.omega))
    expected = law.beta * law.B * (law.eps_omega**law.m - np.hypot(speed, law.eps_omega) ** law.m)
    found = damping_jumps(power_law)
    first = found.loc[found["zero"] == "omega", "jump"].iloc[0]
    assert first == pytest.approx(expected, rel=0.02)  # the term in theta changes too, by 1 %


def test_samples_are_close_to_events_alone(power_law: Trajectory) -> None:
    steps = np.diff(power_law.time)
    assert steps.max() == pytest.approx(1e-4)
    for event in (*power_law.events, *power_law.turning_points):
        assert np.abs(power_law.time - event.time).min() < 1e-9
    even = sampled_closely(NOMINAL, release_angle=RELEASE, duration=1e-3)
    assert len(even.time) == 11


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
    run = sampled_closely(NOMINAL.replace({"damping.C": 0.0}), release_angle=RELEASE, duration=DURATION)
    assert plateaus(run).empty
    assert "start" in plateaus(run)


def test_a_run_that_does_not_turn_has_no_plateau() -> None:
    short = simulate(NOMINAL, time=[0.0, 0.01, 0.02], theta_start=RELEASE)
    assert plateaus(short).empty


def test_a_turning_point_lies_between_samples(constant: Trajectory) -> None:
    """Sampled every 0.5 ms, the table is that of the run that is sampled ever more closely."""
    time = np.linspace(0.0, DURATION, 1501)
    coarse, close = plateaus(simulate(NOMINAL, time=time, theta_start=RELEASE)), plateaus(constant)
    for name, allowed in (("time", 1e-8), ("theta", 1e-8)):
        assert coarse[name].to_numpy() == pytest.approx(close[name].to_numpy(), abs=allowed)
    # Off by the power at the nearest sample, C*omega^2 with alpha up to 700 rad/s^2, over 0.25 ms.
    for name in ("energy", "swing_lost"):
        assert coarse[name].to_numpy() == pytest.approx(close[name].to_numpy(), abs=2e-7)
