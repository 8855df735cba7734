"""Resolve the sensitivities that a build requests to variables of the model; refuse unknown ones."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_build.codegen.variables import StoredVariable
from fmu_build.support.description import Variable
from fmu_build.support.errors import UnsupportedModelError
from fmu_build.support.request import ALL, SensitivityRequest


@dataclass(frozen=True, slots=True)
class Wanted:
    """The variables of a request; the parameters are stored in p."""

    variables: tuple[StoredVariable, ...]
    parameters: tuple[StoredVariable, ...]


def find_wanted(model: str, stored: Sequence[StoredVariable], request: SensitivityRequest) -> Wanted:
    """Return the variables and parameters of a request.

    Raises `UnsupportedModelError`, which names the variable and what is allowed.
    """
    known = {s.variable.name: s for s in stored}
    variables = _expand(request.variables, [s for s in stored if _is_output(s.variable)])
    parameters = _expand(request.parameters, [s for s in stored if _is_parameter(s.variable)])
    for names, what in ((variables, "output"), (parameters, "parameter")):
        if not names:
            raise UnsupportedModelError(f"{model}: no sensitivities: the model has no Real {what}")
    for name in (*variables, *parameters):
        if name not in known:
            close = difflib.get_close_matches(name, known, n=3, cutoff=0.6)
            hint = f"; did you mean {', '.join(close)}?" if close else ""
            raise UnsupportedModelError(f"{model}: no sensitivities: there is no variable {name!r}{hint}")
    for name in variables:
        _refuse(model, name, _fault_of_variable(known[name].variable))
    for name in parameters:
        _refuse(model, name, _fault_of_parameter(known[name].variable))
    return Wanted(tuple(known[name] for name in variables), tuple(known[name] for name in parameters))


def _expand(names: Sequence[str], everything: Sequence[StoredVariable]) -> list[str]:
    """Return the names without duplicates, with `ALL` replaced by the names of all variables it covers."""
    found = (
        name for one in names for name in ([s.variable.name for s in everything] if one == ALL else [one])
    )
    return list(dict.fromkeys(found))


def _is_output(variable: Variable) -> bool:
    return variable.causality == "output" and variable.type == "Real"


def _is_parameter(variable: Variable) -> bool:
    return variable.causality == "parameter" and variable.type == "Real"


def _refuse(model: str, name: str, fault: str) -> None:
    if fault:
        raise UnsupportedModelError(f"{model}: no sensitivities: {name!r} is {fault}")


def _fault_of_variable(variable: Variable) -> str:
    if variable.type != "Real":
        return f"of type {variable.type}; a Real variable is needed"
    if variable.derivative_of is not None:
        return "the derivative of a state, whose sensitivity comes with that of the state"
    if variable.causality in ("parameter", "calculatedParameter", "input", "independent"):
        return f"of causality {variable.causality!r}; a variable that the model computes over time is needed"
    return "constant" if variable.variability == "constant" else ""


def _fault_of_parameter(variable: Variable) -> str:
    if variable.type != "Real":
        return f"of type {variable.type}; a Real parameter is needed"
    if variable.causality == "calculatedParameter":
        return "computed from others; name a parameter that can be set"
    if variable.causality == "parameter":
        return ""
    if variable.variability == "constant":
        return "constant in the FMU; name a parameter that can be set"
    return f"of causality {variable.causality!r}; a parameter that can be set is needed"
