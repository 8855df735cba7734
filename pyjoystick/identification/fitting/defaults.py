"""Settings for the joystick where none are given: the damping, with a release of its own for each record."""

from __future__ import annotations

import dataclasses
from typing import Final

from pyjoystick.identification.fitting.settings import RELEASE_TIME, FitSettings, Free, Search, Uncertainty

#: The release of each record: its angle and its instant.
RELEASE: Final = (Free("theta_start", per_record=True), Free(RELEASE_TIME, per_record=True))

#: A constant damping coefficient.
CONSTANT_DAMPING: Final = FitSettings(
    fmu="Joystick", free=(Free("damping.C", start=0.05, minimum=0.0, maximum=0.5), *RELEASE)
)

#: Eq. (11). Only the products alpha*A and (1 - alpha)*B act on the motion, so that alpha cannot be fitted
#: beside A and B: it is fixed at the paper's 0.9.
POWER_LAW_DAMPING: Final = FitSettings(
    fmu="JoystickPowerLaw",
    fixed={"damping.alpha": 0.9},
    free=(
        Free("damping.A_pos", start=0.05, minimum=0.0, maximum=1.0),
        Free("damping.n_pos", start=0.0, minimum=-1.0, maximum=1.0),
        Free("damping.A_neg", start=0.05, minimum=0.0, maximum=1.0),
        Free("damping.n_neg", start=0.0, minimum=-1.0, maximum=1.0),
        Free("damping.B", start=0.05, minimum=0.0, maximum=1.0),
        Free("damping.m", start=0.0, minimum=-1.0, maximum=1.0),
        *RELEASE,
    ),
    # With the sides exchanged eq. (11) has a second minimum that looks right at 0.1 degree of noise.
    search=Search(exchanges=(("damping.A_pos", "damping.A_neg"), ("damping.n_pos", "damping.n_neg"))),
    # Six parameters along a curved valley: their profiles take minutes, and are there where asked for.
    uncertainty=Uncertainty(profiles=()),
)

#: The displacement terms of eq. (11) alone, at alpha = 1: four records of 0.1 degree of noise determine them.
DISPLACEMENT_DAMPING: Final = dataclasses.replace(
    POWER_LAW_DAMPING,
    fixed={"damping.alpha": 1.0},
    free=tuple(one for one in POWER_LAW_DAMPING.free if one.name not in ("damping.B", "damping.m")),
)
