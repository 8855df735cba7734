"""Logging of an FMU's runs and the values set on it."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.values import Value
from pyjoystick.support import FloatArray

_LOG = logging.getLogger(__name__)


def log_runs(
    description: FmuDescription,
    time: FloatArray,
    parameters: Mapping[str, Value],
    varied: Sequence[str],
    tolerance: float,
) -> None:
    """Log one run at level INFO, or many with varied values at level DEBUG, as fits prepare hundreds of them.

    Args:
        description: the FMU
        time: sample times (s), shape (n,)
        parameters: values by name
        varied: names of the parameters that vary from run to run
        tolerance: tolerance of the integrator
    """
    level = logging.DEBUG if varied else logging.INFO
    if _LOG.isEnabledFor(level):
        _LOG.log(
            level,
            "%s from %g to %g s, %d samples, tolerance %g; set: %s; varied: %s",
            description.path.name,
            time[0],
            time[-1],
            len(time),
            tolerance,
            _changed(description, parameters) or "nothing",
            ", ".join(varied) or "nothing",
        )


def _changed(description: FmuDescription, parameters: Mapping[str, Value]) -> str:
    """Values that differ from the FMU's own by more than rounding, as text."""
    return ", ".join(
        f"{name} = {value}" for name, value in parameters.items() if not _is_own(description, name, value)
    )


def _is_own(description: FmuDescription, name: str, value: Value) -> bool:
    variable = description.find(name)
    own = None if variable is None else variable.start
    try:
        return own is not None and math.isclose(float(own), float(value), rel_tol=1e-12)
    except ValueError:  # a text, or an array
        return own == value
