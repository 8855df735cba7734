"""Settings for fits of the joystick: free parameters by damping law, dry friction and kind of record."""

from __future__ import annotations

import dataclasses
from typing import Final

from pyjoystick.identification.fitting.problem.instrument import DELAY, RELEASE_TIME, ZERO_OFFSET
from pyjoystick.identification.fitting.problem.settings import FitSettings, Free, Search, Uncertainty
from pyjoystick.model import NOMINAL, JoystickParameters
from pyjoystick.runs import FMU_WITH_FRICTION
from pyjoystick.support import ParameterError

#: Numbers of each record of a release: its angle, its time, and the reading in the middle position.
RELEASE: Final = (
    Free("theta_start", per_record=True),
    Free(RELEASE_TIME, per_record=True),
    Free(ZERO_OFFSET, per_record=True),
)

#: A constant damping coefficient.
CONSTANT_DAMPING: Final = FitSettings(
    fmu="Joystick", free=(Free("damping.C", start=0.05, minimum=0.0, maximum=0.5), *RELEASE)
)

#: Eq. (11). Only the products alpha*A and (1 - alpha)*B affect the motion, so alpha cannot be fitted together
#: with A and B: it is fixed at the paper's 0.9.
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
    # With the sides exchanged, eq. (11) has a second minimum that looks right at 0.1 degree of noise.
    search=Search(exchanges=(("damping.A_pos", "damping.A_neg"), ("damping.n_pos", "damping.n_neg"))),
    # Six parameters along a curved valley: their profiles take minutes and are computed only on request.
    uncertainty=Uncertainty(profiles=()),
)

#: The displacement terms of eq. (11) alone (alpha = 1); four records with 0.1 degree of noise determine them.
DISPLACEMENT_DAMPING: Final = dataclasses.replace(
    POWER_LAW_DAMPING,
    fixed={"damping.alpha": 1.0},
    free=tuple(one for one in POWER_LAW_DAMPING.free if one.name not in ("damping.B", "damping.m")),
)

#: Numbers of each record of a driven motion: where it starts, at rest, and the reading in the middle.
DRIVEN: Final = (Free("theta_start", per_record=True), Free(ZERO_OFFSET, per_record=True))
_DRIVEN_STAGES: Final = (0.1, 0.2, 0.4, 0.7)


def driven(settings: FitSettings) -> FitSettings:
    """Adapt settings for releases to records that contain the driving torque, column ``T``.

    The torque sets the scale of all moments, so that the moment of inertia can be fitted too, as can the
    delay of the angle behind the torque, which all records share. Records start at rest unless `omega_start`
    is also made free.
    """
    own = tuple(one for one in settings.free if not one.per_record)
    delay = Free(DELAY, start=0.0, minimum=-0.05, maximum=0.05)
    return dataclasses.replace(
        settings,
        free=(*own, Free("J"), delay, *DRIVEN),
        inputs=("T",),
        # A driven joystick passes the middle repeatedly, at times that affect all that follows.
        search=dataclasses.replace(settings.search, stages=_DRIVEN_STAGES),
    )


#: Dry friction at the pivot (N m) and along the plungers in contact (N).
PIVOT_FRICTION: Final = Free("friction.T_c", start=5e-3, minimum=0.0, maximum=1.0)
PLUNGER_FRICTION: Final = Free("friction.F_c", start=0.2, minimum=0.0, maximum=50.0)


#: The parameters that a load cell measures: the preload and the stiffnesses of each spring.
SPRING_FORCES: Final = tuple(name for name in NOMINAL.to_names() if name.endswith((".F_0", ".k_s", ".k_h")))
FORCE_SCALE: Final = "force_scale"


def scaled_forces(joystick: JoystickParameters, factor: float) -> JoystickParameters:
    """The joystick with all forces of the springs multiplied by a factor, as by a load cell that is off."""
    values = joystick.to_names()
    return joystick.replace({name: factor * values[name] for name in SPRING_FORCES})


def with_force_scale(settings: FitSettings, joystick: JoystickParameters, uncertainty: float) -> FitSettings:
    """Fit a common factor of the springs' forces: 1 within the uncertainty of the load cell's calibration.

    Args:
        settings: they leave the forces of the springs alone
        joystick: the measured springs
        uncertainty: relative standard uncertainty

    Raises:
        ParameterError: the uncertainty is not above 0, or a force is fitted or tied already
    """
    taken = {one.name for one in settings.free} | set(settings.ties)
    for name in SPRING_FORCES:
        if name in taken:
            raise ParameterError(name, "fitted or tied", f"left to {FORCE_SCALE}")
    values = joystick.to_names()
    return dataclasses.replace(
        settings,
        free=(*settings.free, Free(FORCE_SCALE, start=1.0, uncertainty=uncertainty)),
        ties={**settings.ties, **{name: f"{values[name]!r}*{FORCE_SCALE}" for name in SPRING_FORCES}},
        fixed={name: value for name, value in settings.fixed.items() if name not in SPRING_FORCES},
    )


def with_friction(settings: FitSettings, *friction: Free) -> FitSettings:
    """Add dry friction to the settings, by default only that at the pivot.

    Raises:
        ParameterError: the FMU has no counterpart with friction
    """
    if settings.fmu not in FMU_WITH_FRICTION:
        raise ParameterError("fmu", settings.fmu, f"one of {', '.join(FMU_WITH_FRICTION)}")
    free = (*settings.free, *(friction or (PIVOT_FRICTION,)))
    return dataclasses.replace(settings, fmu=FMU_WITH_FRICTION[settings.fmu], free=free)
