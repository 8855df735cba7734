"""The drawn figures of the pages on the mechanism, with positions that are computed, not drawn by eye."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType

from figures import (
    actuator,
    cam,
    decay,
    excitation,
    free_body,
    live_page,
    load_deflection,
    opposing_springs,
    response,
    restrained_spring,
    secants,
    swing,
    vibration,
)

FOLDER = Path(__file__).parent
#: Each figure by the name of its file.
DRAWINGS = MappingProxyType(
    {
        "opposing_springs": opposing_springs.draw,
        "free_body": free_body.draw,
        "cam": cam.draw,
        "restrained_spring": restrained_spring.draw,
        "actuator": actuator.draw,
        "load_deflection": load_deflection.draw,
        "secants": secants.draw,
        "swing": swing.draw,
        "decay": decay.draw,
        "live_page": live_page.draw,
        "excitation": excitation.draw,
        "response": response.draw,
        "vibration": vibration.draw,
    }
)
