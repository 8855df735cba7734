"""Every model of this folder with its oracle: a closed form, or SciPy on the model's equations."""

from __future__ import annotations

from ..case import Case
from . import (
    algebraic,
    components,
    constraints,
    discrete,
    friction,
    homotopy,
    initialization,
    smooth,
    springs,
    state_events,
    time_events,
)

CASES: tuple[Case, ...] = (
    *state_events.CASES,
    *friction.CASES,
    *time_events.CASES,
    *discrete.CASES,
    *algebraic.CASES,
    *initialization.CASES,
    *homotopy.CASES,
    *smooth.CASES,
    *components.CASES,
    *constraints.CASES,
    *springs.CASES,
)
