"""Joystick parameters from the results of measurements."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Final

from pyjoystick.laboratory.inertia.budget import Estimate, Measured
from pyjoystick.laboratory.inertia.parts import PartsResult
from pyjoystick.laboratory.load_curve.fit import LoadCurveFit
from pyjoystick.laboratory.measured_values import PLACES, MeasuredValues
from pyjoystick.model import NOMINAL, ActuatorAssembly, Side, rounded
from pyjoystick.motion import RecordError
from pyjoystick.support import ParameterError

#: Friction is significant from this many standard errors.
_CLEAR: Final = 2.0


def measured_springs(fit: LoadCurveFit, side: Side, source: str) -> MeasuredValues:
    """Springs of one side from its load-deflection curve.

    Raises:
        ParameterError: not four segments, or stiffnesses that no pair of restrained springs has
    """
    errors = {"x": fit.x_errors.tolist(), "k": fit.k_errors.tolist()}
    x, k = (
        [rounded(value, error) for value, error in zip(getattr(fit.table, key), errors[key], strict=True)]
        for key in ("x", "k")
    )
    try:
        assembly = ActuatorAssembly.from_table(x, k)
    except ParameterError as error:
        raise error.within(side) from None
    names = dataclasses.replace(NOMINAL, forward=assembly, backward=assembly).to_names()
    return MeasuredValues(
        values={name: value for name, value in names.items() if name.startswith(f"{side}.")},
        uncertainties={
            f"{side}.{key}[{i}]": error for key, of_key in errors.items() for i, error in enumerate(of_key)
        },
        sources={side: source},
    )


def measured_friction(fit: LoadCurveFit, source: str) -> MeasuredValues:
    """Dry friction along the plunger, F_c, from the hysteresis of a load-deflection curve.

    It is half the difference between loading and unloading, and includes the testing machine's own friction.

    Raises:
        RecordError: unloading was not recorded, or the friction differs from 0 by less than two standard
            errors
    """
    if fit.curve.unloading is None:
        raise RecordError(fit.curve.source, "has no unloading", "record the way back too for its friction")
    if fit.friction < _CLEAR * fit.friction_error:
        reason = f"shows no friction: {fit.friction:.2g} N +- {fit.friction_error:.1g} N"
        raise RecordError(fit.curve.source, reason, "leave out --friction, or friction = true in a project")
    return MeasuredValues(
        values={"friction.F_c": rounded(fit.friction, fit.friction_error)},
        uncertainties={"friction.F_c": fit.friction_error},
        sources={"friction": source},
    )


def measured_parts(found: PartsResult, source: str) -> MeasuredValues:
    """Mass, center of mass and moment of inertia from the parts."""
    return _of_body({"m": found.m, "h": found.h, "J": found.J}, source)


def measured_swing(inertia: Estimate, known: Mapping[str, Measured], source: str) -> MeasuredValues:
    """Moment of inertia from a swing test, and the values used to compute it.

    Args:
        inertia: J
        known: m, h and g, as used
        source: the swing test
    """
    return _of_body({**known, "J": inertia}, source, exact=tuple(known))


def _of_body(
    found: Mapping[str, Estimate | Measured], source: str, exact: tuple[str, ...] = ()
) -> MeasuredValues:
    """Single-number parameters; those in `exact` are not rounded."""
    uncertain = {name: one.uncertainty for name, one in found.items() if one.uncertainty > 0.0}
    return MeasuredValues(
        values={
            name: one.value if name in exact else rounded(one.value, one.uncertainty)
            for name, one in found.items()
        },
        uncertainties={PLACES[name]: error for name, error in uncertain.items()},
        sources={"body": source},
    )
