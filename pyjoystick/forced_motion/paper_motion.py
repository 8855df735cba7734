"""The statements of section 5 on the torque of a forward-and-return motion, as numbers of a given motion."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from pyjoystick.forced_motion.measures import TorqueMeasures, measure
from pyjoystick.forced_motion.motions import ForwardAndReturn
from pyjoystick.forced_motion.samples import Samples
from pyjoystick.forced_motion.torque import torque_by_reference
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters, LawName, law_name

#: In place of the motion of Fig. 14, whose numbers are not printed. So quick a stroke fits section 5 best: in
#: a slower one the inertia torque is small beside that of the springs.
MOTION: Final = ForwardAndReturn(amplitude=math.radians(18.0), rise=0.12, rest=0.3)


@dataclass(frozen=True, slots=True)
class Section5:
    """What section 5 says of the torque, for one motion.

    Attributes:
        inertia_to_stiffness: peak of the inertia torque over that of M_s - m*g*h*sin(theta); the paper:
            comparable in size
        damping_to_total: peak of the damping torque over that of the torque, by damping law; roughly 10 %
        damping_ratio: peak of the damping torque with eq. (11) over that with constant C; roughly double
        loss_ratio: the same of the energy that the damping takes
    """

    inertia_to_stiffness: float
    damping_to_total: Mapping[LawName, float]
    damping_ratio: float
    loss_ratio: float


def section_5(
    motion: ForwardAndReturn | Samples = MOTION,
    *,
    constant: JoystickParameters = NOMINAL,
    power_law: JoystickParameters = NOMINAL_POWER_LAW,
) -> Section5:
    """The numbers of a motion, by plain Python.

    Args:
        motion: in closed form or sampled
        constant: the joystick with constant damping
        power_law: the same with eq. (11)
    """
    found = measures_of(motion, constant, power_law)
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
    """The torque of one motion in numbers, for joysticks of different damping laws."""
    found = {}
    for joystick in joysticks:
        samples = Samples.of(motion, joystick) if isinstance(motion, ForwardAndReturn) else motion
        found[law_name(joystick.damping)] = measure(joystick, samples, torque_by_reference(joystick, samples))
    return found
