"""Abstract and sections 1, 2 and 3.1: period, peaks and acceleration of the free oscillation."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from scipy.integrate import cumulative_simpson

from pyjoystick.model import (
    NOMINAL,
    PAPER_STEP,
    PIVOT_TO_TOP,
    STOP_ANGLE,
    Trajectory,
    contact_moment,
    decaying_periods,
    exponent,
    simulate,
    simulate_rk4,
    swing_frequency,
    undamped_oscillation,
)
from pyjoystick.motion import GRAVITY
from pyjoystick.reports.claims.claim import PEAKS, RELEASE, Finding, Verdict, Workbench, claim, verdict
from pyjoystick.reports.dissipation import sampled_closely
from pyjoystick.support import FloatArray

_SPRINGS = [f"{side}.{name}Spring" for side in ("forward", "backward") for name in ("return", "balance")]


@claim("abstract, 2, 3.1, 6", "the period falls steadily as the amplitude falls")
def falling_period(bench: Workbench) -> Finding:
    """Undamped period over amplitude, and the damped periods of the first peaks."""
    table = bench.periods
    shortest = table.iloc[int(np.argmin(table["period"]))]
    above = table[table["amplitude"] > shortest["amplitude"]]
    steps = np.diff(above["period"])
    drop = float(1.0 - shortest["period"] / above["period"].iloc[-1])
    damped = [
        np.diff(decaying_periods(release.displacement.head(PEAKS))["period"])
        for release in (bench.constant_release, bench.power_law_release)
    ]
    here = (
        f"falls by {100.0 * drop:.0f} % from 20 to {math.degrees(shortest['amplitude']):.2f} "
        "degrees, without "
        f"exception over the nine peaks with either damping law"
    )
    ends = np.flatnonzero(np.diff(np.concatenate([[False], steps < 0.0, [False]])))
    angles = np.abs(np.degrees(above["release"].to_numpy()))
    dents = [f"{angles[start]:.2f} to {angles[end]:.2f}" for start, end in ends.reshape(-1, 2)]
    remark = (
        "There are exceptions, which Fig. 4 does not show: with growing amplitude the period falls a little, "
        f"by less than {100.0 * _deepest(above['period'].to_numpy()):.1f} %, for releases from "
        f"{' and from '.join(dents)} degrees, where the balance springs engage, and below "
        f"{math.degrees(shortest['amplitude']):.2f} degrees the clearance makes the period grow again "
        "(docs/period.md)"
    )
    return Finding(verdict(bool(np.all(steps > 0.0)), all(np.all(one < 0.0) for one in damped)), here, remark)


def _deepest(periods: FloatArray) -> float:
    """Largest relative fall below an earlier value, rounded up to 0.1 %."""
    return math.ceil(1e3 * float(np.max(1.0 - periods / np.maximum.accumulate(periods)))) / 1e3


@claim("abstract, 3.1", "the restrained preload is what makes the period fall")
def preload_is_the_cause(bench: Workbench) -> Finding:
    """Compare with the same joystick without any preload, both without weight."""
    weightless = NOMINAL.replace({"g": 0.0})
    ratios = []
    for joystick in (weightless, weightless.replace({f"{spring}.F_0": 0.0 for spring in _SPRINGS})):
        large, small = (undamped_oscillation(joystick, math.radians(-angle)) for angle in (20.0, 2.0))
        ratios.append(small.period / large.period)
    here = (
        f"from 20 to 2 degrees the period falls to {ratios[0]:.2f} of its value; without preload it would "
        f"rise to {ratios[1]:.2f}"
    )
    remark = "Both values are without weight, because without preload the joystick would fall over backward"
    return Finding(verdict(ratios[0] < 0.7 and ratios[1] >= 1.0), here, remark)


@claim("1", "the effect of the clearance is minor")
def clearance(bench: Workbench) -> Finding:
    """Compare periods with and without the clearance of 0.075 mm."""
    changes = {}
    for angle in (20.0, 5.0, 1.0, 0.5):
        without = NOMINAL.replace({f"{side}.returnSpring.x_0": 0.0 for side in ("forward", "backward")})
        ratio = (
            undamped_oscillation(NOMINAL, math.radians(-angle)).period
            / undamped_oscillation(without, math.radians(-angle)).period
        )
        changes[angle] = 100.0 * (ratio - 1.0)
    longer = ", ".join(f"{value:.1f} % at {angle:g}" for angle, value in changes.items())
    here = f"it lengthens the period by {longer} degrees of amplitude"
    remark = "Minor except for the last swings"
    return Finding(verdict(changes[0.5] < 5.0, changes[5.0] < 5.0), here, remark)


@claim("2", "the falling period is more typical of bouncing balls")
def bouncing_ball(bench: Workbench) -> Finding:
    """Exponent of the period over the amplitude, which is 1/2 for a constant force."""
    between = bench.periods["amplitude"].between(math.radians(1.0), math.radians(5.0)).to_numpy()
    slopes = exponent(bench.periods)[between]
    here = (
        f"from 1 to 5 degrees the period is proportional to the power {slopes.min():.2f} to "
        f"{slopes.max():.2f} of the amplitude"
    )
    remark = "Under a constant force, which the preload nearly is, it would be 0.5, for a linear spring 0"
    return Finding(verdict(bool(np.all(np.abs(slopes - 0.5) < 0.1))), here, remark)


@claim("2", "the natural frequency depends highly on the amplitude")
def frequency(bench: Workbench) -> Finding:
    """Frequency at 1 degree relative to that at 20 degrees."""
    frequencies = [1.0 / undamped_oscillation(NOMINAL, math.radians(-angle)).period for angle in (20.0, 1.0)]
    here = f"{frequencies[0]:.1f} Hz at 20 degrees, {frequencies[1]:.1f} Hz at 1 degree"
    return Finding(verdict(frequencies[1] > 1.5 * frequencies[0]), here)


@claim("3.1", "the average stiffness rises as the amplitude falls")
def average_stiffness(bench: Workbench) -> Finding:
    """Linear stiffness with the same period, J*(2*pi/T)^2."""
    stiffness = {
        angle: NOMINAL.J * (2.0 * math.pi / undamped_oscillation(NOMINAL, math.radians(-angle)).period) ** 2
        for angle in (20.0, 5.0, 1.0)
    }
    values = list(stiffness.values())
    rises = ", ".join(f"{value:.1f} at {angle:g}" for angle, value in stiffness.items())
    here = f"a linear spring of the same period would have, in N m/rad: {rises} degrees"
    return Finding(verdict(values == sorted(values)), here)


@claim("2, Fig. 4a", "the first positive and the first negative peak are nearly equal, and so on in pairs")
def pairs_of_peaks(bench: Workbench) -> Finding:
    """Compare ratios of successive peaks: positive to negative and negative to positive."""
    found = {}
    for law, run in (("constant C", bench.constant), ("eq. (11)", bench.power_law)):
        heights = bench.heights(run)
        ratios = heights[1:] / heights[:-1]
        found[law] = ratios[1::2], ratios[0::2]
    here = "; ".join(
        f"{law}: each negative peak is {np.mean(pair):.2f} of the positive one before it, each positive one "
        f"{np.mean(rest):.2f} of the negative one before it"
        for law, (pair, rest) in found.items()
    )
    remark = (
        "With the printed stiffnesses and dampings there are no such pairs: about the same fraction is lost "
        "from peak to peak on either side"
    )
    equal = all(np.all(pair > 0.9) for pair, _ in found.values())
    pattern = all(np.mean(pair) > np.mean(rest) + 0.05 for pair, rest in found.values())
    return Finding(verdict(equal, pattern), here, remark)


@claim("3.1", "the softer backward side makes the negative peaks larger")
def softer_side(bench: Workbench) -> Finding:
    """Compare turning angles of equal energy."""
    ratios = {
        angle: undamped_oscillation(NOMINAL, math.radians(angle)).backward / math.radians(angle)
        for angle in (20.0, 10.0, 5.0, 2.0)
    }
    larger = ", ".join(f"{ratio:.3f} at {angle:g}" for angle, ratio in ratios.items())
    here = f"backward over forward amplitude at equal energy: {larger} degrees forward"
    remark = "At small amplitudes the reverse is true, because the preload is larger backward"
    values = np.array(list(ratios.values()))
    return Finding(verdict(bool(np.all(values > 1.0)), bool(values[0] > 1.0)), here, remark)


@claim("2, Fig. 4c", "the acceleration is nearly constant over portions of each period")
def constant_acceleration(bench: Workbench) -> Finding:
    """How long the acceleration stays within 15 % of its mean in each half swing with constant damping."""
    run = bench.constant
    turns = bench.constant_release.displacement["time"].to_numpy()[:PEAKS]
    shares = []
    for start, end in pairwise(turns):
        inside = run["alpha"][(run.index > start) & (run.index < end)].to_numpy()
        for half in (inside[inside > 0.0], inside[inside < 0.0]):
            level = np.median(half)
            shares.append(np.count_nonzero(np.abs(half / level - 1.0) < 0.15) / len(half))
    mean = float(np.mean(shares))
    here = (
        f"within 15 % of its level for {100.0 * mean:.0f} % of the time on average, "
        f"{100.0 * min(shares):.0f} % "
        "in the worst half swing"
    )
    return Finding(verdict(mean > 0.7), here)


@claim("2, Fig. 4d", "the accelerometer shows spikes and ringing where the joystick passes the middle")
def spikes(bench: Workbench) -> Finding:
    """Acceleration within 10 ms of the first zero crossing, relative to that at the release."""
    constant = sampled_closely(NOMINAL, release_angle=RELEASE, duration=0.2)
    step, largest = _passage(constant)
    with_law = {factor: _passage(bench.smoothed(factor))[1] for factor in (1.0, 10.0, 0.1)}
    here = (
        f"within 20 ms the acceleration steps by {step:.2f} times its value at the release, without a spike: "
        f"with the constant C it stays below {largest:.2f} of that value; eq. (11) adds a peak of "
        f"{with_law[1.0]:.2f} at zero angle"
    )
    remark = (
        "The steps are confirmed. The peak comes from the damping function and depends on its smoothing "
        f"({with_law[10.0]:.2f} with ten times as much, {with_law[0.1]:.2f} with a tenth). The model, "
        "eq. (1), includes neither impact nor ringing of the parts"
    )
    return Finding(verdict(largest > 1.0, step > 0.5), here, remark)


def _passage(run: Trajectory) -> tuple[float, float]:
    """Range of the acceleration, and its largest magnitude, around the first zero crossing."""
    first = next(event.time for event in run.events if event.kind == "theta = 0")
    near = run.alpha[np.abs(run.time - first) < 10e-3] / abs(run.alpha[0])
    return float(np.ptp(near)), float(np.max(np.abs(near)))


@claim("2", "gravity's part of the accelerometer's signal is about 6 % of the peak at the extremes")
def gravity_in_the_signal(bench: Workbench) -> Finding:
    """Compare g*sin(20 degrees) with the peak acceleration at the top of the handle."""
    peak = PIVOT_TO_TOP * float(np.max(np.abs(bench.constant["alpha"])))
    part = 100.0 * GRAVITY * math.sin(STOP_ANGLE) / peak
    return Finding(
        verdict(abs(part - 6.0) < 1.5), f"{part:.1f} %, for an accelerometer at the top of the handle"
    )


@claim("2", "velocity and angle integrated from the accelerometer's signal are invalid")
def integrated_signal(bench: Workbench) -> Finding:
    """Integrate gravity's part of the signal twice; spikes and ringing add to it."""
    run = bench.constant
    time, part = run.index.to_numpy(), -GRAVITY / PIVOT_TO_TOP * np.sin(run["theta"].to_numpy())
    velocity = cumulative_simpson(part, x=time, initial=0.0)
    angle = np.degrees(np.abs(cumulative_simpson(velocity, x=time, initial=0.0)))
    errors = {end: float(np.interp(end, time, angle)) for end in (0.25, 0.5, 1.5)}
    drift = ", ".join(f"{error:.1f} degrees after {end:g} s" for end, error in errors.items())
    here = f"gravity's part alone, at the top of the handle, makes the angle wrong by {drift}"
    remark = "The command pyjoystick import accelerometer removes it, using the measured angle"
    return Finding(verdict(errors[1.5] > 5.0), here, remark)


@claim("1", "usually a preload has no effect on small motions about a preloaded position")
def preload_and_small_motions(bench: Workbench) -> Finding:
    """Stiffness with the return spring free of its restraint, with all preloads and without."""
    without = NOMINAL.replace({f"{spring}.F_0": 0.0 for spring in _SPRINGS})
    step, rows = 1e-5, []
    for angle in np.radians([5.0, 15.0]):
        pair = [
            float(contact_moment(one, angle + step) - contact_moment(one, angle - step)) / (2.0 * step)
            for one in (NOMINAL, without)
        ]
        rows.append((angle, pair[0] / pair[1] - 1.0))
    changes = " and ".join(
        f"{100.0 * change:+.0f} % at {math.degrees(angle):.0f} degrees" for angle, change in rows
    )
    here = (
        f"about an angle at which a torque holds the handle, the preloads change the stiffness by {changes}; "
        "where the motion passes a preload, it changes everything (abstract, 3.1)"
    )
    remark = "The remaining change comes from the geometry: the lever of the force changes with the angle"
    return Finding(verdict(all(abs(change) < 0.25 for _, change in rows)), here, remark)


@claim("3.2", "the swing test gives J = m*g*h/(2*pi*f_n)^2")
def swing_test(bench: Workbench) -> Finding:
    """Frequency from Table 2 by this formula, and from a simulated small swing out of contact."""
    formula = swing_frequency(NOMINAL)
    far = {f"{spring}.x_0": 1.0 + spring.endswith("balanceSpring") for spring in _SPRINGS}
    pendulum = NOMINAL.replace(far | {"g": -NOMINAL.g, "damping.C": 0.0})
    run = simulate(pendulum, time=[0.0, 1.0], theta_start=1e-3)
    simulated = 1.0 / run.turning_points[1].time
    here = f"f_n = {formula:.3f} Hz for Table 2; a simulated swing of 1 mrad has {simulated:.3f} Hz"
    return Finding(verdict(abs(simulated / formula - 1.0) < 1e-6), here)


@claim("4", "fourth-order Runge-Kutta steps of 1 ms, a tenth of that near the steep slopes, suffice")
def paper_integrator(bench: Workbench) -> Finding:
    """Compare the paper's integrator with the reference."""
    run = simulate_rk4(NOMINAL, duration=1.5, theta_start=RELEASE)
    exact = simulate(NOMINAL, time=run.time, theta_start=RELEASE)
    error = math.degrees(float(np.max(np.abs(run.theta - exact.theta))))
    here = f"largest error in 1.5 s: {error:.1g} degrees, with steps of {1e3 * PAPER_STEP:g} ms"
    return Finding(verdict(error < 0.1), here)


@claim("3, Table 2", "(the acceleration of gravity is not given)")
def unknown_gravity(bench: Workbench) -> Finding:
    """Effect of a different g."""
    local = NOMINAL.replace({"g": 9.78})
    change = undamped_oscillation(local, RELEASE).period / undamped_oscillation(NOMINAL, RELEASE).period - 1.0
    here = f"9.80665 m/s2 is used; 9.78 would change the period at 20 degrees by {100.0 * change:.3f} %"
    return Finding(Verdict.SILENT, here)


CLAIMS = (
    falling_period,
    preload_is_the_cause,
    average_stiffness,
    bouncing_ball,
    frequency,
    preload_and_small_motions,
    clearance,
    pairs_of_peaks,
    softer_side,
    constant_acceleration,
    spikes,
    gravity_in_the_signal,
    integrated_signal,
    swing_test,
    paper_integrator,
    unknown_gravity,
)
