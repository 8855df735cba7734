"""FMI 3.0: every function in every state, and every kind of variable in every state that sets something."""

from __future__ import annotations

import ctypes as c

import pytest

from tests.fmu_build.runtime.conformance import standard3
from tests.fmu_build.runtime.conformance.states3 import arguments, in_state
from tests.fmu_build.runtime.conformance.variables import BALL, LAG, VariableKind
from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, live_blocks
from tests.fmu_build.runtime.library3 import Instance3, Update

_NAMES = {
    "instantiated": "the instantiated state",
    "initialization": "Initialization Mode",
    "event": "Event Mode",
    "continuous": "Continuous-Time Mode",
    "step": "Step Mode",
    "update": "Intermediate Update Mode",
    "terminated": "the terminated state",
}
_STATES = [
    *((MODEL_EXCHANGE, state) for state in standard3.MODEL_EXCHANGE),
    *((CO_SIMULATION, state) for state in standard3.CO_SIMULATION),
]
# Where they are absent, the description says so, and the call is refused for that reason alone.
_PERHAPS_ABSENT = ("fmi3GetDirectionalDerivative", "fmi3GetAdjointDerivative")
_SETTERS = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Int64"}


@pytest.mark.parametrize("function", standard3.FUNCTIONS)
@pytest.mark.parametrize(("kind", "state"), _STATES)
def test_function_in_state(build3: Build, kind: int, state: str, function: str) -> None:
    model_exchange = kind == MODEL_EXCHANGE
    statuses: list[int] = []
    texts: list[str] = []

    def call(instance: Instance3) -> None:
        saved, data = c.c_void_p(), b""
        if state != "update":
            saved = instance.save()
            data = instance.serialize(saved)
        statuses.append(instance.call(function, *arguments(function, saved, data)))
        texts.append(instance.text)
        if saved:
            instance.discard(saved)

    instance = in_state(build3, kind, state, call)
    allowed = standard3.mark(function, model_exchange, state) != "."
    # In an intermediate update either getting or setting is allowed; the one told here is of a finished step.
    if state == "update" and function.startswith("fmi3Set") and allowed:
        allowed = "this intermediate update" not in texts[0]
    if allowed and function in _PERHAPS_ABSENT:
        assert "not allowed" not in texts[0]
    else:
        assert statuses == [OK if allowed else ERROR], texts
    if not allowed and "this intermediate update" not in texts[0]:
        name = "Model Exchange" if model_exchange else "Co-Simulation"
        assert texts == [f"{function} is not allowed in {_NAMES[state]} of {name}."]
    if not allowed:
        _is_terminated(instance)
    instance.free()


def _is_terminated(instance: Instance3) -> None:
    """After an error the instance is in the state Terminated, from which a reset brings it back."""
    assert instance.enter_initialization() == ERROR
    assert instance.messages[-1][2].startswith(
        "fmi3EnterInitializationMode is not allowed in the terminated state"
    )
    assert instance.call("fmi3GetFloat64", None, c.c_size_t(0), None, c.c_size_t(0)) == OK
    instance.expect("fmi3Reset")
    assert instance.enter_initialization() == OK


def _set(instance: Instance3, reference: int, kind: VariableKind) -> int:
    return instance.set({reference: kind.value}, _SETTERS[kind.type])


@pytest.mark.parametrize(
    ("model", "variables", "variable"),
    [("lag", LAG, variable) for variable in LAG] + [("ball", BALL, variable) for variable in BALL],
    ids=lambda value: getattr(value, "name", None),
)
@pytest.mark.parametrize(("kind", "state"), [s for s in _STATES if s[1] != "update"])
def test_variable_in_state(
    build3: Build,
    kind: int,
    state: str,
    model: str,
    variables: tuple[VariableKind, ...],
    variable: VariableKind,
) -> None:
    statuses: list[int] = []

    def call(instance: Instance3) -> None:
        statuses.append(_set(instance, variables.index(variable), variable))

    instance = in_state(build3, kind, state, call, model)
    assert statuses == [OK if standard3.may_set(variable, state) else ERROR], instance.text
    if statuses == [ERROR] and state != "terminated":
        assert f'"{variable.name}"' in instance.text
    instance.free()


@pytest.mark.parametrize("variable", LAG, ids=lambda variable: variable.name)
def test_variable_in_intermediate_update(build3: Build, variable: VariableKind) -> None:
    """Inputs where they are asked for; what can be required at all is continuous inputs and outputs."""
    reference, statuses = LAG.index(variable), []
    requirable = variable.variability == "continuous" and variable.causality in ("input", "output")

    def call(update: Update) -> None:
        if update.may_set and not statuses:
            statuses.append(_set(instance, reference, variable))

    required = {LAG.index(next(v for v in LAG if v.name == "u")), *([reference] if requirable else [])}
    instance = Instance3(build3("lag"), intermediate=tuple(required), on_update=call)
    instance.initialize()
    instance.step(0.0, 0.01)
    assert statuses == [OK if standard3.may_set(variable, "update") else ERROR], instance.text
    instance.free()


@pytest.mark.parametrize("variable", LAG, ids=lambda variable: variable.name)
def test_start_values_are_read_before_the_initialization(build3: Build, variable: VariableKind) -> None:
    instance = Instance3(build3("lag"))
    reference = LAG.index(variable)
    has_start = variable.initial in ("exact", "approx") or variable.causality == "input"
    settable = standard3.may_set(variable, "instantiated")
    if settable:
        assert _set(instance, reference, variable) == OK
    status, values = instance.read(_SETTERS[variable.type], reference)
    assert status == (OK if has_start else ERROR)
    if settable:
        assert values == [variable.value]
    if not has_start:
        assert f'"{variable.name}" has no value before the initialization' in instance.text
    instance.free()


@pytest.mark.parametrize(("kind", "state"), [s for s in _STATES if s[1] != "update"])
def test_instances_are_freed_in_every_state(build3: Build, kind: int, state: str) -> None:
    before = live_blocks(build3("growth"))
    instance = in_state(build3, kind, state, lambda _: None)
    assert live_blocks(build3("growth")) > before
    instance.free()
    assert live_blocks(build3("growth")) == before


def test_version_and_scheduled_execution(build3: Build) -> None:
    library = build3("growth")
    library.fmi3GetVersion.restype = c.c_char_p
    assert library.fmi3GetVersion() == b"3.0"
    create = library.fmi3InstantiateScheduledExecution
    create.restype = c.c_void_p
    assert create(b"test", b"", None, False, False, None, None, None, None, None) is None


def test_every_function_of_the_standard_is_there(build3: Build) -> None:
    library = build3("growth")
    for function in (*standard3.FUNCTIONS, "fmi3InstantiateModelExchange", "fmi3FreeInstance"):
        assert library[function]
