"""A fit that starts from a joystick whose parameters are known in part."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from pyjoystick.fmu import Value
from pyjoystick.identification.fitting.settings import FitSettings


def with_values(
    settings: FitSettings, values: Mapping[str, Value], *, replace_starts: bool = False
) -> FitSettings:
    """The settings with values for all that they leave to the FMU.

    Args:
        settings: what they fix or tie themselves stays
        values: parameters by name, in the units of the FMU: fixed where they are not fitted, and the start of
            the search where they are
        replace_starts: whether they go before starts that the settings give

    Raises:
        ParameterError: a start is outside the bounds of the fit
    """
    fitted = {one.name for one in settings.free}
    free = tuple(
        dataclasses.replace(one, start=float(values[one.name]))
        if one.name in values and (replace_starts or one.start is None)
        else one
        for one in settings.free
    )
    fixed = {
        name: value for name, value in values.items() if name not in fitted and name not in settings.ties
    }
    return dataclasses.replace(settings, free=free, fixed=fixed | dict(settings.fixed))
