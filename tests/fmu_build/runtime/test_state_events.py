"""State events are found, located to rounding error, handled once, and stopped when they accumulate."""

from __future__ import annotations

import ctypes
import math

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import (
    DISCARD,
    ERROR,
    LAST_SUCCESSFUL_TIME,
    OK,
    TERMINATED,
    WARNING,
    Instance,
)

H, V, BOUNCES, G, RESTITUTION = range(5)


def _ball(time: float) -> tuple[float, float, int]:
    """Height, velocity and number of bounces of a ball let fall from 1 m with g = 10 and e = 0.5."""
    g, e = 10.0, 0.5
    start, speed, bounces = -math.sqrt(2.0 / g), math.sqrt(2.0 * g), 0
    while time >= start + 2.0 * speed / g:
        start += 2.0 * speed / g
        speed *= e
        bounces += 1
    since = time - start
    return speed * since - 0.5 * g * since**2, speed - g * since, bounces


@pytest.mark.parametrize("steps", [1, 7, 100, 5000])
def test_bouncing_ball(build: Build, steps: int) -> None:
    """The method has no error on parabolas: what is left is the location of the bounces."""
    instance = Instance(build("ball"))
    instance.initialize()
    end = 1.3
    for i, (h, v, bounces) in enumerate(instance.run(end, steps, (H, V, BOUNCES))):
        height, velocity, number = _ball(i * end / steps)
        assert h == pytest.approx(height, abs=1e-13)
        assert v == pytest.approx(velocity, abs=1e-12)
        assert bounces == number
    instance.free()


def test_bounces_end_in_an_error_or_a_fall_but_never_hang(build: Build) -> None:
    """After t = 1.3416 the bounces follow each other without end; rounding decides what comes then."""
    instance = Instance(build("ball"))
    instance.initialize()
    status = instance.step(0.0, 2.0)
    assert (status == OK and instance.get(BOUNCES)[0] > 30.0) or (
        status == ERROR and "1.34164" in instance.text
    )
    instance.free()


@pytest.mark.parametrize("width", [1.0, 1e-3, 1e-6])
@pytest.mark.parametrize("steps", [1, 40])
def test_there_and_back_within_a_step(build: Build, width: float, steps: int) -> None:
    """The integrator would go over the window in one step: the area is 1 only if both edges are found."""
    instance = Instance(build("windows"))
    assert instance.set({4: width}) == OK
    instance.initialize()
    x, area, after = instance.run(2.0, steps, (0, 1, 2))[-1]
    assert x == pytest.approx(2.0, abs=1e-14)
    # Each edge is known to the rounding of x and of the time.
    assert area == pytest.approx(1.0, abs=1e-15 + 1e-15 / width)
    assert after == pytest.approx(1.0, abs=1e-14)
    instance.free()


def test_simultaneous_crossings_are_one_event(build: Build) -> None:
    """Both x > centre and not x <= centre change together."""
    instance = Instance(build("windows"))
    assert instance.set({4: 0.0}) == OK, "an empty window"
    instance.initialize()
    instance.run(2.0, 1, (0,))
    assert instance.statistics()["events"] == 1
    instance.free()


def test_relation_that_starts_at_zero(build: Build) -> None:
    """At x = centre neither x > centre nor the window has begun; x > centre holds at once afterwards."""
    instance = Instance(build("windows"))
    assert instance.set({0: 1.0, 4: 0.0}) == OK
    instance.initialize()
    x, area, after = instance.run(1.0, 4, (0, 1, 2))[-1]
    assert x == pytest.approx(2.0, abs=1e-14)
    assert area == 0.0
    assert after == pytest.approx(1.0, abs=1e-14)
    assert instance.statistics()["events"] == 1
    instance.free()


def test_root_that_stays_zero_is_no_event(build: Build) -> None:
    """The input lies exactly on the threshold of u > 1.5."""
    instance = Instance(build("lag"))
    instance.initialize()
    assert instance.set({4: 1.5}) == OK
    assert instance.step(0.0, 5.0) == OK
    assert instance.get_one("Boolean", 10) == 0
    assert instance.statistics()["events"] == 0
    instance.free()


def test_change_before_an_event_that_is_already_known(build: Build) -> None:
    """The bounce at 0.447 is known when g is doubled at t = 0.2: the ball then bounces at 0.4."""
    instance = Instance(build("ball"), debug=True)
    instance.initialize()
    assert instance.step(0.0, 0.2) == OK
    assert instance.set({G: 20.0}) == OK
    assert instance.step(0.2, 0.3) == OK
    # It arrives with 2 + 20*0.2 = 6 m/s and leaves with 3 m/s.
    assert instance.get(H, V, BOUNCES) == pytest.approx(
        [3.0 * 0.1 - 10.0 * 0.01, 3.0 - 20.0 * 0.1, 1.0], abs=1e-12
    )
    instance.free()


def test_event_at_a_communication_point(build: Build) -> None:
    """The event lies at a point or an ulp beside it: whichever it is, nothing is lost or done twice."""
    instance = Instance(build("windows"))
    instance.initialize()
    (last,) = instance.run(2.0, 2, (2,))[-1:]
    assert last[0] == pytest.approx(1.0, abs=1e-14)
    assert instance.statistics()["events"] == 3
    instance.free()


def test_chattering_is_an_error_that_names_time_and_relation(build: Build) -> None:
    instance = Instance(build("slide"))
    instance.initialize()
    assert instance.step(0.0, 0.9) == OK
    assert instance.step(0.9, 0.2) == ERROR
    assert "events at practically the same time" in instance.text
    assert "-x changed its sign" in instance.text
    assert "time 1.0000" in instance.text or "time 0.9999" in instance.text
    instance.free()


@pytest.mark.parametrize("start", [1e6, -1e6])
def test_chattering_at_a_large_time_is_an_error_too(build: Build, start: float) -> None:
    """There the numbers are so far apart that events a nanosecond apart lie practically at one time."""
    instance = Instance(build("slide"))
    instance.initialize(start=start)
    assert instance.step(start, 2.0) == ERROR
    assert "events at practically the same time" in instance.text
    instance.free()


def test_events_are_logged_where_asked_for(build: Build) -> None:
    instance = Instance(build("ball"), debug=True)
    instance.initialize()
    assert instance.step(0.0, 0.6) == OK
    events = [text for _, category, text in instance.messages if category == "logEvents"]
    assert any("0.4472135954999" in text for text in events), events
    instance.free()


def test_terminate_discards_the_step(build: Build) -> None:
    """The state e^t passes 2 at t = ln 2."""
    instance = Instance(build("growth"))
    assert instance.set({3: 2.0}) == OK
    instance.initialize(1e-10)
    assert instance.step(0.0, 0.5) == OK
    assert instance.step(0.5, 0.5) == DISCARD
    assert "x is large enough" in instance.text
    assert _real_status(instance) == pytest.approx(math.log(2.0), abs=1e-9)
    assert instance.get(0)[0] == pytest.approx(2.0, abs=1e-12)
    assert _terminated(instance) == 1
    assert instance.step(0.5, 0.5) == ERROR, "a discarded step is followed by no other"
    instance.expect("fmi2Terminate")
    instance.free()


def _real_status(instance: Instance) -> float:
    value = ctypes.c_double()
    instance.expect("fmi2GetRealStatus", LAST_SUCCESSFUL_TIME, ctypes.byref(value))
    return value.value


def _terminated(instance: Instance) -> int:
    value = ctypes.c_int(-1)
    instance.expect("fmi2GetBooleanStatus", TERMINATED, ctypes.byref(value))
    return value.value


def test_warning_is_given_once_and_its_text_cannot_be_taken_for_a_format(build: Build) -> None:
    instance = Instance(build("growth"))
    assert instance.set({4: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 0.5) == OK
    assert instance.step(0.5, 0.5) == WARNING
    assert instance.step(1.0, 0.5) == OK
    assert [category for _, category, _ in instance.messages] == ["logStatusWarning"]
    assert "x grows 100%% faster than ##wanted##: 2" in instance.text
    assert instance.logged_name == "test"
    instance.free()


def test_assertion_between_events(build: Build) -> None:
    instance = Instance(build("growth"))
    assert instance.set({5: 2.0}) == OK
    instance.initialize()
    assert instance.step(0.0, 0.5) == OK
    assert instance.step(0.5, 1.0) == ERROR
    assert "x is above its limit" in instance.text
    instance.free()


def test_assertion_ahead_of_the_communication_point_is_not_yet_violated(build: Build) -> None:
    """The integrator is ahead of the importer; what it meets there counts when time comes to it."""
    instance = Instance(build("growth"))
    assert instance.set({5: 2.0}) == OK
    instance.initialize()
    time = 0.0
    while time < 0.69:
        assert instance.step(time, 0.01) == OK, instance.text
        time += 0.01
    assert instance.get(0)[0] < 2.0
    instance.free()


def test_violated_assertion_at_the_start(build: Build) -> None:
    instance = Instance(build("growth"))
    assert instance.set({5: 0.5}) == OK
    instance.setup()
    instance.expect("fmi2EnterInitializationMode")
    assert instance.call("fmi2ExitInitializationMode") == ERROR
    assert "x is above its limit: 1" in instance.text
    instance.free()
