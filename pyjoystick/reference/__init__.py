"""The joystick of eqs. (1)-(13) in pure Python: the yardstick by which the FMUs are judged.

It is written from the equations alone and leans on NumPy, SciPy and `pyjoystick.parameters` only.
"""

from pyjoystick.reference.cam import angle_of_travel, contact_travel, contact_travel_slope
from pyjoystick.reference.integration import Event, TurningPoint
from pyjoystick.reference.inverse import InverseTorque, inverse_torque
from pyjoystick.reference.moments import (
    contact_force,
    contact_moment,
    damping_coefficient,
    energy,
    gravity_moment,
    swing_frequency,
)
from pyjoystick.reference.rk4 import PAPER_REFINEMENT, PAPER_STEP, simulate_rk4
from pyjoystick.reference.simulation import DEFAULT_TOLERANCE, simulate
from pyjoystick.reference.springs import (
    assembly_energy,
    assembly_force,
    spring_energy,
    spring_force,
    table_force,
)
from pyjoystick.reference.trajectory import Trajectory

__all__ = [
    "DEFAULT_TOLERANCE",
    "PAPER_REFINEMENT",
    "PAPER_STEP",
    "Event",
    "InverseTorque",
    "Trajectory",
    "TurningPoint",
    "angle_of_travel",
    "assembly_energy",
    "assembly_force",
    "contact_force",
    "contact_moment",
    "contact_travel",
    "contact_travel_slope",
    "damping_coefficient",
    "energy",
    "gravity_moment",
    "inverse_torque",
    "simulate",
    "simulate_rk4",
    "spring_energy",
    "spring_force",
    "swing_frequency",
    "table_force",
]
