"""How long a driven motion can be predicted: where it is chaotic, every error grows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.fmu import Fmu, Inputs, Value
from pyjoystick.support import DEFAULT_TOLERANCE, ParameterError, positive

#: The part of the largest angle that a difference must not exceed.
SMALL: Final = 0.01


def trusted_until(
    fmu: Fmu,
    time: ArrayLike,
    *,
    theta_start: float = 0.0,
    inputs: Inputs | None = None,
    parameters: Mapping[str, Value] | None = None,
    tolerance: float = DEFAULT_TOLERANCE,
) -> float:
    """When the error of a run has grown to 1 % of the largest angle (s); infinite if it does not.

    The joystick is run twice, the second time from an angle that is larger by as much as the tolerance, which
    is about the error of a run. Later than this instant two tools, two machines or two tolerances need not
    agree on the angle; amplitude, mean and spectrum may still be right.

    Args:
        fmu: of a joystick: ``theta`` is an output, and ``theta_start`` its start value
        time: instants (s), shape (n,), n >= 2, increasing
        theta_start: the angle at the start (rad)
        inputs: as for `Fmu.run`
        parameters: as for `Fmu.run`, but ``theta_start``
        tolerance: of the integrator, and the difference of the angles at the start (rad)

    Raises:
        ParameterError: the tolerance is not above zero, or the joystick does not move
        UnknownParameterError, UnknownVariableError: the FMU is not of a joystick
        SeriesError, FmuEndedError, FmuTimeLimitError, FmuCrashError, FmuRunError: as `Fmu.run`
    """
    shift = positive("tolerance", tolerance, "rad")
    first, second = (
        fmu.run(
            time,
            inputs=inputs,
            parameters={**(parameters or {}), "theta_start": start},
            outputs=("theta",),
            tolerance=tolerance,
        )["theta"]
        for start in (theta_start, theta_start + shift)
    )
    largest = float(first.abs().max())
    if largest == 0.0:
        raise ParameterError("inputs", inputs, "such as move the joystick, which stays at 0 with these")
    far = np.flatnonzero(np.asarray((second - first).abs()) > SMALL * largest)
    return float(first.index[far[0]]) if len(far) else math.inf
