"""Sections 5 and 6: the torque of a stroke and its return, in numbers and as claims."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

from pyjoystick.forced_motion import ForwardAndReturn, Samples, TorqueMeasures, measure, torque_by_reference
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, LawName, law_name
from pyjoystick.reports.claims.claim import Finding, Workbench, claim, verdict

#: Substitute for the motion of Fig. 14, whose numbers are not printed. A quick stroke fits section 5 best:
#: in a slower one, the inertia torque is small compared with that of the springs.
MOTION: Final = ForwardAndReturn(amplitude=math.radians(18.0), rise=0.12, rest=0.3)


@dataclass(frozen=True, slots=True)
class Section5:
    """Ratios for the statements of section 5 on the torque of one motion.

    Attributes:
        inertia_to_stiffness: peak of the inertia torque over that of M_s - m*g*h*sin(theta); in the paper,
            comparable in size
        damping_to_total: peak of the damping torque over that of the total, by damping law; roughly 10 %
        damping_ratio: peak of the damping torque with eq. (11) over that with constant C; roughly double
        loss_ratio: the same ratio of the energies that the damping dissipates
    """

    inertia_to_stiffness: float
    damping_to_total: Mapping[LawName, float]
    damping_ratio: float
    loss_ratio: float


def section_5(
    motion: ForwardAndReturn | Samples = MOTION,
    *,
    power_law: JoystickParameters = NOMINAL_POWER_LAW,
) -> Section5:
    """Compute the ratios of a motion in plain Python.

    Args:
        motion: in closed form or sampled
        power_law: the joystick with eq. (11), compared with the paper's with constant damping
    """
    found = measures_of(motion, NOMINAL, power_law)
    first, second = found["constant"], found["power-law"]
    return Section5(
        inertia_to_stiffness=first.peak_ratio("inertia", "stiffness"),
        damping_to_total={law: measures.peak_ratio("damping") for law, measures in found.items()},
        damping_ratio=second.parts["damping"].peak / first.parts["damping"].peak,
        loss_ratio=second.loss / first.loss,
    )


def measures_of(
    motion: ForwardAndReturn | Samples, *joysticks: JoystickParameters
) -> dict[LawName, TorqueMeasures]:
    """Statistics of the torque of one motion, for joysticks of different damping laws."""
    found = {}
    for joystick in joysticks:
        samples = Samples.of(joystick, motion) if isinstance(motion, ForwardAndReturn) else motion
        found[law_name(joystick.damping)] = measure(joystick, samples, torque_by_reference(joystick, samples))
    return found


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
    remark = "The motion of Fig. 14 is not printed as numbers. The lines below use the quick stroke"
    return Finding(verdict(slow > 0.5, quick > 0.5), here, remark)


@claim("5, 6, Fig. 15b", "the damping torque is about 10 % of the total")
def damping_part(_: Workbench) -> Finding:
    """Peaks of the damping torque relative to those of the total."""
    parts = [100.0 * part for part in section_5().damping_to_total.values()]
    here = f"{parts[0]:.0f} % with C = 0.045, {parts[1]:.0f} % with eq. (11)"
    near = [5.0 <= part <= 15.0 for part in parts]
    return Finding(verdict(all(near), any(near)), here)


@claim("5, Fig. 15b", "eq. (11) gives about twice the damping torque of C = 0.045")
def damping_laws(_: Workbench) -> Finding:
    """Ratio with the printed exponent, and with the sign that section 3.3 suggests."""
    printed = section_5().damping_ratio
    opposite = NOMINAL_POWER_LAW.replace({"damping.n_pos": -NOMINAL_POWER_LAW.to_names()["damping.n_pos"]})
    falling = section_5(power_law=opposite).damping_ratio
    here = f"{printed:.2f} times with the printed n_pos, {falling:.2f} times with its sign changed"
    remark = "This suggests a sign lost in print, as do the negative slopes of section 3.3"
    return Finding(verdict(abs(printed - 2.0) < 0.3, abs(falling - 2.0) < 0.3), here, remark)


CLAIMS = (inertia_and_stiffness, damping_part, damping_laws)
