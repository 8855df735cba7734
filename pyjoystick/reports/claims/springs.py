"""Sections 1 and 3 to 3.1: geometry, contact moment, springs and Table 1."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import minimize_scalar

from pyjoystick.laboratory import cubic_fits
from pyjoystick.model import (
    BACKWARD_TABLE,
    FORWARD_TABLE,
    NOMINAL,
    STOP_ANGLE,
    assembly_force,
    contact_force,
    contact_moment,
    contact_travel,
    contact_travel_slope,
    spring_force,
    table_force,
)
from pyjoystick.reports.claims.claim import Finding, Verdict, Workbench, claim, verdict

_ANGLES = np.radians(np.linspace(0.25, 20.0, 80))
_ASSEMBLIES = (NOMINAL.forward, NOMINAL.backward)
_SPRINGS = [spring for one in _ASSEMBLIES for spring in (one.return_spring, one.balance_spring)]


@claim("1", "the plunger is depressed by a distance about proportional to the angle")
def proportional_travel(_: Workbench) -> Finding:
    """Deviation from the best line through zero (minimax) up to the stops."""
    travel = contact_travel(NOMINAL, _ANGLES)
    best = minimize_scalar(
        lambda slope: float(np.max(np.abs(travel - slope * _ANGLES))),
        bounds=(0.5 * NOMINAL.a, 2.0 * NOMINAL.a),
        options={"xatol": 1e-9},
    )
    largest = float(best.fun / travel[-1])
    here = f"the best line through zero deviates by at most {100.0 * largest:.2f} % of the full travel"
    return Finding(verdict(largest < 0.02), here)


@claim("1", "small forces hardly move it; it moves far only when the preload is overcome")
def preload_holds(_: Workbench) -> Finding:
    """Travel of the forward return spring at 0.9 and at 1.1 times its preload."""
    spring = NOMINAL.forward.return_spring
    below = 0.9 * spring.F_0 / (spring.k_h + spring.k_s)
    above = 0.1 * spring.F_0 / spring.k_s
    check = float(spring_force(spring, spring.x_0 + above)) / spring.F_0
    here = (
        f"forward: {1e3 * below:.3f} mm of spring travel at 0.9 of the preload, {1e3 * above:.1f} "
        f"mm at {check:.2f} of it"
    )
    return Finding(verdict(above > 10.0 * below), here)


@claim("eqs. (2), (3)", "the travel x follows from the position of the contact point")
def travel_from_contact_point(_: Workbench) -> Finding:
    """Insert eq. (3) into eqs. (2a, b), with r eliminated."""
    x = contact_travel(NOMINAL, _ANGLES)
    a, b = NOMINAL.a, NOMINAL.b
    left = (x - b + b * np.cos(_ANGLES)) * np.cos(_ANGLES)
    right = (a - b * np.sin(_ANGLES)) * np.sin(_ANGLES)
    off = float(np.max(np.abs(left - right)))
    return Finding(verdict(off < 1e-15), f"(2a) and (2b) agree to {_power_of_ten(off)} m")


@claim("eq. (5)", "M_s = {a*(sign(theta) + d*tan(theta))}*f_x, as printed")
def contact_moment_as_printed(_: Workbench) -> Finding:
    """Compare the printed lever with the slope of the travel, which conserves energy."""
    d = float(contact_travel(NOMINAL, STOP_ANGLE)) - NOMINAL.b
    printed = NOMINAL.a * (1.0 + d * math.tan(STOP_ANGLE))
    right = float(contact_travel_slope(NOMINAL, STOP_ANGLE))
    moment = contact_moment(NOMINAL, _ANGLES)
    power = contact_force(NOMINAL, _ANGLES) * contact_travel_slope(NOMINAL, _ANGLES)
    off = float(np.max(np.abs(moment / power - 1.0)))
    here = (
        f"at 20 degrees its value is off by {100.0 * (printed / right - 1.0):+.1f} %, and its units disagree"
    )
    remark = (
        "Misprint: the sum of moments, eq. (4), gives (a*sign(theta) + d*tan(theta))*f_x, used "
        "here. It equals "
        f"f_x*dx/dtheta to {_power_of_ten(off)}, so the contact moment conserves energy"
    )
    return Finding(verdict(abs(printed / right - 1.0) < 1e-12), here, remark)


@claim("eqs. (6)-(8), Table 1", "each curve is made of two restrained preloaded springs in parallel")
def springs_are_the_table(_: Workbench) -> Finding:
    """Compare the springs with the table's straight lines."""
    travel = np.linspace(0.0, 9e-3, 9001)
    off = max(
        float(np.max(np.abs(assembly_force(springs, travel) - table_force(table, travel))))
        for springs, table in zip(_ASSEMBLIES, (FORWARD_TABLE, BACKWARD_TABLE), strict=True)
    )
    return Finding(verdict(off < 1e-9), f"up to 9 mm the forces differ by {_power_of_ten(off)} N")


@claim("3.1", "the restraint is much stiffer than its spring, so that it stretches much less")
def stiff_restraints(_: Workbench) -> Finding:
    """Ratio k_h/k_s, which is also the ratio of the two deflections under the preload."""
    ratios = [spring.k_h / spring.k_s for spring in _SPRINGS]
    here = f"k_h/k_s from {min(ratios):.0f} to {max(ratios):.0f}"
    return Finding(verdict(min(ratios) > 10.0), here)


@claim("3.1, Fig. 7b", "the rod bottoms out after about 3 mm")
def bottoming_out(_: Workbench) -> Finding:
    """Travel and angle at which the balance springs engage."""
    travels = [1e3 * one.balance_spring.x_0 for one in _ASSEMBLIES]
    here = f"forward {travels[0]:.2f} mm, backward {travels[1]:.2f} mm"
    return Finding(verdict(all(abs(travel - 3.0) < 0.1 for travel in travels)), here)


@claim("3.1, Fig. 7b", "two steep portions and two that rise gradually")
def steep_and_gradual(_: Workbench) -> Finding:
    """Ratio of the least steep of the steep segments to the steepest of the gradual ones."""
    tables = [one.to_table() for one in _ASSEMBLIES]
    ratio = min(min(t.k[0], t.k[2]) / max(t.k[1], t.k[3]) for t in tables)
    return Finding(verdict(ratio > 10.0), f"at least {ratio:.0f} times as steep")


@claim("3.1, Fig. 7b", "the overall stiffness falls as the compression grows")
def falling_stiffness(_: Workbench) -> Finding:
    """Force over travel from the first release of a restraint."""
    end = float(contact_travel(NOMINAL, STOP_ANGLE))
    falls, rises = [], []
    for one in _ASSEMBLIES:
        x_1, x_2, x_3 = one.kinks[1:]
        first, second, third, last = (float(assembly_force(one, x)) / x for x in (x_1, x_2, x_3, end))
        falls.append(first / last)
        rises.append(third / second - 1.0)
    here = f"force over travel falls to 1/{min(falls):.0f} or less between the first release and the stop"
    remark = (
        "With one exception: over the second steep portion it rises again, by "
        f"{100.0 * max(rises):.0f} % at most"
    )
    return Finding(verdict(max(rises) <= 0.0, min(falls) > 2.0), here, remark)


@claim("Fig. 7b", "a cubic polynomial illustrates the curve")
def cubic(_: Workbench) -> Finding:
    """Check how well a cubic works as a model."""
    fits = cubic_fits(NOMINAL, STOP_ANGLE)
    missed = max(fit.rms for fit in fits.values())
    at_contact = min(float(fit.cubic(fit.travel[0])) for fit in fits.values())
    here = (
        f"misses the force by up to {missed:.1f} N (rms); gives at least {at_contact:.0f} N at first contact"
    )
    return Finding(
        Verdict.AGREES if missed < 10.0 else Verdict.IN_PART,
        here,
        "It does not model the kinks, and is not meant to",
    )


def _power_of_ten(number: float) -> str:
    """Order of magnitude, for rounding errors that differ between machines."""
    return "less than 1e-12" if abs(number) < 1e-12 else f"{number:.0e}"


CLAIMS = (
    proportional_travel,
    preload_holds,
    travel_from_contact_point,
    contact_moment_as_printed,
    bottoming_out,
    steep_and_gradual,
    falling_stiffness,
    cubic,
    springs_are_the_table,
    stiff_restraints,
)
