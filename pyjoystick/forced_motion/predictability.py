"""Predictability: until when a driven motion can be trusted, as errors grow in chaotic motion."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.fmu import Fmu, Inputs, Value
from pyjoystick.support import DEFAULT_TOLERANCE, ParameterError, positive

#: Largest trusted difference, relative to the largest angle.
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
    """Time at which the error of a run has grown to 1 % of the largest angle (s); infinite if it does not.

    The joystick is run twice, the second time from an angle that differs by the tolerance, which is about the
    error of a run. After this time, two tools, machines or tolerances need not agree on the angle;
    amplitude, mean and spectrum may still be right.

    Args:
        fmu: FMU of a joystick, with output ``theta`` and start value ``theta_start``
        time: times (s), shape (n,), n >= 2, increasing
        theta_start: initial angle (rad)
        inputs: as in `Fmu.run`
        parameters: as in `Fmu.run`, except ``theta_start``
        tolerance: tolerance of the integrator, and difference of the initial angles (rad)

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
