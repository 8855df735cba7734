"""The numbers of Tables 1 and 2, section 3.3 and section 4 of the paper, from ``paper.toml``.

Rogers, Garland, Oliver: Dynamic modelling of mechanical systems with opposing restrained preloaded
stiffnesses, J. Sound Vib. 274 (2004) 73-89. Gravity is not given there; the standard value is used.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Final

from pyjoystick.model.parameters.file import ParameterFile, read_parameter_file
from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.parameters.springs import SegmentTable

#: The shipped parameter file, which holds the numbers.
PAPER: Final[ParameterFile] = read_parameter_file(Path(__file__).with_name("paper.toml"))
#: Tables 1 and 2 with the constant damping of Fig. 10.
NOMINAL: Final[JoystickParameters] = PAPER.with_law("constant")
#: Tables 1 and 2 with the power law of eq. (11) at the weight of Fig. 10.
NOMINAL_POWER_LAW: Final[JoystickParameters] = PAPER.with_law("power-law")

#: Table 1, forward side (theta > 0): x_i in m, k_i in N/m.
FORWARD_TABLE: Final[SegmentTable] = PAPER.curves["forward"]
#: Table 1, backward side (theta < 0): x_i in m, k_i in N/m.
BACKWARD_TABLE: Final[SegmentTable] = PAPER.curves["backward"]

assert PAPER.pivot_to_top is not None
#: Table 2: pivot to the top of the handle (m), where the accelerometer sits.
PIVOT_TO_TOP: Final[float] = PAPER.pivot_to_top
#: The stops of the joystick are at about plus and minus this angle (rad).
STOP_ANGLE: Final = math.radians(20.0)
