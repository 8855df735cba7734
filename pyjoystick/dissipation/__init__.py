"""Where a free oscillation leaves its energy: the steps of Fig. 12, and the damping function of Fig. 13."""

from pyjoystick.dissipation.jumps import damping_jumps, equivalent_damping, mean_damping
from pyjoystick.dissipation.plateaus import plateaus

__all__ = ["damping_jumps", "equivalent_damping", "mean_damping", "plateaus"]
