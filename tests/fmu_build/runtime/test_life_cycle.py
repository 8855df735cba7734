"""The life cycle of an FMI 2 instance: creation, status of the last step, logging."""

from __future__ import annotations

import ctypes as c

import pytest

from tests.fmu_build.runtime.conformance.states2 import in_state
from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import (
    CO_SIMULATION,
    DISCARD,
    DO_STEP_STATUS,
    ERROR,
    LAST_SUCCESSFUL_TIME,
    MODEL_EXCHANGE,
    OK,
    PENDING_STATUS,
    TERMINATED,
    TOKEN,
    Instance,
)

# The model "growth": parameters that end it or make it fail at x = 2.
END = 3


def test_status_that_a_synchronous_slave_has_not_is_discarded(build: Build) -> None:
    instance = in_state(build, CO_SIMULATION, "complete")
    text, number = c.c_char_p(), c.c_int()
    assert instance.call("fmi2GetStringStatus", PENDING_STATUS, c.byref(text)) == DISCARD
    assert instance.call("fmi2GetIntegerStatus", DO_STEP_STATUS, c.byref(number)) == DISCARD
    assert instance.call("fmi2GetStatus", PENDING_STATUS, c.byref(number)) == DISCARD
    assert instance.call("fmi2GetRealStatus", TERMINATED, c.byref(c.c_double())) == DISCARD
    assert instance.call("fmi2GetBooleanStatus", LAST_SUCCESSFUL_TIME, c.byref(number)) == DISCARD
    instance.free()


def test_last_step_is_known(build: Build) -> None:
    instance = in_state(build, CO_SIMULATION, "failed")
    status = c.c_int()
    instance.expect("fmi2GetStatus", DO_STEP_STATUS, c.byref(status))
    assert status.value == DISCARD
    instance.free()


@pytest.mark.parametrize(
    ("kind", "token", "name", "why"),
    [
        (CO_SIMULATION, "{other}", "test", "GUID"),
        (CO_SIMULATION, TOKEN, "", "no name"),
        (7, TOKEN, "test", "neither"),
    ],
)
def test_impossible_instances_are_refused(build: Build, kind: int, token: str, name: str, why: str) -> None:
    instance = Instance(build("growth"), kind, token=token, name=name)
    assert instance.handle is None
    assert why in instance.text


def test_null_pointers_are_refused(build: Build) -> None:
    library = build("growth")
    assert library.fmi2DoStep(None, c.c_double(0.0), c.c_double(0.1), 1) == ERROR
    instance = in_state(build, CO_SIMULATION, "complete")
    assert instance.call("fmi2GetReal", None, c.c_size_t(1), None) == ERROR
    assert "null pointer" in instance.text
    assert instance.call("fmi2GetFMUstate", None) == ERROR
    assert instance.call("fmi2SetFMUstate", None) == ERROR
    instance.expect("fmi2FreeFMUstate", None)
    instance.free()
    library.fmi2FreeInstance(None)


def test_version_and_platform(build: Build) -> None:
    library = build("growth")
    for name, expected in (("fmi2GetVersion", b"2.0"), ("fmi2GetTypesPlatform", b"default")):
        function = library[name]
        function.restype = c.c_char_p
        assert function() == expected


def test_log_categories(build: Build) -> None:
    instance = Instance(build("growth"))
    names = (c.c_char_p * 1)(b"logEvents")
    instance.expect("fmi2SetDebugLogging", 1, c.c_size_t(1), names)
    assert instance.set({END: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 1.0) == DISCARD
    assert {category for _, category, _ in instance.messages} == {"logEvents", "logStatusDiscard"}
    instance.expect("fmi2Reset")
    instance.messages.clear()
    instance.expect(
        "fmi2SetDebugLogging", 0, c.c_size_t(2), (c.c_char_p * 2)(b"logEvents", b"logStatusDiscard")
    )
    assert instance.set({END: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 1.0) == DISCARD
    assert not instance.messages
    assert instance.step(1.0, 1.0) == ERROR
    assert instance.messages, "errors are always told"
    assert instance.call("fmi2SetDebugLogging", 1, c.c_size_t(1), (c.c_char_p * 1)(b"logNonsense")) == ERROR
    assert 'the log category "logNonsense" does not exist' in instance.text
    instance.free()


def test_log_categories_that_are_always_on(build: Build) -> None:
    """Without a list, off leaves the problems."""
    instance = Instance(build("growth"), debug=True)
    instance.expect("fmi2SetDebugLogging", 0, c.c_size_t(0), None)
    assert instance.set({END: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 1.0) == DISCARD
    assert {category for _, category, _ in instance.messages} == {"logStatusDiscard"}
    instance.expect("fmi2SetDebugLogging", 0, c.c_size_t(1), (c.c_char_p * 1)(b"logAll"))
    instance.messages.clear()
    assert instance.step(1.0, 1.0) == ERROR
    assert instance.messages, "errors are told even then"
    instance.free()


@pytest.mark.parametrize("wrong", [b"logNonsense", None])
@pytest.mark.parametrize("is_first", [True, False])
def test_a_list_with_a_wrong_log_category_changes_nothing(
    build: Build, wrong: bytes | None, is_first: bool
) -> None:
    names = (c.c_char_p * 2)(*((wrong, b"logEvents") if is_first else (b"logEvents", wrong)))
    for on, told in ((1, {"logStatusDiscard"}), (0, {"logStatusDiscard", "logEvents"})):
        instance = Instance(build("growth"), debug=not on)
        assert instance.call("fmi2SetDebugLogging", on, c.c_size_t(2), names) == ERROR
        assert "log category" in instance.text
        instance.messages.clear()
        assert instance.set({END: 2.0}) == OK
        instance.initialize()
        assert instance.step(0.0, 1.0) == DISCARD
        assert told <= {category for _, category, _ in instance.messages}
        assert on == ("logEvents" not in {category for _, category, _ in instance.messages})
        instance.free()


@pytest.mark.parametrize("kind", [CO_SIMULATION, MODEL_EXCHANGE])
def test_steps_are_counted_where_the_integrator_is_the_fmus_own(build: Build, kind: int) -> None:
    instance = Instance(build("growth"), kind, debug=True)
    instance.initialize()
    instance.expect("fmi2Terminate")
    assert ("integrator steps" in instance.text) == (kind == CO_SIMULATION)
    instance.free()


def test_only_the_standards_functions_are_exported(build: Build) -> None:
    library = build("growth")
    for name in ("model", "instance_create", "integrator_step", "event_update", "block_solve"):
        with pytest.raises(AttributeError):
            library[name]


@pytest.mark.parametrize("function", ["fmi2Reset", "fmi2Terminate"])
def test_a_step_that_a_callback_ends_is_an_error(build: Build, function: str) -> None:
    class Meddler(Instance):
        meddles = False

        def _log(
            self, _environment: object, name: bytes, status: int, category: bytes, message: bytes
        ) -> None:
            super()._log(_environment, name, status, category, message)
            if self.meddles and category == b"logEvents":
                self.meddles = False
                self.expect(function)

    instance = Meddler(build("ball"), CO_SIMULATION, debug=True)
    instance.initialize(stop=2.0)
    instance.meddles = True
    statuses = [instance.step(0.1 * i, 0.1) for i in range(20) if instance.meddles]
    assert not instance.meddles
    assert statuses[-1] == ERROR
    assert set(statuses[:-1]) == {OK}
    instance.free()
