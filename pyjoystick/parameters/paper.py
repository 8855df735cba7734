"""The numbers of Tables 1 and 2, section 3.3 and section 4 of the paper.

Rogers, Garland, Oliver: Dynamic modelling of mechanical systems with opposing restrained preloaded
stiffnesses, J. Sound Vib. 274 (2004) 73-89. Gravity is not given there; the standard value is used.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Final

from pyjoystick.parameters.damping import ConstantDamping, PowerLawDamping
from pyjoystick.parameters.joystick import JoystickParameters
from pyjoystick.parameters.springs import ActuatorAssembly, SegmentTable

#: Table 1, forward side (theta > 0): x_i in m, k_i in N/m.
FORWARD_TABLE: Final = SegmentTable(
    (0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3), (430e3, 2625.0, 1028e3, 5600.0)
)
#: Table 1, backward side (theta < 0): x_i in m, k_i in N/m.
BACKWARD_TABLE: Final = SegmentTable(
    (0.075e-3, 0.1595e-3, 3.054e-3, 3.063e-3), (659e3, 1191.0, 1112e3, 4090.0)
)

#: Tables 1 and 2 with the constant damping of Fig. 10, C = 0.045 N m s/rad.
NOMINAL: Final = JoystickParameters(
    J=0.01135,
    m=0.87,
    h=0.082,
    g=9.80665,
    a=0.02398,
    b=0.0050,
    forward=ActuatorAssembly.from_table(FORWARD_TABLE.x, FORWARD_TABLE.k),
    backward=ActuatorAssembly.from_table(BACKWARD_TABLE.x, BACKWARD_TABLE.k),
    damping=ConstantDamping(C=0.045),
)
#: Tables 1 and 2 with the power law of eq. (11) at the weight of Fig. 10, alpha = 0.9.
NOMINAL_POWER_LAW: Final = dataclasses.replace(NOMINAL, damping=PowerLawDamping(alpha=0.9))

#: Table 2: pivot to the top of the handle (m), where the accelerometer sits.
PIVOT_TO_TOP: Final = 0.266
#: The stops of the joystick are at about plus and minus this angle (rad).
STOP_ANGLE: Final = math.radians(20.0)
