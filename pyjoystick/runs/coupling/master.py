"""Co-simulation master: FMUs step in parallel and exchange signals at communication points."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
import pandas as pd

from pyjoystick.motion import Quantity, make_table
from pyjoystick.runs.coupling.network import Network
from pyjoystick.runs.coupling.schemes import SCHEMES, Past
from pyjoystick.runs.coupling.system import CoupledSystem
from pyjoystick.support import DEFAULT_TOLERANCE, ParameterError, UnknownVariableError, positive

_MOST_STEPS = 10_000_000


def run_coupled(
    system: CoupledSystem,
    *,
    step: float = 1e-3,
    scheme: str = "hold",
    outputs: Iterable[str] | None = None,
    duration: float | None = None,
    tolerance: float = DEFAULT_TOLERANCE,
) -> pd.DataFrame:
    """Run a system of FMUs by co-simulation from 0 s.

    All FMUs step independently from one communication point to the next (Jacobi's method); outputs are then
    copied to the connected inputs.

    Args:
        system: the FMUs and their connections
        step: communication step H (s); the last one is shorter if it does not divide the duration
        scheme: what the FMUs know of their inputs within a step, a name in `SCHEMES`. FMI 3.0 FMUs have no
            input derivatives, so they only support ``delay`` and ``hold``.
        outputs: variables to record as ``component.variable``; by default all outputs of all components
        duration: end of the run (s); by default the system's stop time
        tolerance: tolerance of the FMUs' own integrators

    Returns:
        a table with a row for every communication point, the first at 0; ``attrs["steps"]`` is the total
        number of FMU steps

    Raises:
        ParameterError: the step, duration, tolerance or scheme is not allowed
        UnknownVariableError: an output does not exist
        CouplingError, FmuNotFoundError, FmuFileError, UnknownParameterError: as `CoupledSystem.describe`, or
            a step cannot be made by the scheme
        UnsupportedFmuError: an FMU lacks what coupled runs or the scheme need
        FmuRunError: an FMU fails
    """
    end = positive("duration", system.stop_time if duration is None else duration, "s")
    points = communication_points(positive("step", step, "s"), end)
    positive("tolerance", tolerance)
    if scheme not in SCHEMES:
        raise ParameterError("scheme", scheme, f"one of {', '.join(SCHEMES)}")
    way = SCHEMES[scheme]
    with Network(system, tolerance) as network:
        way.require(network)
        recorded = _recorded(network, outputs)
        rows = np.empty((len(points), len(recorded)))
        past: Past | None = None
        signals = way.exchange(network)
        for i, time in enumerate(points):
            if i:
                way.advance(network, points[i - 1], time, signals, past)
                past = Past(time - points[i - 1], signals)
                signals = way.exchange(network)
            rows[i] = [network.participants[name].get([variable])[0] for name, variable in recorded]
        steps = sum(participant.steps for participant in network.participants.values())
        quantities = [_quantity(network, name, variable) for name, variable in recorded]
    names = [quantity.name for quantity in quantities]
    table = make_table(points, dict(zip(names, rows.T, strict=True)), quantities)
    table.attrs["steps"] = steps
    return table


def communication_points(step: float, end: float) -> list[float]:
    """Times from 0 to `end` (s), `step` (s) apart; the last interval may be shorter.

    Raises:
        ParameterError: there would be more than ten million
    """
    count = end / step * (1.0 - 1e-12)
    if count > _MOST_STEPS:
        raise ParameterError("step", step, f"{end / _MOST_STEPS:g} s or more for a run of {end:g} s")
    count = math.ceil(count)
    return [i * step for i in range(count)] + [end]


def _recorded(network: Network, outputs: Iterable[str] | None) -> list[tuple[str, str]]:
    described = {name: participant.description for name, participant in network.participants.items()}
    known = [f"{name}.{variable}" for name, one in described.items() for variable in one.variables]
    if outputs is None:
        outputs = [
            f"{name}.{variable}" for name, one in described.items() for variable in one.names("output")
        ]
    chosen = list(dict.fromkeys([outputs] if isinstance(outputs, str) else outputs))
    for path in chosen:
        if path not in known:
            raise UnknownVariableError(path, known)
    return [(name, variable) for name, _, variable in (path.partition(".") for path in chosen)]


def _quantity(network: Network, name: str, variable: str) -> Quantity:
    quantity = network.participants[name].description.variables[variable].quantity
    return Quantity(f"{name}.{variable}", quantity.unit, quantity.display_unit, quantity.description)
