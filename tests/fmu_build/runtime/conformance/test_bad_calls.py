"""Bad calls give the status that the standard requires and a message that names the fault; none crashes."""

from __future__ import annotations

import ctypes as c
import json
import subprocess
import sys
from typing import Any

import pytest

from tests.fmu_build.runtime.conformance.bad_calls import BAD_CALLS
from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, TOKEN, Instance
from tests.fmu_build.runtime.library3 import Instance3

# One process makes all the calls of a version.
pytestmark = pytest.mark.xdist_group("bad-calls")

_CASES = [(version, name) for name, case in BAD_CALLS.items() for version in case.versions]


@pytest.fixture(scope="module")
def outcomes(build: Build, build3: Build) -> dict[tuple[str, str], dict[str, Any]]:
    """By version and name; without those at and after which the program broke off."""
    found = {}
    for version, library in (("2", build("lag")), ("3", build3("lag"))):
        program = ("-m", "tests.fmu_build.runtime.conformance.bad_calls", version, library._name)
        done = subprocess.run([sys.executable, *program], capture_output=True, text=True, check=False)
        lines = map(json.loads, done.stdout.splitlines())
        print(done.stderr)  # what pytest shows where a test fails
        found |= {(version, line["name"]): line for line in lines}
    return found


@pytest.mark.parametrize(("version", "name"), _CASES)
def test_bad_call(outcomes: dict[tuple[str, str], dict[str, Any]], version: str, name: str) -> None:
    assert (version, name) in outcomes, f"no outcome; before it {list(outcomes)[-1:]}"
    outcome = outcomes[version, name]
    assert outcome["status"] == ERROR
    for word in BAD_CALLS[name].words:
        assert word in outcome["text"]
    if version == "3":
        assert outcome["terminated"]
    elif "terminate" not in name:
        assert outcome["unchanged"], "the instance can go on as if nothing had happened"
    assert outcome["usable"], "a reset makes it as good as a new one"


@pytest.mark.parametrize(("token", "name", "words"), [("{other}", "test", "GUID"), (TOKEN, " \t", "no name")])
@pytest.mark.parametrize("kind", [MODEL_EXCHANGE, CO_SIMULATION])
def test_impossible_instances_of_fmi3(build3: Build, kind: int, token: str, name: str, words: str) -> None:
    instance = Instance3(build3("lag"), kind, logging=False, token=token, name=name)
    assert instance.handle is None
    assert words in instance.text, "told although logging is off"


def test_null_handles(build: Build, build3: Build) -> None:
    assert build("lag").fmi2Terminate(None) == ERROR
    for function in ("fmi3Terminate", "fmi3Reset", "fmi3EnterEventMode"):
        assert build3("lag")[function](None) == ERROR
    outputs = (c.c_void_p(None),) * 4
    assert (
        build3("lag").fmi3DoStep(None, c.c_double(0.0), c.c_double(0.1), c.c_bool(False), *outputs) == ERROR
    )
    build("lag").fmi2FreeInstance(None)
    build3("lag").fmi3FreeInstance(None)


def test_loggers_may_be_missing(build3: Build) -> None:
    create = build3("lag").fmi3InstantiateModelExchange
    create.restype = c.c_void_p
    arguments = (TOKEN.encode(), None, c.c_bool(False), c.c_bool(True), None, None)
    handle = create(b"test", *arguments)
    assert handle
    assert build3("lag").fmi3Terminate(c.c_void_p(handle)) == ERROR
    assert create(b"", *arguments) is None
    build3("lag").fmi3FreeInstance(c.c_void_p(handle))


def test_other_instances_are_not_affected(build3: Build) -> None:
    bad, good, alone = (Instance3(build3("joystick")) for _ in range(3))
    for instance in (bad, good, alone):
        instance.initialize()
    expected = alone.run(0.1, 20, (0, 1))
    for i in range(20):
        assert bad.step(0.0, -1.0).status == ERROR
        assert good.step(i * 0.005, 0.005).status == OK
        assert good.get(0, 1) == expected[i + 1]
    for instance in (bad, good, alone):
        instance.free()


def test_without_logging_nothing_is_told(build3: Build) -> None:
    """FMI 3 forbids any message then; `fmi3SetDebugLogging` brings single categories back."""
    instance = Instance3(build3("lag"), logging=False)
    assert instance.call("fmi3Terminate") == ERROR
    assert not instance.messages
    categories = (c.c_char_p * 1)(b"logStatusError")
    instance.expect("fmi3SetDebugLogging", True, c.c_size_t(1), categories)
    assert instance.call("fmi3Terminate") == ERROR
    assert [category for _, category, _ in instance.messages] == ["logStatusError"]
    instance.expect("fmi3SetDebugLogging", False, c.c_size_t(0), None)
    assert instance.call("fmi3Terminate") == ERROR
    assert len(instance.messages) == 1
    instance.free()


def test_errors_of_fmi2_are_told_without_logging(build: Build) -> None:
    instance = Instance(build("lag"), debug=False)
    assert instance.call("fmi2Terminate") == ERROR
    assert instance.messages
    instance.free()
