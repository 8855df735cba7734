"""The torque required for a motion, eq. (13), computed by the inverse FMUs or in plain Python."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from os import PathLike
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu, UnsupportedFmuError
from pyjoystick.forced_motion.samples import Samples
from pyjoystick.model import (
    PIVOT_TO_TOP,
    STOP_NAMES,
    ConstantDamping,
    Damping,
    JoystickParameters,
    inverse_torque,
    require_within_stops,
)
from pyjoystick.motion import DisplayUnit, Quantity, make_table
from pyjoystick.support import FloatArray, positive

#: The torque and its parts.
TORQUES: Final = ("T", "T_inertia", "T_damping", "T_stiffness")
#: Additional columns if the joystick has dry friction.
FRICTION_TORQUES: Final = ("T_friction", "T_band")
MOTION: Final = ("theta", "omega", "alpha")

_DEG: Final = float(np.degrees(1.0))
_QUANTITIES: Final = (
    Quantity("theta", "rad", DisplayUnit("deg", _DEG), "Angle, positive forward"),
    Quantity("omega", "rad/s", DisplayUnit("deg/s", _DEG), "Angular velocity"),
    Quantity("alpha", "rad/s2", DisplayUnit("deg/s2", _DEG), "Angular acceleration"),
    Quantity("T", "N.m", None, "Torque about the pivot that the motion needs"),
    Quantity("T_inertia", "N.m", None, "Part of it that accelerates the handle"),
    Quantity("T_damping", "N.m", None, "Part of it that overcomes the damping"),
    Quantity("T_stiffness", "N.m", None, "Part of it that holds springs and weight"),
    Quantity("T_friction", "N.m", None, "Part of it that overcomes dry friction"),
    Quantity("T_band", "N.m", None, "At rest, how far T may lie to either side, held by friction"),
    Quantity("F", "N", None, "Force at the top of the handle, at right angles to it"),
)


def torque_by_reference(
    joystick: JoystickParameters, samples: Samples, *, pivot_to_handle: float = PIVOT_TO_TOP
) -> pd.DataFrame:
    """Compute eq. (13) in plain Python.

    Args:
        joystick: parameters of the joystick
        samples: the motion
        pivot_to_handle: distance from the pivot to the hand (m), by default the top of Table 2

    Returns:
        a table indexed by ``time`` (s) with the motion, torque ``T`` and its parts (`columns_of`), and the
        force ``F`` at the handle; `make_table` describes the units in its attrs

    Raises:
        ParameterError: some |theta| >= pi/2 or beyond a stop, or the distance is not above 0
    """
    torque = inverse_torque(joystick, samples.theta, samples.omega, samples.alpha)
    return _table(samples, {name: getattr(torque, name) for name in columns_of(joystick)}, pivot_to_handle)


def torque_by_fmu(
    joystick: JoystickParameters,
    samples: Samples,
    *,
    fmu: str | PathLike[str] | Fmu | None = None,
    pivot_to_handle: float = PIVOT_TO_TOP,
) -> pd.DataFrame:
    """Compute the same table with ``JoystickInverse`` or ``JoystickInversePowerLaw`` in Co-Simulation.

    The FMU has no states: its outputs depend only on the current motion. Samples are fed to it at intervals
    of one second, which separates the two samples at a jump.

    Args:
        joystick: parameters of the joystick
        samples: the motion
        fmu: name or path of an FMU with the interface of ``JoystickInverse``, or an open `Fmu`; by default
            the one with the damping law of `joystick`
        pivot_to_handle: distance from the pivot to the hand (m)

    Raises:
        FmuNotFoundError, FmuFileError, UnsupportedFmuError: the FMU cannot be opened, or is not an inverse
            one
        UnknownParameterError: it has another damping law
        FmuRunError: it rejects the parameters or an angle
        ParameterError: some |theta| is beyond a stop, or the distance is not above 0
    """
    require_within_stops(joystick, samples.theta)
    count = np.arange(len(samples), dtype=np.float64)
    motion = pd.DataFrame({name: getattr(samples, name) for name in MOTION}, index=count)
    chosen = inverse_fmu(joystick.damping) if fmu is None else fmu
    with nullcontext(chosen) if isinstance(chosen, Fmu) else Fmu(chosen) as opened:
        wanted = columns_of(joystick)
        missing = {*MOTION, *wanted} - set(opened.description.variables)
        if missing:
            reason = f"does not have the interface of JoystickInverse: it lacks {', '.join(sorted(missing))}"
            raise UnsupportedFmuError(opened.description.path, reason)
        table = opened.run(count, parameters=inverse_values(joystick), inputs=motion, outputs=wanted)
    return _table(samples, {name: table[name].to_numpy() for name in wanted}, pivot_to_handle)


def columns_of(joystick: JoystickParameters) -> tuple[str, ...]:
    """Torque columns of a joystick's tables: `TORQUES`, and `FRICTION_TORQUES` if it has dry friction."""
    return (*TORQUES, *(FRICTION_TORQUES if joystick.friction else ()))


def inverse_values(joystick: JoystickParameters) -> dict[str, float]:
    """Parameters (SI units) by name in the inverse FMU, which has no stops."""
    return {name: value for name, value in joystick.to_names().items() if name not in STOP_NAMES}


def inverse_fmu(damping: Damping) -> str:
    """Name of the inverse FMU of a damping law: ``JoystickInverse`` or ``JoystickInversePowerLaw``."""
    return "JoystickInverse" if isinstance(damping, ConstantDamping) else "JoystickInversePowerLaw"


def _table(samples: Samples, torques: Mapping[str, FloatArray], pivot_to_handle: float) -> pd.DataFrame:
    force = torques["T"] / positive("pivot_to_handle", pivot_to_handle, "m")
    motion = {name: getattr(samples, name) for name in MOTION}
    columns = {**motion, **torques, "F": force}
    return make_table(samples.time, columns, [one for one in _QUANTITIES if one.name in columns])
