"""Adding known values to the settings of a fit."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from pyjoystick.fmu import Value
from pyjoystick.identification.fitting.problem.settings import FitSettings, Free


def with_values(
    settings: FitSettings, values: Mapping[str, Value], *, replace_starts: bool = False
) -> FitSettings:
    """Fill in values for everything that the settings leave to the FMU.

    Args:
        settings: what they fix or tie themselves stays
        values: parameters by name, in the units of the FMU: fixed where they are not fitted, and the start of
            the search where they are
        replace_starts: whether they go before starts that the settings give, and bounds give way to them

    Raises:
        ParameterError: a start is outside the bounds of the fit
    """
    fitted = {one.name for one in settings.free}
    free = tuple(
        _started(one, float(values[one.name]), replaced=replace_starts)
        if one.name in values and (replace_starts or one.start is None)
        else one
        for one in settings.free
    )
    fixed = {
        name: value for name, value in values.items() if name not in fitted and name not in settings.ties
    }
    return dataclasses.replace(settings, free=free, fixed=fixed | dict(settings.fixed))


def _started(free: Free, start: float, *, replaced: bool) -> Free:
    return free.starting_at(start) if replaced else dataclasses.replace(free, start=start)


def with_known(
    settings: FitSettings, values: Mapping[str, float], uncertainties: Mapping[str, float]
) -> FitSettings:
    """Fit parameters that were also measured: each measured value counts as one measurement.

    Args:
        settings: parameters that they fix or do not mention become free
        values: measured values, in the units of the FMU
        uncertainties: their standard uncertainties, by the same names

    Raises:
        ParameterError: an uncertainty is not above 0, or the parameter is tied or fitted for each record
    """
    given = {one.name: one for one in settings.free}
    known = {
        name: dataclasses.replace(given.get(name, Free(name)), start=value, uncertainty=uncertainties[name])
        for name, value in values.items()
    }
    return dataclasses.replace(
        settings,
        free=(
            *(known.get(one.name, one) for one in settings.free),
            *(one for name, one in known.items() if name not in given),
        ),
        fixed={name: value for name, value in settings.fixed.items() if name not in known},
    )
