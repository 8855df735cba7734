"""How long an undamped oscillation takes, from the energy and in closed form: the paper's main finding."""

from pyjoystick.undamped_period.closed_form import LineOscillator, LineSide, linearized_joystick
from pyjoystick.undamped_period.errors import NoOscillationError
from pyjoystick.undamped_period.geometry import CamGeometry, Geometry, LinearGeometry
from pyjoystick.undamped_period.oscillation import Span, UndampedOscillation
from pyjoystick.undamped_period.quadrature import undamped_oscillation

__all__ = [
    "CamGeometry",
    "Geometry",
    "LineOscillator",
    "LineSide",
    "LinearGeometry",
    "NoOscillationError",
    "Span",
    "UndampedOscillation",
    "linearized_joystick",
    "undamped_oscillation",
]
