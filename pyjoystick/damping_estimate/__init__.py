"""Damping from the peaks of free oscillations: section 3.3 of the paper, with its bias."""

from pyjoystick.damping_estimate.bias import Bias, bias_table, constant_bias, line_bias, preload_factors
from pyjoystick.damping_estimate.estimate import (
    CONSTANTS,
    LINES,
    ConstantEstimate,
    DampingEstimate,
    estimate_damping,
)
from pyjoystick.damping_estimate.line import DampingEstimateError, PowerLine, fit_power_line
from pyjoystick.damping_estimate.points import VelocityClock, displacement_points, velocity_points

__all__ = [
    "CONSTANTS",
    "LINES",
    "Bias",
    "ConstantEstimate",
    "DampingEstimate",
    "DampingEstimateError",
    "PowerLine",
    "VelocityClock",
    "bias_table",
    "constant_bias",
    "displacement_points",
    "estimate_damping",
    "fit_power_line",
    "line_bias",
    "preload_factors",
    "velocity_points",
]
