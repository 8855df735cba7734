"""The fitted joystick, with uncertainties of the numbers in its parameter file."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Final

import numpy as np

from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.result import Fit
from pyjoystick.model import (
    FRICTION_NAMES,
    NOMINAL,
    NOMINAL_POWER_LAW,
    PLAIN_TABLES,
    SIDES,
    STOP_NAMES,
    JoystickParameters,
    LawName,
    ParameterFile,
    fmu_values,
    law_name,
    rounded,
    rounded_error,
)
from pyjoystick.support import FloatArray, ParameterError

#: Every parameter that a joystick may have.
_NAMES: Final = frozenset((*NOMINAL.to_names(), *NOMINAL_POWER_LAW.to_names(), *FRICTION_NAMES, *STOP_NAMES))
#: Relative step for derivatives of the file's numbers, which are sums and quotients of parameters.
_STEP: Final = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedJoystick:
    """The joystick that follows from a fit.

    Attributes:
        joystick: its parameters: fitted and tied ones (to a hundredth of the standard error), those fixed in
            the fit, and otherwise those of the initial joystick
        uncertainties: standard errors of fitted numbers, to two digits, by place in a parameter file, as in
            `ParameterFile.uncertainties`; for a curve, either all or none
        tables: names of the file's tables with fitted numbers
        fixed: names of other tables with numbers changed by the settings of the fit
    """

    joystick: JoystickParameters
    uncertainties: Mapping[str, float]
    tables: tuple[str, ...]
    fixed: tuple[str, ...]


def require_joystick_in(settings: FitSettings) -> None:
    """Check before a fit that its result can be a joystick.

    Raises:
        FitError: no joystick parameter is fitted for all records together, or one is fitted for each record
    """
    own = [one.name for one in settings.free if one.per_record and one.name in _NAMES]
    if own:
        raise _one_for_each_record(own)
    if not any(name in _NAMES for name in (*(one.name for one in settings.free), *settings.ties)):
        raise FitError("the joystick", "none of its parameters is fitted, so there is nothing to save")


def _one_for_each_record(names: Iterable[str]) -> FitError:
    reason = "each record has a value of its own and the joystick has one: fit it without per_record"
    return FitError(", ".join(dict.fromkeys(names)), reason)


def known_values(
    file: ParameterFile, law: LawName, names: Sequence[str]
) -> tuple[dict[str, float], dict[str, float]]:
    """Collect the measured values that a fit counts as additional measurements, for `with_known`.

    Args:
        file: the parameter file with the values, their uncertainties and their sources
        law: damping law of the fit
        names: parameters by their FMU names, or patterns such as ``*Spring.x_0``, which stand for every
            matching parameter that has an uncertainty

    Returns:
        values and standard uncertainties in SI units, by name

    Raises:
        ParameterError: a parameter has no uncertainty, or comes from a fit, whose records would count twice;
            or a pattern matches none
    """
    stated = {one.name: one for one in fmu_values(file, law) if one.uncertainty}
    measured = {name: one for name, one in stated.items() if "fit to " not in one.source}
    found = {}
    for name in names:
        if name in stated and name not in measured:
            reason = f"{file.path} has it from a {stated[name].source}; records must not count twice"
            raise ParameterError("known", name, f"measured without a fit: {reason}")
        matching = [one for one in measured.values() if fnmatchcase(one.name, name)]
        if not matching:
            raise ParameterError(
                "known",
                name,
                f"one that {file.path} gives with an uncertainty: {', '.join(measured) or 'none'}",
            )
        found.update({one.name: one for one in matching})
    values = {name: one.value for name, one in found.items()}
    return values, {name: one.uncertainty or 0.0 for name, one in found.items()}


def fitted_joystick(
    fit: Fit, before: JoystickParameters, uncertainties: Mapping[str, float] | None = None
) -> FittedJoystick:
    """Derive the joystick from a fit.

    Args:
        fit: a fit of an FMU of the joystick
        before: the initial joystick, with the damping law of the FMU
        uncertainties: its uncertainties, by place; they are kept for curves that the fit leaves alone

    Raises:
        FitError: as `require_joystick_in`
        ParameterError: the values do not describe a joystick
    """
    require_joystick_in(fit.settings)
    own = [one.name for one in fit.derived if one.record and one.name in _NAMES]
    if own:
        raise _one_for_each_record(own)
    fixed = {name: float(value) for name, value in fit.settings.fixed.items() if name in _NAMES}
    joystick = before.replace({**fixed, **_values(fit)})
    found = _uncertainties(fit, joystick)
    curves = {_list_of(place) for place in found if _list_of(place)}
    kept = {
        place: (uncertainties or {}).get(place, 0.0)
        for place in _numbers(joystick)
        if _list_of(place) in curves
    }
    errors = kept | found
    # An undetermined value has no standard error, and a list is written whole or not at all.
    broken = {_list_of(place) or place for place, error in errors.items() if not math.isfinite(error)}
    tables = _tables(found)
    numbers = _numbers(before)
    changed = [place for place, value in _numbers(joystick).items() if value != numbers[place]]
    return FittedJoystick(
        joystick=joystick,
        uncertainties={
            place: rounded_error(error)
            for place, error in errors.items()
            if (_list_of(place) or place) not in broken
        },
        tables=tables,
        fixed=tuple(table for table in _tables(changed) if table not in tables),
    )


def _tables(places: Iterable[str]) -> tuple[str, ...]:
    """The tables that contain the given places, without repeats."""
    return tuple(dict.fromkeys(place.rpartition(".")[0] for place in places))


def _list_of(place: str) -> str:
    """List of a place, such as ``forward.x`` of ``forward.x[2]``; empty if the place is not in a list."""
    return place.partition("[")[0] if place.endswith("]") else ""


def _values(fit: Fit) -> dict[str, float]:
    """Fitted parameters of the joystick, and those tied to them."""
    found = {name: rounded(value, fit.error(name)) for name, value in fit.shared().items()}
    found |= {one.name: rounded(one.value, one.error) for one in fit.derived}
    return {name: value for name, value in found.items() if name in _NAMES}


def _uncertainties(fit: Fit, joystick: JoystickParameters) -> dict[str, float]:
    """Standard errors of the file's numbers that depend on what was fitted, by place."""
    units = np.eye(len(fit.variables))
    slopes = {one.name: units[j] for j, one in enumerate(fit.variables)}
    slopes |= {one.name: one.slope for one in fit.derived}
    gradients: dict[str, FloatArray] = {}
    for name in _values(fit):
        for place, derivative in _derivatives(joystick, name).items():
            if derivative != 0.0:
                gradients[place] = gradients.get(place, 0.0) + derivative * slopes[name]
    return {place: fit.standard_errors.of(gradient) for place, gradient in gradients.items()}


def _derivatives(joystick: JoystickParameters, name: str) -> dict[str, float]:
    """Derivatives of the file's numbers with respect to a parameter, one-sided at the edge of its range."""
    value = _values_of(joystick)[name]
    step = _STEP * (abs(value) or 1.0)
    ends = []
    for moved in (value - step, value + step, value):
        try:
            ends.append((moved, _numbers(joystick.replace({name: moved}))))
        except ParameterError:
            continue
    (low, below), (high, above) = ends[:2]
    return {place: (above[place] - below[place]) / (high - low) for place in below}


def _values_of(joystick: JoystickParameters) -> dict[str, float]:
    """Parameters by name, including those of absent friction and stops."""
    return joystick.to_names() | {
        f"{part}.{name}": float(value)
        for part in ("friction", "stops")
        for name, value in dataclasses.asdict(getattr(joystick, part)).items()
    }


def _numbers(joystick: JoystickParameters) -> dict[str, float]:
    """Numbers in the parameter file of a joystick, by place."""
    names = _values_of(joystick)
    law = f"damping.{law_name(joystick.damping)}"
    found = {
        f"{table}.{key}": names[key] for table, keys in PLAIN_TABLES.items() for key in keys if key in names
    }
    found |= {
        f"{law}.{name.removeprefix('damping.')}": value
        for name, value in names.items()
        if name.startswith("damping.")
    }
    found |= {name: names[name] for name in (*FRICTION_NAMES, *STOP_NAMES)}
    for side in SIDES:
        curve = getattr(joystick, side).to_table()
        for key, values in (("x", curve.x), ("k", curve.k)):
            found |= {f"{side}.{key}[{i}]": value for i, value in enumerate(values)}
    return found
