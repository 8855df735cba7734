"""Sections 2 and 4: the energy, and the effect of the measuring chain."""

from __future__ import annotations

import numpy as np

from pyjoystick.laboratory import Chain, ChainEffect, LowPass, chain_effect, derivative
from pyjoystick.model import NOMINAL_POWER_LAW
from pyjoystick.reports.claims.claim import PEAKS, RELEASE, Finding, Verdict, Workbench, claim, verdict
from pyjoystick.reports.dissipation import REST, plateaus


@claim("4, Fig. 12", "the energy falls gradually and never rises")
def energy_falls(bench: Workbench) -> Finding:
    """Largest rise between samples of either run, relative to the energy at the release."""
    rises = [
        float(np.max(np.diff(run["E"]))) / float(run["E"].iloc[0])
        for run in (bench.constant, bench.power_law)
    ]
    largest = max(rises)
    size = (
        "no rise above rounding"
        if largest < 1e-13
        else f"rises by {largest:.0e} of the energy at the release"
    )
    return Finding(verdict(largest < 1e-12), f"{size}, with either damping law")


@claim("4, Fig. 12", "it falls in steps, with plateaus near zero velocity")
def energy_steps(bench: Workbench) -> Finding:
    """Energy lost on the plateaus around the first turning points, compared with the swings."""
    found = {}
    for factor in (1.0, 10.0, 0.1):
        rests = plateaus(bench.smoothed(factor)).head(PEAKS)
        lengths = 1e3 * (rests["end"] - rests["start"])
        part = 100.0 * float((rests["lost"] / rests["swing_lost"]).max())
        found[factor] = part, f"{lengths.min():.0f} to {lengths.max():.0f} ms", f"{part:.1f} %"
    part, length, lost = found[1.0]
    here = (
        f"around the first {PEAKS} turning points the energy stays level for {length} and falls by at most "
        f"{lost} of the loss in the swing before"
    )
    remark = (
        f"Level means at most {100.0 * REST:g} % of the largest power beside it, which the peak of eq. (11) "
        f"at zero angle determines. With ten times the smoothing these are {found[10.0][1]} and "
        f"{found[10.0][2]}, with a tenth of it {found[0.1][1]} and {found[0.1][2]}"
    )
    return Finding(verdict(part < 5.0), here, remark)


@claim("4, Fig. 12", "the energy computed from the measured motion rises")
def measured_energy_rises(bench: Workbench) -> Finding:
    """Apply the paper's chain to a simulated motion."""
    effect = _through(Chain())
    part = 100.0 * effect.energy_rise / effect.energy_start
    here = (
        f"after the paper's chain the energy of a simulation appears to rise by {part:.1f} % of its initial "
        "value"
    )
    return Finding(verdict(part > 1.0), here)


@claim("4, Fig. 12", "the cause is that numerical differentiation underestimates the peak velocities")
def cause_of_the_rise(bench: Workbench) -> Finding:
    """Compare the chain with its rule of differentiation alone."""
    chain = Chain()
    effect = _through(chain)
    run = effect.run
    even = np.arange(0.0, float(run.time[-1] - run.time[0]), 1.0 / chain.rate)
    theta = np.interp(even, run.time - run.time[0], run.theta)
    alone = derivative(theta, 1.0 / chain.rate, order=1, points=chain.velocity_points)
    lost = 100.0 * (1.0 - float(np.max(np.abs(alone))) / float(np.max(np.abs(run.omega))))
    wide = _through(Chain(low_pass=LowPass(cutoff=100.0)), camera_rate=240.0)
    here = (
        f"the first {PEAKS} peaks of the velocity lose {100.0 * effect.shortfall[0]:.0f} to "
        f"{100.0 * effect.shortfall[:PEAKS].max():.0f} %; the 5-point rule alone removes {lost:.1f} "
        "% of the largest"
    )
    remark = (
        "The velocities are underestimated, but by the 13 Hz low-pass filter: at 100 Hz (and 240 "
        "frames a second) the "
        f"energy rises by only {100.0 * wide.energy_rise / wide.energy_start:.1f} %"
    )
    return Finding(verdict(lost > 3.0, effect.shortfall[0] > 0.03), here, remark)


@claim("4, Fig. 10b", "simulated velocities have sharper peaks than measured ones")
def sharper_peaks(bench: Workbench) -> Finding:
    """Compute how much of the peaks the chain keeps."""
    shortfall = _through(Chain()).shortfall[:PEAKS]
    here = (
        f"the signal chain removes {100.0 * shortfall.min():.0f} to {100.0 * shortfall.max():.0f} % of the "
        f"first {PEAKS} peaks"
    )
    return Finding(verdict(bool(np.all(shortfall > 0.0))), here)


@claim("2", "low-pass at 13 Hz, a fourth-order Butterworth filter run forward and reverse")
def cutoff(bench: Workbench) -> Finding:
    """Response of both passes together at 13 Hz."""
    chain = Chain()
    response = float(chain.low_pass.response(np.array([chain.low_pass.cutoff]), chain.rate)[0])
    half_power = chain.low_pass.half_power_frequency(chain.rate)
    here = (
        f"if 13 Hz refers to one run, both together have a gain of {response:.2f} there and -3 dB at "
        f"{half_power:.1f} Hz"
    )
    remark = "The paper does not say to which it refers; one run is assumed here"
    return Finding(Verdict.SILENT, here, remark)


def _through(chain: Chain, camera_rate: float = 60.0) -> ChainEffect:
    return chain_effect(NOMINAL_POWER_LAW, chain, release_angle=RELEASE, camera_rate=camera_rate)


CLAIMS = (energy_falls, energy_steps, measured_energy_rises, cause_of_the_rise, sharper_peaks, cutoff)
