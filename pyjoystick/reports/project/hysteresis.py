"""Dry friction along the plungers, from the hysteresis of the load-deflection curves."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Final

import numpy as np

from pyjoystick import laboratory, model
from pyjoystick.reports.project.steps import with_error

_F_C: Final = "friction.F_c"


def put_down(fit: laboratory.LoadCurveFit, side: model.Side) -> str:
    """Return a note on hysteresis that the project does not attribute to friction of the joystick."""
    friction = with_error(fit.friction, fit.friction_error)
    return (
        f"half the hysteresis, {friction} N, is attributed to friction in the testing machine; if it is that "
        f"of the plunger, friction = true in [load_curve.{side}] gives the joystick this dry friction"
    )


def one_friction(found: Iterable[laboratory.MeasuredValues]) -> laboratory.MeasuredValues:
    """Return F_c, a single value for the joystick: the mean over the curves that have it.

    Each value is weighted by the inverse square of its standard error. If the values differ by more than
    their errors allow, the error of the mean is enlarged accordingly, by the Birge ratio.
    """
    pairs = [(one.values[_F_C], one.uncertainties[_F_C]) for one in found if _F_C in one.values]
    if not pairs:
        return laboratory.MeasuredValues(values={}, uncertainties={}, sources={})
    values, errors = np.array(pairs).T
    mean = float(np.average(values, weights=errors**-2))
    error = float(np.sum(errors**-2) ** -0.5)
    ratio = math.sqrt(float(np.sum(((values - mean) / errors) ** 2)) / max(len(values) - 1, 1))
    error *= max(ratio, 1.0)
    return laboratory.MeasuredValues(
        values={_F_C: model.rounded(mean, error)}, uncertainties={_F_C: error}, sources={}
    )
