"""The causality/variability/initial table of FMI 2.0.4 and the other rules of a model description."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import product
from types import SimpleNamespace
from typing import Any, get_args

import pytest
from fmpy.validation import _validate_variable_names

from fmu_build.packaging.consistency import check_description
from fmu_build.support.description import Causality, Initial, ModelDescription, Unknown, Variability, Variable
from fmu_build.support.errors import BuildError, ModelicaError

_VARIABILITIES = get_args(Variability)
_INITIALS = (None, *get_args(Initial))
# The rows of the standard's table, as "variability: allowed values of initial".
_TABLE = {
    "parameter": {"fixed": "exact", "tunable": "exact"},
    "calculatedParameter": {"fixed": "calculated approx", "tunable": "calculated approx"},
    "input": {"discrete": "None", "continuous": "None"},
    "output": {
        "constant": "exact",
        "discrete": "calculated exact approx",
        "continuous": "calculated exact approx",
    },
    "local": {
        "constant": "exact",
        "fixed": "calculated approx",
        "tunable": "calculated approx",
        "discrete": "calculated exact approx",
        "continuous": "calculated exact approx",
    },
    "independent": {"continuous": "None"},
}


def _with(description: ModelDescription, name: str, /, **changes: Any) -> ModelDescription:
    variables = tuple(replace(v, **changes) if v.name == name else v for v in description.variables)
    return replace(description, variables=variables)


def _alone(variable: Variable) -> ModelDescription:
    return ModelDescription("Test.One", "", (variable,), (), (), (), ())


_NAMES = (
    *("x", "_x1", "der(x)", "der(a.x[1],2)", "a.b_c[1,2].d[3]", "'a b'", "'1/s'.x", r"'it\'s'", "a.'b'[1]"),
    *(
        "",
        "1x",
        "x.",
        ".x",
        "x[]",
        "x[a]",
        "x[1",
        "x y",
        "der(x",
        "der(der(x))",
        "''",
        "'a",
        "größe",
        "'größe'",
        "x\n",
    ),
)


@pytest.mark.parametrize("name", _NAMES)
def test_names_are_those_that_fmpy_finds_legal(name: str) -> None:
    variable = SimpleNamespace(name=name, sourceline=1)
    described = SimpleNamespace(variableNamingConvention="structured", modelVariables=[variable])
    if not _validate_variable_names(described):
        check_description(_alone(Variable(name, "Real", "local", "continuous", "calculated", None)))
    else:
        with pytest.raises(
            ModelicaError, match=rf"^variable {re.escape(repr(name))}: .* of ASCII characters$"
        ):
            check_description(_alone(Variable(name, "Real", "local", "continuous", "calculated", None)))


def test_the_oscillator_is_consistent(description: ModelDescription) -> None:
    check_description(description)


@pytest.mark.parametrize("causality", get_args(Causality))
def test_combinations_of_causality_variability_and_initial(causality: Causality) -> None:
    for variability, initial in product(_VARIABILITIES, _INITIALS):
        needs_start = initial in ("exact", "approx") or causality == "input"
        variable = Variable("v", "Real", causality, variability, initial, 1.0 if needs_start else None)
        if str(initial) in _TABLE[causality].get(variability, "").split():
            check_description(_alone(variable))
        else:
            with pytest.raises(BuildError, match=r"internal error: variable 'v': (causality|initial)"):
                check_description(_alone(variable))


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("E", {"start": 1.0}, "'E'.*must not have a start value"),
        ("k", {"start": None}, "'k'.*needs a start value"),
        ("F", {"start": None}, "'F'.*needs a start value"),
        ("x", {"type": "Boolean", "start": True}, "'x'.*Boolean cannot be continuous"),
        ("v", {"name": "x"}, "'x'.*more than once"),
        ("n", {"type": "Enumeration"}, "'n'.*enumeration"),
        ("mode", {"type": "Integer"}, "'mode'.*enumeration"),
        ("der(x)", {"derivative_of": 99}, r"'der\(x\)'.*unknown value reference 99"),
        ("der(x)", {"derivative_of": 10}, r"'der\(x\)'.*only Real"),
    ],
)
def test_faults_of_a_backend(
    description: ModelDescription, name: str, changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(BuildError, match=rf"internal error: variable {message}"):
        check_description(_with(description, name, **changes))


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("k", {"start": -1.0}, r"'k': the default value -1.0 is outside \[0.0, inf\]"),
        ("k", {"start": float("nan")}, "'k': the start value nan is not finite"),
        ("k", {"start": float("inf")}, "'k': the start value inf is not finite"),
        ("k", {"minimum": 5.0, "maximum": 4.0}, "'k': min = 5.0 is above max = 4.0"),
        ("x", {"nominal": 0.0}, "'x': nominal = 0.0"),
        ("x", {"nominal": -1.0}, "'x': nominal = -1.0"),
        ("n", {"start": 2.5}, "'n': the start value 2.5 is not a 32-bit integer"),
        ("n", {"start": 2**31}, "'n': the start value 2147483648 is not a 32-bit integer"),
    ],
)
def test_faults_of_a_model(
    description: ModelDescription, name: str, changes: dict[str, Any], message: str
) -> None:
    with pytest.raises(ModelicaError, match=message):
        check_description(_with(description, name, **changes))


@pytest.mark.parametrize(
    ("unknown", "message"),
    [
        (Unknown(99, (), ()), "unknown variables"),
        (Unknown(1, (99,), ("dependent",)), "unknown variables"),
        (Unknown(1, (7, 2), ("dependent", "dependent")), "'x'.*ascending"),
        (Unknown(1, (2, 2), ("dependent", "dependent")), "'x'.*each once"),
        (Unknown(1, (2, 7), ("dependent",)), "'x'.*its kind"),
    ],
)
def test_faults_of_the_model_structure(description: ModelDescription, unknown: Unknown, message: str) -> None:
    with pytest.raises(BuildError, match=message):
        check_description(replace(description, outputs=(unknown, description.outputs[1])))


def test_initial_unknowns_have_no_factors_that_change(description: ModelDescription) -> None:
    unknowns = (Unknown(3, (2,), ("tunable",)), *description.initial_unknowns[1:])
    with pytest.raises(BuildError, match="'dependent' or 'constant'"):
        check_description(replace(description, initial_unknowns=unknowns))


@pytest.mark.parametrize("name", ["Test.'a b'", "Test.Ödometer", "Test.2D", "Test."])
def test_a_class_name_that_cannot_name_an_fmu(description: ModelDescription, name: str) -> None:
    with pytest.raises(BuildError, match="cannot name an FMU"):
        check_description(replace(description, model_name=name))
