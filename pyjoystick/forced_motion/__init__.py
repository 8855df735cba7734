"""Forced motion, section 5 of the paper: the torque that a motion needs, and the motion under that torque."""

from pyjoystick.forced_motion.driving import RoundTrip, round_trip, torque_rows
from pyjoystick.forced_motion.measured import MeasuredMotion, read_motion, through_chain
from pyjoystick.forced_motion.measures import PARTS, PartMeasures, TorqueMeasures, measure
from pyjoystick.forced_motion.motions import ForwardAndReturn, Kinematics
from pyjoystick.forced_motion.profiles import SHAPES, Shape
from pyjoystick.forced_motion.samples import Samples, smooth_spans
from pyjoystick.forced_motion.torque import (
    TORQUES,
    inverse_fmu,
    torque_by_fmu,
    torque_by_reference,
    torque_table,
)
from pyjoystick.forced_motion.work_cycle import (
    MOVES_PER_SHIFT,
    PRELOADS,
    STIFFNESSES,
    Demand,
    MoveDistribution,
    demands,
    faster,
    scaled,
)

__all__ = [
    "MOVES_PER_SHIFT",
    "PARTS",
    "PRELOADS",
    "SHAPES",
    "STIFFNESSES",
    "TORQUES",
    "Demand",
    "ForwardAndReturn",
    "Kinematics",
    "MeasuredMotion",
    "MoveDistribution",
    "PartMeasures",
    "RoundTrip",
    "Samples",
    "Shape",
    "TorqueMeasures",
    "demands",
    "faster",
    "inverse_fmu",
    "measure",
    "read_motion",
    "round_trip",
    "scaled",
    "smooth_spans",
    "through_chain",
    "torque_by_fmu",
    "torque_by_reference",
    "torque_rows",
    "torque_table",
]
