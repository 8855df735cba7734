"""Experiments on the joystick: functions from settings to a table.

Every table is indexed by ``time`` (s) and has the outputs of the joystick's FMU as columns, in SI units; see
`pyjoystick.motion.tables` for units in its attrs.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from contextlib import nullcontext
from os import PathLike
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick import model  # lazily: its reference loads SciPy, which FMU runs do not need
from pyjoystick.fmu import Fmu, FmuDescription, UnsupportedFmuError
from pyjoystick.model import FRICTION_NAMES, NOMINAL, NOMINAL_POWER_LAW, STOP_NAMES, JoystickParameters
from pyjoystick.motion import DisplayUnit, Quantity, make_table
from pyjoystick.runs.joystick_fmus import fmu_of_joystick, law_of_fmu, require_si_units
from pyjoystick.support import (
    DEFAULT_DURATION,
    DEFAULT_OUTPUT_INTERVAL,
    DEFAULT_TOLERANCE,
    FloatArray,
    ParameterError,
    angle,
    positive,
)

_MOST_ROWS: Final = 10_000_000
_DEG: Final = math.degrees(1.0)
_QUANTITIES: Final = (
    Quantity("theta", "rad", DisplayUnit("deg", _DEG), "Angle, positive forward"),
    Quantity("omega", "rad/s", DisplayUnit("deg/s", _DEG), "Angular velocity"),
    Quantity("alpha", "rad/s2", DisplayUnit("deg/s2", _DEG), "Angular acceleration"),
    Quantity("x", "m", DisplayUnit("mm", 1e3), "Travel of the contact, positive for any angle"),
    Quantity("f_x", "N", None, "Contact force"),
    Quantity("M_s", "N.m", None, "Moment of the contact force"),
    Quantity("M_d", "N.m", None, "Damping moment"),
    Quantity("M_g", "N.m", None, "Moment of the weight"),
    Quantity("C", "N.m.s/rad", None, "Damping coefficient"),
    Quantity("E", "J", DisplayUnit("mJ", 1e3), "Energy, zero at rest in the middle"),
)

_FRICTION_QUANTITIES: Final = (
    Quantity("M_f", "N.m", None, "Friction moment"),
    Quantity("isStuck", "", None, "The joystick sticks"),
)

#: Columns of every table of the joystick.
COLUMNS: Final = tuple(quantity.name for quantity in _QUANTITIES)
#: Additional columns if the joystick has dry friction.
FRICTION_COLUMNS: Final = tuple(quantity.name for quantity in _FRICTION_QUANTITIES)


def free_oscillation(
    release_angle: float,
    *,
    fmu: str | PathLike[str] | Fmu | None = None,
    parameters: JoystickParameters | Mapping[str, float] | None = None,
    duration: float = DEFAULT_DURATION,
    output_interval: float = DEFAULT_OUTPUT_INTERVAL,
    tolerance: float = DEFAULT_TOLERANCE,
) -> pd.DataFrame:
    """Release the joystick from rest at an angle and let it oscillate: section 3.3 of the paper, on an FMU.

    Args:
        release_angle: initial angle (rad), positive forward, between -pi/2 and pi/2
        fmu: name or path of an FMU with the interface of ``Joystick``, or an open `Fmu`, which is faster for
            many runs; by default the one named by `fmu_of_joystick`
        parameters: the joystick, or values by the FMU's names (SI units); others keep the FMU's values
        duration: length of the run (s)
        output_interval: time between two rows (s), see `time_grid`
        tolerance: tolerance of the FMU's integrator

    Returns:
        a table with the columns `COLUMNS`, and `FRICTION_COLUMNS` if the FMU has dry friction

    Raises:
        ParameterError: an angle of pi/2 or more, a duration or a value that is not allowed
        UnknownParameterError: the FMU has no parameter of that name
        FmuNotFoundError, FmuFileError, UnsupportedFmuError: the FMU cannot be opened, or is not a joystick
        FmuRunError: the FMU rejects the parameters or fails
    """
    start = angle("release_angle", release_angle)
    time = time_grid(duration, output_interval)
    values = {} if isinstance(parameters, JoystickParameters) else dict(parameters or {})
    for name in ("theta_start", "omega_start"):
        if name in values:
            raise ParameterError(name, values[name], "left out", "a free oscillation starts at rest")
    if fmu is None:
        fmu = fmu_of_joystick(parameters if isinstance(parameters, JoystickParameters) else NOMINAL)
    with nullcontext(fmu) if isinstance(fmu, Fmu) else Fmu(fmu) as opened:
        require_joystick(opened.description)
        if isinstance(parameters, JoystickParameters):
            values = model.values_for(parameters, opened.description.variables)
        extra = FRICTION_COLUMNS if has_friction(opened.description) else ()
        return opened.run(
            time, parameters=values | {"theta_start": start}, outputs=(*COLUMNS, *extra), tolerance=tolerance
        )


def require_joystick(description: FmuDescription) -> None:
    """Raise `UnsupportedFmuError` unless the FMU has what a free oscillation sets and reads, in SI units."""
    missing = [name for name in ("theta_start", *COLUMNS) if name not in description.variables]
    if missing:
        reason = f"does not have the interface of Joystick: it lacks {', '.join(missing)}"
        raise UnsupportedFmuError(description.path, reason)
    require_si_units(description, (*description.settable_names(), *COLUMNS))


def reference_free_oscillation(
    release_angle: float,
    *,
    parameters: JoystickParameters = NOMINAL,
    duration: float = DEFAULT_DURATION,
    output_interval: float = DEFAULT_OUTPUT_INTERVAL,
) -> pd.DataFrame:
    """Run the experiment of `free_oscillation` on the pure-Python reference, accurate to 1e-10 rad.

    Args:
        release_angle: initial angle (rad), between -pi/2 and pi/2
        parameters: the joystick
        duration: length of the run (s)
        output_interval: time between two rows (s), see `time_grid`

    Returns:
        a table with the columns `COLUMNS`, and `FRICTION_COLUMNS` if `parameters` have dry friction;
        ``attrs["events"]`` lists the crossings of kinks and of the middle, and where the joystick sticks and
        slips, as dictionaries (time, kind, direction, theta, omega)

    Raises:
        ParameterError: an angle of pi/2 or more, or a duration that is not allowed
        SimulationError: the motion reaches pi/2
    """
    start = angle("release_angle", release_angle)
    time = time_grid(duration, output_interval)
    motion = model.simulate(parameters, time=time, theta_start=start)
    quantities = _QUANTITIES + (_FRICTION_QUANTITIES if parameters.friction else ())
    attributes = {"isStuck": "is_stuck"}
    columns = {one.name: getattr(motion, attributes.get(one.name, one.name)) for one in quantities}
    table = make_table(motion.time, columns, quantities)
    table.attrs["events"] = [dataclasses.asdict(event) for event in motion.events]
    return table


def joystick_of_fmu(description: FmuDescription) -> JoystickParameters:
    """Joystick given by the start values of an FMU.

    Raises:
        UnsupportedFmuError: the FMU lacks the parameters of a joystick, or has impossible values
    """
    nominal = NOMINAL if law_of_fmu(description) == "constant" else NOMINAL_POWER_LAW
    stops = STOP_NAMES if set(STOP_NAMES) <= set(description.variables) else ()
    names = (*nominal.to_names(), *stops, *(FRICTION_NAMES if has_friction(description) else ()))
    missing = [name for name in names if name not in description.variables]
    if missing:
        reason = f"does not have the parameters of Joystick: it lacks {', '.join(missing)}"
        raise UnsupportedFmuError(description.path, reason)
    try:
        return nominal.replace({name: float(description.variables[name].start or 0.0) for name in names})
    except ParameterError as error:
        raise UnsupportedFmuError(description.path, f"is not a joystick: {error}") from error


def has_friction(description: FmuDescription) -> bool:
    """Whether it has the parameters and outputs of dry friction, as ``JoystickFriction`` has."""
    return {*FRICTION_NAMES, *FRICTION_COLUMNS} <= set(description.variables)


def time_grid(duration: float, output_interval: float) -> FloatArray:
    """Times from 0 to `duration` (s), `output_interval` (s) apart; the last interval may be shorter.

    Raises:
        ParameterError: a value is not finite or not above zero, the interval is longer than the duration, or
            there would be more than ten million rows
    """
    end = positive("duration", duration, "s")
    step = positive("output_interval", output_interval, "s")
    if step > end:
        raise ParameterError("output_interval", output_interval, f"at most the duration, {end:g} s")
    count = end / step
    if count > _MOST_ROWS:
        least = f"at least {end / _MOST_ROWS:.3g} s for {end:g} s"
        raise ParameterError("output_interval", output_interval, least)
    whole = round(count)
    if abs(count - whole) <= 1e-9 * count:
        return np.arange(whole + 1) * end / whole
    return np.append(np.arange(math.floor(count) + 1) * step, end)
