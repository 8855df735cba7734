"""Calls that no importer should make; in a program of their own, because a faulty FMU could end the process.

``python -m tests.fmu_build.runtime.conformance.bad_calls VERSION LIBRARY``: makes each of the calls on the
model "lag" and prints a line of JSON for each, before the next is made.
"""

from __future__ import annotations

import ctypes as c
import json
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, Instance
from tests.fmu_build.runtime.library3 import Instance3

AnyInstance = Instance | Instance3
TIME, X, DER_X, Y, U, GEAR, ON, TAU, GAIN, HALF = range(10)
_NONE, _ONE = c.c_size_t(0), c.c_size_t(1)


@dataclass(frozen=True)
class BadCall:
    """A call, where it is made, and what must be said of it; `prefix` in words is ``fmi2`` or ``fmi3``."""

    make: Callable[[Any], int]
    words: tuple[str, ...]
    state: str = "step"
    kind: int = CO_SIMULATION
    versions: str = "23"


def _prefix(instance: AnyInstance) -> str:
    return "fmi3" if isinstance(instance, Instance3) else "fmi2"


def _step(point: float, size: float) -> Callable[[Any], int]:
    def make(instance: AnyInstance) -> int:
        step = instance.step(point, size)
        return step if isinstance(step, int) else step.status

    return make


def _set(reference: int, value: float) -> Callable[[Any], int]:
    return lambda instance: int(instance.set({reference: value}))


def _get(reference: int) -> Callable[[Any], int]:
    def make(instance: AnyInstance) -> int:
        value, array = (c.c_double * 1)(), (c.c_uint32 * 1)(reference)
        if isinstance(instance, Instance3):
            return instance.call("fmi3GetFloat64", array, _ONE, value, _ONE)
        return instance.call("fmi2GetReal", array, _ONE, value)

    return make


def _call(name: str, *arguments: object, fmi2: str = "") -> Callable[[Any], int]:
    """The function of that name without its prefix; `fmi2` where it is called otherwise there."""

    def make(instance: AnyInstance) -> int:
        prefix = _prefix(instance)
        return instance.call(prefix + (fmi2 if fmi2 and prefix == "fmi2" else name), *arguments)

    return make


def _terminated(make: Callable[[Any], int]) -> Callable[[Any], int]:
    def terminate_first(instance: AnyInstance) -> int:
        instance.expect(f"{_prefix(instance)}Terminate")
        return make(instance)

    return terminate_first


def _experiment(tolerance: float, start: float, stop: float) -> Callable[[Any], int]:
    def make(instance: AnyInstance) -> int:
        if isinstance(instance, Instance3):
            return instance.call("fmi3EnterInitializationMode", True, tolerance, start, True, stop)
        return instance.call("fmi2SetupExperiment", 1, tolerance, start, 1, stop)

    return make


def _too_short(instance: AnyInstance) -> int:
    state, buffer = instance.save(), c.create_string_buffer(8)
    name = "SerializeFMUState" if isinstance(instance, Instance3) else "SerializeFMUstate"
    return instance.call(_prefix(instance) + name, state, buffer, c.c_size_t(8))


def _garbage(instance: AnyInstance) -> int:
    return instance.deserialize(b"nonsense" * 100)[0]


_PAIR = (c.c_double * 2)(0.5, 0.5)
BAD_CALLS = {
    "get an unknown variable": BadCall(_get(99), ("99",)),
    "set an unknown variable": BadCall(_set(99, 1.0), ("99",)),
    "get as another type": BadCall(_get(GEAR), ('"gear"', "Integer")),
    "set as another type": BadCall(_set(ON, 1.0), ('"on"', "Boolean")),
    "set an input to NaN": BadCall(_set(U, math.nan), ('"u"', "nan", "finite")),
    "set an input to infinity": BadCall(_set(U, math.inf), ('"u"', "inf", "finite")),
    "set an input to minus infinity": BadCall(_set(U, -math.inf), ('"u"', "-inf", "finite")),
    "set a start value to NaN": BadCall(_set(X, math.nan), ('"x"', "nan"), state="instantiated"),
    "set a parameter to NaN": BadCall(_set(TAU, math.nan), ('"tau"', "nan"), state="initialization"),
    "set beyond the range": BadCall(_set(U, 10.5), ('"u"', "10.5", "-10 to 10")),
    "set an output": BadCall(_set(Y, 1.0), ('"y"', "output")),
    "set a calculated parameter": BadCall(_set(HALF, 1.0), ('"half"', "calculated parameter")),
    "set a fixed parameter too late": BadCall(_set(GAIN, 1.0), ('"gain"', "after the initialization")),
    "set a state too late": BadCall(_set(X, 1.0), ('"x"',)),
    "step of negative length": BadCall(_step(0.0, -0.1), ("negative", "-0.1")),
    "step of no length": BadCall(_step(0.0, 0.0), ("step size is zero",), versions="3"),
    "step of length NaN": BadCall(_step(0.0, math.nan), ("must be finite", "nan")),
    "step of infinite length": BadCall(_step(0.0, math.inf), ("must be finite", "inf")),
    "step from NaN": BadCall(_step(math.nan, 0.1), ("must be finite", "nan")),
    "step from elsewhere": BadCall(_step(0.5, 0.1), ("not where the last step ended", "0.5")),
    "step past the stop time": BadCall(_step(0.0, 1.5), ("beyond the stop time", "1.5", "stop time 1")),
    "step before the initialization": BadCall(_step(0.0, 0.1), ("not allowed",), state="instantiated"),
    "step after terminate": BadCall(_terminated(_step(0.0, 0.1)), ("not allowed", "terminated state")),
    "set after terminate": BadCall(_terminated(_set(U, 1.0)), ("not allowed", "terminated state")),
    "terminate twice": BadCall(_terminated(_call("Terminate")), ("not allowed", "terminated state")),
    "leave initialization twice": BadCall(_call("ExitInitializationMode"), ("not allowed",)),
    "variables without references": BadCall(
        _call("GetFloat64", None, _ONE, _PAIR, _ONE, fmi2="GetReal"), ("null",)
    ),
    "variables without values": BadCall(
        _call("GetFloat64", (c.c_uint32 * 1)(X), _ONE, None, _ONE, fmi2="GetReal"), ("null pointer",)
    ),
    "values without an array": BadCall(
        _call("SetFloat64", (c.c_uint32 * 1)(U), _ONE, None, _ONE, fmi2="SetReal"), ("null pointer",)
    ),
    "as many values as variables": BadCall(
        _call("GetFloat64", (c.c_uint32 * 1)(X), _ONE, _PAIR, c.c_size_t(2)),
        ("2 values for 1",),
        versions="3",
    ),
    "step without results": BadCall(
        _call("DoStep", 0.0, 0.1, True, None, None, None, None), ("null pointer",), versions="3"
    ),
    "save to nowhere": BadCall(_call("GetFMUState", None, fmi2="GetFMUstate"), ("null pointer",)),
    "restore nothing": BadCall(_call("SetFMUState", None, fmi2="SetFMUstate"), ("null pointer",)),
    "serialize into too little": BadCall(_too_short, ("not enough room",)),
    "deserialize nonsense": BadCall(_garbage, ("not a saved FMU state",)),
    "unknown log category": BadCall(
        _call("SetDebugLogging", True, _ONE, (c.c_char_p * 1)(b"logNonsense")),
        ("log category",),
        versions="3",
    ),
    "tolerance NaN": BadCall(_experiment(math.nan, 0.0, 1.0), ("tolerance nan",), state="instantiated"),
    "tolerance zero": BadCall(_experiment(0.0, 0.0, 1.0), ("tolerance 0",), state="instantiated"),
    "start at infinity": BadCall(_experiment(1e-6, math.inf, 1.0), ("start time inf",), state="instantiated"),
    "stop before start": BadCall(
        _experiment(1e-6, 2.0, 1.0), ("stop time 1", "start time 2"), state="instantiated"
    ),
    "states of another number": BadCall(
        _call("SetContinuousStates", _PAIR, c.c_size_t(2)), ("size",), "continuous", MODEL_EXCHANGE
    ),
    "a state NaN": BadCall(
        _call("SetContinuousStates", (c.c_double * 1)(math.nan), _ONE),
        ('"x"', "nan"),
        "continuous",
        MODEL_EXCHANGE,
    ),
    "time NaN": BadCall(_call("SetTime", math.nan), ("nan",), "continuous", MODEL_EXCHANGE),
    "derivatives into nowhere": BadCall(
        _call("GetContinuousStateDerivatives", None, _ONE, fmi2="GetDerivatives"),
        ("null pointer",),
        "continuous",
        MODEL_EXCHANGE,
    ),
    "update without results": BadCall(
        _call("UpdateDiscreteStates", *(None,) * 6, fmi2="NewDiscreteStates"),
        ("null",),
        "event",
        MODEL_EXCHANGE,
    ),
}


def _bring(instance: AnyInstance, state: str) -> None:
    prefix = _prefix(instance)
    if state == "instantiated":
        return
    if isinstance(instance, Instance3):
        assert instance.enter_initialization(stop=1.0) == OK
    else:
        instance.setup(stop=1.0)
        instance.expect("fmi2EnterInitializationMode")
    if state != "initialization":
        instance.expect(f"{prefix}ExitInitializationMode")
    if state == "continuous":
        instance.expect(f"{prefix}EnterContinuousTimeMode")


def _run(instance: AnyInstance) -> list[float]:
    """A run from the instantiated state."""
    assert instance.set({U: 1.0}) == OK
    instance.initialize(stop=1.0)
    if not isinstance(instance, Instance3):
        assert instance.step(0.0, 1.0) == OK, instance.text
    else:
        assert instance.step(0.0, 1.0).status == OK, instance.text
    return instance.get(X, Y)


def outcome(version: str, library: c.CDLL, case: BadCall) -> dict[str, object]:
    """What comes of a bad call, and what the instance is good for afterwards."""
    create = Instance3 if version == "3" else Instance
    instance = create(library, case.kind)
    _bring(instance, case.state)
    before = instance.serialize(instance.save())
    instance.messages.clear()
    status = case.make(instance)
    text = instance.text
    unchanged = instance.serialize(instance.save()) == before
    # In FMI 3 whoever gets an error finds the instance in the state Terminated.
    terminated = version == "3" and instance.call("fmi3Terminate") == ERROR
    instance.expect(f"fmi{version}Reset")
    fresh = create(library, case.kind)
    usable = case.kind == MODEL_EXCHANGE or _run(instance) == _run(fresh)
    instance.free()
    fresh.free()
    return {
        "status": status,
        "text": text,
        "unchanged": unchanged,
        "terminated": terminated,
        "usable": usable,
    }


def main(version: str, path: str) -> None:
    """All cases of a version of FMI."""
    library = c.CDLL(path)
    for name, case in BAD_CALLS.items():
        if version in case.versions:
            print(json.dumps({"name": name} | outcome(version, library, case)), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
