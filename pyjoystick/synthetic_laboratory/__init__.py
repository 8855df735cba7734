"""A synthetic laboratory: what its instruments would have shown of a joystick that is known.

Wherever its output appears it is called synthetic.
"""

from pyjoystick.synthetic_laboratory.motion_capture import (
    BASE,
    GRAVITY,
    TOP,
    MarkerLayout,
    synthetic_acceleration,
    synthetic_markers,
)
from pyjoystick.synthetic_laboratory.pendulum import synthetic_swing
from pyjoystick.synthetic_laboratory.testing_machine import MachineErrors, synthetic_load_cycle

__all__ = [
    "BASE",
    "GRAVITY",
    "TOP",
    "MachineErrors",
    "MarkerLayout",
    "synthetic_acceleration",
    "synthetic_load_cycle",
    "synthetic_markers",
    "synthetic_swing",
]
