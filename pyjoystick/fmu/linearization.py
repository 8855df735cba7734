"""A motion's neighborhood as a linear system, from the directional derivatives of an FMU."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import fmpy
import numpy as np
import pandas as pd

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.errors import UnsupportedFmuError
from pyjoystick.fmu.inputs import checked_inputs
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.library import FmuLibrary
from pyjoystick.fmu.values import REALS, Value, checked_outputs, checked_parameters
from pyjoystick.support import FloatArray, not_negative, positive


@dataclass(frozen=True)
class Linearization:
    """d/dt dx = A dx + B du and dy = C dx + D du around one point, in the branch that holds there.

    The tables have the names of states, inputs and outputs as rows and columns, and the units of the FMU.

    Attributes:
        time: s
        point: values of states, inputs and outputs by name
        A: derivatives of the states' rates by the states, shape (states, states)
        B: by the inputs, shape (states, inputs)
        C: derivatives of the outputs by the states, shape (outputs, states)
        D: by the inputs, shape (outputs, inputs)
    """

    time: float
    point: pd.Series
    A: pd.DataFrame
    B: pd.DataFrame
    C: pd.DataFrame
    D: pd.DataFrame

    def poles(self) -> pd.DataFrame:
        """The eigenvalues of A: what each motion near the point does.

        Returns:
            one row an eigenvalue, with the columns ``real`` and ``imaginary`` (1/s), ``frequency`` (rad/s,
            undamped) and ``damping`` (of the critical one; negative where the motion grows)
        """
        values = np.linalg.eigvals(self.A.to_numpy())
        values = values[np.lexsort((values.imag, values.real))]
        size = np.abs(values)
        damping = np.divide(-values.real, size, out=np.zeros_like(size), where=size > 0.0)
        columns = {"real": values.real, "imaginary": values.imag, "frequency": size, "damping": damping}
        return pd.DataFrame(columns)


def linearize(
    library: FmuLibrary,
    instance: Instance,
    time: float,
    parameters: Mapping[str, Value],
    inputs: Mapping[str, float],
    outputs: Iterable[str] | None,
    tolerance: float,
) -> Linearization:
    """What `Fmu.linearize` gives, on an instance that is the caller's alone."""
    description = library.description
    instant = not_negative("time", time, "s")
    model = fmpy.read_model_description(str(library.folder), validate=False)
    _require_derivatives(description, model)
    constants = checked_parameters(description, parameters)
    table = checked_inputs(description, inputs)
    given = {str(name): float(table[name].iloc[0]) for name in table}
    recorded = [variable for variable in checked_outputs(description, outputs) if variable.type in REALS]
    rates = [unknown.variable for unknown in model.derivatives]
    states = [description.variables[rate.derivative.name] for rate in rates]
    drives = [v for v in description.variables.values() if v.causality == "input" and v.type in REALS]
    with instance.reporting(0.0):
        instance.initialize(0.0, positive("tolerance", tolerance), {**constants, **given})
        if instant > 0.0:
            instance.step(0.0, instant)
        unknowns = [rate.valueReference for rate in rates] + [v.value_reference for v in recorded]
        knowns = [v.value_reference for v in (*states, *drives)]
        jacobian = _jacobian(instance.fmi, unknowns, knowns)
        values = instance.get([*states, *drives, *recorded])
    x, u, y = ([variable.name for variable in variables] for variables in (states, drives, recorded))
    n = len(x)
    # An output that is a state is there once.
    point = pd.Series(values, [*x, *u, *y])
    return Linearization(
        instant,
        point[~point.index.duplicated()],
        pd.DataFrame(jacobian[:n, :n], x, x),
        pd.DataFrame(jacobian[:n, n:], x, u),
        pd.DataFrame(jacobian[n:, :n], y, x),
        pd.DataFrame(jacobian[n:, n:], y, u),
    )


def _require_derivatives(description: FmuDescription, model: Any) -> None:
    interface = model.coSimulation
    names = ("providesDirectionalDerivative", "providesDirectionalDerivatives")
    if not any(getattr(interface, name, False) for name in names):
        raise UnsupportedFmuError(description.path, "provides no directional derivatives")


def _jacobian(fmi: Any, unknowns: Sequence[int], knowns: Sequence[int]) -> FloatArray:
    columns = [fmi.getDirectionalDerivative(unknowns, [known], [1.0]) for known in knowns]
    return np.array(columns, dtype=float).reshape(len(knowns), len(unknowns)).T
