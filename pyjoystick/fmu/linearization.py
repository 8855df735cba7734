"""Linearization of an FMU about a motion, from its directional derivatives."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final

import fmpy
import numpy as np

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.errors import FmuRunError, UnsupportedFmuError
from pyjoystick.fmu.inputs import checked_constants
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.values import REALS, Value, checked_outputs, checked_parameters
from pyjoystick.support import FloatArray, ParameterError, not_negative, positive

if TYPE_CHECKING:
    import pandas as pd

#: Communication steps to the point, unless a length is known; and how many at most.
_STEPS: Final = 1000
_MOST_STEPS: Final = 1_000_000


@dataclass(frozen=True, eq=False)
class Linearization:
    """d/dt dx = A dx + B du and dy = C dx + D du about one point, for the branch active there.

    Rows and columns of the tables are named after states, inputs and outputs, in the units of the FMU.

    Attributes:
        time: s
        point: values of states, inputs and outputs by name
        A: derivatives of the states' rates with respect to the states, shape (states, states)
        B: the same with respect to the inputs, shape (states, inputs)
        C: derivatives of the outputs with respect to the states, shape (outputs, states)
        D: the same with respect to the inputs, shape (outputs, inputs)
    """

    time: float
    point: pd.Series
    A: pd.DataFrame
    B: pd.DataFrame
    C: pd.DataFrame
    D: pd.DataFrame

    def poles(self) -> pd.DataFrame:
        """Eigenvalues of A, the modes of small motions about the point.

        Returns:
            one row per eigenvalue, with the columns ``real`` and ``imaginary`` (1/s), ``frequency`` (rad/s,
            undamped) and ``damping`` (damping ratio, negative for growing motions)
        """
        import pandas as pd

        values = np.linalg.eigvals(self.A.to_numpy())
        values = values[np.lexsort((values.imag, values.real))]
        size = np.abs(values)
        damping = np.divide(-values.real, size, out=np.zeros_like(size), where=size > 0.0)
        columns = {"real": values.real, "imaginary": values.imag, "frequency": size, "damping": damping}
        return pd.DataFrame(columns)


def linearize(
    instance: Instance,
    time: float,
    parameters: Mapping[str, Value],
    inputs: Mapping[str, float],
    outputs: Iterable[str] | None,
    tolerance: float,
    step: float | None,
) -> Linearization:
    """Implements `Fmu.linearize` on an instance that is not used elsewhere."""
    import pandas as pd  # see `motion.make_table`

    description = instance.description
    instant = not_negative("time", time, "s")
    if not (description.directional_derivatives or description.adjoint_derivatives):
        raise UnsupportedFmuError(description.path, "provides neither directional nor adjoint derivatives")
    constants = checked_parameters(description, parameters)
    given = checked_constants(description, inputs)
    recorded = _outputs(description, outputs)
    points = _communication_points(description, instant, step)
    rates, states = _rates_and_states(description, instance.fmi.unzipDirectory)
    driven = [
        one for one in description.variables.values() if one.causality == "input" and _is_continuous(one)
    ]
    drives = [part for one in driven for part in one.elements()]
    with instance.reporting(0.0):
        instance.initialize(0.0, positive("tolerance", tolerance), {**constants, **given})
        for start, end in pairwise(points):
            instance.step(start, end - start)
        jacobian = _jacobian(instance.fmi, description, [*rates, *recorded], [*states, *drives])
        values = [_value(instance, variable) for variable in (*states, *drives, *recorded)]
    for row, column in np.argwhere(~np.isfinite(jacobian))[:1]:
        what = f"the derivative of {[*rates, *recorded][row].name} by {[*states, *drives][column].name}"
        raise FmuRunError(instant, f"{what} is {jacobian[row, column]}", description.path, ())
    x, u, y = ([variable.name for variable in variables] for variables in (states, drives, recorded))
    n = len(x)
    # An output that is also a state appears once.
    point = pd.Series(values, [*x, *u, *y])
    return Linearization(
        instant,
        point[~point.index.duplicated()],
        pd.DataFrame(jacobian[:n, :n], x, x),
        pd.DataFrame(jacobian[:n, n:], x, u),
        pd.DataFrame(jacobian[n:, :n], y, x),
        pd.DataFrame(jacobian[n:, n:], y, u),
    )


def _communication_points(description: FmuDescription, end: float, step: float | None) -> list[float]:
    """Equal steps from 0 to `end`, not longer than `step` or that of the FMU's default experiment."""
    shortest = end / _MOST_STEPS
    length = description.experiment.step_size if step is None else positive("step", step, "s")
    if step is not None and step < shortest:
        raise ParameterError("step", step, f"at least {shortest:g} s, {_MOST_STEPS} steps")
    usable = length is not None and shortest <= length
    count = max(1, math.ceil(end / length * (1.0 - 1e-9))) if length and usable else _STEPS
    return [end * number / count for number in range(count + 1)] if end > 0.0 else []


def _is_continuous(variable: Variable) -> bool:
    return variable.type in REALS and variable.variability == "continuous"


def _outputs(description: FmuDescription, names: Iterable[str] | None) -> list[Variable]:
    """The outputs to differentiate; outputs included by default are omitted if they have no derivative."""
    outputs = checked_outputs(description, names)
    for one in outputs if names is not None else ():
        if one.type not in REALS:
            raise ParameterError("outputs", one.name, "a real variable", f"it is of type {one.type}")
    return [one for one in outputs if names is not None or _is_continuous(one)]


def _rates_and_states(description: FmuDescription, unpacked: str) -> tuple[list[Variable], list[Variable]]:
    """Derivatives of the states, and the states, by element, from the folder of the unpacked FMU."""
    model = fmpy.read_model_description(unpacked, validate=False)
    rates: list[Variable] = []
    states: list[Variable] = []
    for unknown in model.derivatives:
        state = unknown.variable.derivative
        if state is None:
            reason = f"{unknown.variable.name} is declared a derivative of a state, but not of which"
            raise UnsupportedFmuError(description.path, reason)
        rates += description.variables[unknown.variable.name].elements()
        states += description.variables[state.name].elements()
    return rates, states


def _value(instance: Instance, variable: Variable) -> float:
    if variable.element is None:
        return instance.get([variable])[0]
    get = getattr(instance.fmi, f"get{variable.type}")
    return float(get([variable.value_reference], math.prod(variable.shape))[variable.element])


def _jacobian(
    fmi: Any, description: FmuDescription, unknowns: Sequence[Variable], knowns: Sequence[Variable]
) -> FloatArray:
    """Derivatives of the unknowns with respect to the knowns, shape (unknowns, knowns).

    Variables that are both, such as an output that is also a state, are not requested: their derivatives are
    1 and 0 by definition, and many FMUs return only 0.
    """
    places = [_place(one) for one in unknowns]
    columns = {_place(one): j for j, one in enumerate(knowns)}
    asked = [one for one in unknowns if _place(one) not in columns]
    found = np.zeros((len(unknowns), len(knowns)))
    for i, place in enumerate(places):
        if place in columns:
            found[i, columns[place]] = 1.0
    if not asked or not knowns:
        return found
    rows = [i for i, place in enumerate(places) if place not in columns]
    if description.directional_derivatives:
        found[rows] = _derivatives(fmi.getDirectionalDerivative, asked, knowns, along_knowns=True).T
    else:
        found[rows] = _derivatives(fmi.getAdjointDerivative, asked, knowns, along_knowns=False)
    return found


def _place(variable: Variable) -> tuple[int, int]:
    return variable.value_reference, variable.element or 0


def _derivatives(
    get: Callable[..., list[float]],
    unknowns: Sequence[Variable],
    knowns: Sequence[Variable],
    *,
    along_knowns: bool,
) -> FloatArray:
    """Derivatives: one row per known with all unknowns or, for adjoint derivatives, the reverse."""
    seeded, answered = (knowns, unknowns) if along_knowns else (unknowns, knowns)
    # Arrays are requested once, as a whole.
    sizes = {one.value_reference: math.prod(one.shape) for one in answered}
    begins = dict(zip(sizes, np.cumsum([0, *sizes.values()]).tolist(), strict=False))
    total, rows = sum(sizes.values()), []
    for one in seeded:
        seed = [0.0] * math.prod(one.shape)
        seed[one.element or 0] = 1.0
        asked = (list(sizes), [one.value_reference]) if along_knowns else ([one.value_reference], list(sizes))
        answer = get(*asked, seed, *([total] if total > len(sizes) or not along_knowns else []))
        rows.append([answer[begins[other.value_reference] + (other.element or 0)] for other in answered])
    return np.array(rows, dtype=np.float64)
