"""Sections 5 and 6: the torque of a motion forward and back."""

from __future__ import annotations

from dataclasses import replace

from pyjoystick.forced_motion import MOTION, section_5
from pyjoystick.model import NOMINAL_POWER_LAW
from pyjoystick.reports.claims.claim import Finding, claim, verdict
from pyjoystick.reports.claims.workbench import Workbench


@claim("5, 6, Fig. 15", "the inertia torque is comparable to the stiffness torque")
def inertia_and_stiffness(_: Workbench) -> Finding:
    """Ratio of the peaks in a quick stroke and in one of 0.3 s."""
    quick, slow = (
        section_5(motion).inertia_to_stiffness for motion in (MOTION, replace(MOTION, rise=0.3, fall=0.3))
    )
    here = (
        f"{quick:.2f} of its peak in a minimum-jerk stroke of 18 degrees in {MOTION.rise:g} s, {slow:.2f} in "
        "one of 0.3 s"
    )
    remark = "the motion of Fig. 14 is not printed as numbers; the lines below use the quick stroke"
    return Finding(verdict(slow > 0.5, quick > 0.5), here, remark)


@claim("5, 6, Fig. 15b", "the damping torque is about 10 % of the total")
def damping_part(_: Workbench) -> Finding:
    """Peaks of the damping torque over those of the total."""
    parts = [100.0 * part for part in section_5().damping_to_total.values()]
    here = f"{parts[0]:.0f} % with C = 0.045, {parts[1]:.0f} % with eq. (11)"
    near = [5.0 <= part <= 15.0 for part in parts]
    return Finding(verdict(all(near), any(near)), here)


@claim("5, Fig. 15b", "eq. (11) gives about twice the damping torque of C = 0.045")
def damping_laws(_: Workbench) -> Finding:
    """The ratio with the printed exponent, and with the sign that section 3.3 leads one to expect."""
    printed = section_5().damping_ratio
    opposite = NOMINAL_POWER_LAW.replace({"damping.n_pos": -NOMINAL_POWER_LAW.to_names()["damping.n_pos"]})
    falling = section_5(power_law=opposite).damping_ratio
    here = f"{printed:.2f} times with the printed n_pos, {falling:.2f} times with its sign changed"
    remark = "this suggests a sign lost in print, as do the negative slopes of section 3.3"
    return Finding(verdict(abs(printed - 2.0) < 0.3, abs(falling - 2.0) < 0.3), here, remark)


CLAIMS = (inertia_and_stiffness, damping_part, damping_laws)
