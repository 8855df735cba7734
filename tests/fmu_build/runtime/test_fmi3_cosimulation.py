"""Co-Simulation features of FMI 3 beyond FMI 2: Event Mode, early return, intermediate updates."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from itertools import pairwise

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import ERROR, MODEL_EXCHANGE, OK, Instance
from tests.fmu_build.runtime.library3 import Instance3, Update

# Of the model "ball"; it touches the ground after sqrt(2*h/g) = sqrt(0.2) s with g = 10 m/s2.
H, V, BOUNCES, G = 0, 1, 2, 3
FIRST_BOUNCE = math.sqrt(0.2)
# Of the model "lag", tau*der(x) = u - x.
LAG_X, LAG_U, GEAR, TAU, HALF, HIGH, LAST_GEAR, LAG_MODE = 1, 4, 5, 7, 9, 10, 11, 12


@pytest.mark.parametrize(("model", "end", "steps"), [("joystick", 1.0, 500), ("ball", 1.5, 70)])
def test_plain_runs_are_those_of_fmi2_bit_by_bit(
    build: Build, build3: Build, model: str, end: float, steps: int
) -> None:
    old, new = Instance(build(model)), Instance3(build3(model))
    old.initialize()
    new.initialize()
    assert new.run(end, steps, (0, 1)) == old.run(end, steps, (0, 1))
    old.free()
    new.free()


def _event(instance: Instance3) -> None:
    """Carries out an event that a step was ended for."""
    instance.expect("fmi3EnterEventMode")
    assert instance.update().status == OK
    instance.expect("fmi3EnterStepMode")


def _started(instance: Instance3) -> Instance3:
    """From the instantiated state to Step Mode through the first Event Mode."""
    instance.initialize()
    assert instance.update().status == OK
    instance.expect("fmi3EnterStepMode")
    return instance


def test_steps_end_at_events(build3: Build) -> None:
    """When the ball reaches the ground, and when it leaves it an instant later."""
    instance = _started(Instance3(build3("ball"), event_mode=True, early_return=True))
    time, bounces = 0.0, []
    while time < 1.3:
        step = instance.step(time, 1.3 - time)
        assert (step.status, step.early) == (OK, step.event), instance.text
        assert instance.get(BOUNCES) == [len(bounces)], "the event is left to the importer"
        time = step.time
        if step.event:
            assert instance.get(H)[0] == pytest.approx(0.0, abs=1e-9)
            _event(instance)
            if instance.get(BOUNCES)[0] > len(bounces):
                bounces.append(time)
    # Each flight after the first lasts e = 0.5 times as long as the one before it.
    flights = [1.0, 2.0, 2.5, 2.75, 2.875]
    assert bounces == pytest.approx([FIRST_BOUNCE * flight for flight in flights], abs=1e-8)
    plain = Instance3(build3("ball"))
    plain.initialize()
    plain.step(0.0, 1.3)
    assert instance.get(H, V) == pytest.approx(plain.get(H, V), abs=1e-7)
    instance.free()
    plain.free()


def test_an_event_that_is_not_carried_out_is_told_again(build3: Build) -> None:
    instance = _started(Instance3(build3("ball"), event_mode=True, early_return=True))
    first = instance.step(0.0, 1.0)
    again = instance.step(first.time, 1.0 - first.time)
    assert first.event
    assert (again.event, again.early, again.time) == (True, True, first.time)
    assert instance.get(BOUNCES) == [0]
    _event(instance)
    assert instance.get(BOUNCES) == [1]
    instance.free()


def test_without_early_return_events_are_carried_out_within_the_step(build3: Build) -> None:
    """All but one at the communication point, which the importer carries out."""
    instance = _started(Instance3(build3("sampler"), event_mode=True))
    inside = instance.step(0.0, 0.25)
    assert (inside.event, inside.early, inside.time) == (False, False, 0.25)
    assert instance.get(2) == [3.0], "ticks at 0, 0.1 and 0.2 s"
    at_the_end = instance.step(0.25, 0.05)
    assert (at_the_end.event, at_the_end.early) == (True, False)
    assert at_the_end.time == pytest.approx(0.3, abs=1e-15)
    assert instance.get(2) == [3.0]
    _event(instance)
    assert instance.get(2) == [4.0]
    instance.free()


@pytest.mark.parametrize(("beyond", "early"), [(0.5e-12, False), (1.5e-12, True)])
def test_an_instant_before_the_communication_point_is_not_early(
    build3: Build, beyond: float, early: bool
) -> None:
    """Times less than 1e-12 s apart are practically equal."""
    instance = _started(Instance3(build3("sampler"), event_mode=True, early_return=True))
    step = instance.step(0.0, 0.1 + beyond)
    assert (step.event, step.early, step.time) == (True, early, 0.1)
    instance.free()


def test_time_events_are_announced(build3: Build) -> None:
    instance = Instance3(build3("sampler"), event_mode=True, early_return=True)
    instance.initialize()
    time = 0.0
    for tick in range(1, 6):
        outcome = instance.update()
        assert (outcome.status, outcome.again, outcome.terminate) == (OK, False, False)
        assert not outcome.nominals_changed
        assert outcome.next_time == tick / 10.0
        instance.expect("fmi3EnterStepMode")
        step = instance.step(time, 1.0 - time)
        assert step.event
        assert step.time == pytest.approx(tick / 10.0, abs=1e-15)
        time = step.time
        instance.expect("fmi3EnterEventMode")
    instance.free()


def test_what_is_set_in_event_mode_takes_effect_there(build3: Build) -> None:
    instance = _started(Instance3(build3("lag"), event_mode=True))
    assert instance.step(0.0, 0.5).status == OK
    instance.expect("fmi3EnterEventMode")
    assert instance.set({GEAR: 3}, "Int32") == OK
    assert instance.set({LAG_U: 2.0, TAU: 0.25, LAG_X: 1.0}) == OK
    assert instance.update().status == OK
    assert instance.read("Int32", LAST_GEAR) == (OK, [3])
    assert instance.read("Boolean", HIGH) == (OK, [True])
    assert instance.get(HALF, LAG_X) == [0.125, 1.0]
    instance.expect("fmi3EnterStepMode")
    assert instance.step(0.5, 0.5).status == OK
    assert instance.get(LAG_X)[0] == pytest.approx(2.0 - math.exp(-2.0), abs=1e-8)
    instance.free()


def test_a_state_that_reinit_sets_cannot_be_set_in_event_mode(build3: Build) -> None:
    instance = Instance3(build3("ball"), event_mode=True)
    instance.initialize()
    assert instance.set({H: 0.5}) == OK
    assert instance.set({V: 1.0}) == ERROR
    assert '"v"' in instance.text
    instance.free()


def test_event_mode_that_was_not_asked_for_is_refused(build3: Build) -> None:
    instance = Instance3(build3("ball"))
    instance.initialize()
    assert instance.step(0.0, 1.0).event is False
    assert instance.call("fmi3EnterEventMode") == ERROR
    assert "eventModeUsed" in instance.text
    instance.free()


def test_the_model_ends_the_simulation(build3: Build) -> None:
    """The model "growth" with x = exp(t) ends at x > end."""
    instance = Instance3(build3("growth"))
    assert instance.set({3: 2.0}) == OK
    instance.initialize()
    step = instance.step(0.0, 1.0)
    assert (step.status, step.terminate, step.early) == (OK, True, False)
    assert step.time == pytest.approx(math.log(2.0), abs=1e-8)
    assert instance.get(0)[0] == pytest.approx(2.0, abs=1e-7)
    assert instance.step(step.time, 0.1).status == ERROR
    assert "after the model has ended the simulation" in instance.text
    instance.free()


def test_importers_return_early(build3: Build) -> None:
    """At once where the time is past, and at a later time as soon as it is reached."""
    updates: list[Update] = []

    def at_four_tenths(update: Update) -> float | None:
        updates.append(update)
        return 0.4

    instance = Instance3(build3("oscillator"), early_return=True, on_update=at_four_tenths)
    instance.initialize()
    step = instance.step(0.0, 1.0)
    assert (step.status, step.event, step.terminate) == (OK, False, False)
    assert step.early
    assert step.time >= 0.4
    assert all(update.finished and update.can_return_early and update.may_get for update in updates)
    times = [update.time for update in updates]
    assert times == sorted(times)
    assert times[-1] == step.time
    plain = Instance3(build3("oscillator"))
    plain.initialize()
    plain.step(0.0, step.time)
    assert instance.get(0, 1) == pytest.approx(plain.get(0, 1), abs=1e-7)
    instance.free()
    plain.free()


def test_no_early_return_where_it_is_not_allowed(build3: Build) -> None:
    instance = Instance3(build3("oscillator"), on_update=lambda update: update.time)
    instance.initialize()
    step = instance.step(0.0, 1.0)
    assert (step.early, step.time) == (False, 1.0)
    instance.free()


def _driven_lag(time: float) -> float:
    """The x of tau*der(x) = sin(3*t) - x, x(0) = 0, with tau = 0.5."""
    w, tau = 3.0, 0.5
    scale = 1.0 + (w * tau) ** 2
    return (math.sin(w * time) - w * tau * (math.cos(w * time) - math.exp(-time / tau))) / scale


def test_inputs_are_followed_within_a_step(build3: Build) -> None:
    """One communication step of 2 s under a sine, to the tolerance of the integrator."""
    updates: list[Update] = []

    def drive(update: Update) -> None:
        updates.append(update)
        if update.may_set:
            assert instance.set({LAG_U: math.sin(3.0 * update.time)}) == OK
        else:
            assert instance.get(LAG_X)[0] == pytest.approx(_driven_lag(update.time), abs=1e-8)

    instance = Instance3(build3("lag"), intermediate=(LAG_U, LAG_X), on_update=drive)
    assert instance.set({LAG_U: 0.0}) == OK
    instance.initialize(tolerance=1e-9)
    step = instance.step(0.0, 2.0)
    assert (step.status, step.early, step.time) == (OK, False, 2.0), instance.text
    assert instance.get(LAG_X, LAG_U) == pytest.approx([_driven_lag(2.0), math.sin(6.0)], abs=1e-8)
    assert all(0.0 <= update.time <= 2.0 and update.may_set != update.may_get for update in updates)
    finished = 0.0
    for update in updates:
        assert update.time >= finished, "never before a step that has been told as finished"
        finished = update.time if update.finished else finished
    assert finished == 2.0
    instance.free()


def test_a_relation_of_an_input_is_located(build3: Build) -> None:
    """The input u = 3*t passes 1.5 at 0.5 s."""

    def drive(update: Update) -> None:
        if update.may_set:
            assert instance.set({LAG_U: 3.0 * update.time}) == OK

    instance = Instance3(
        build3("lag"), event_mode=True, early_return=True, intermediate=(LAG_U,), on_update=drive
    )
    _started(instance)
    step = instance.step(0.0, 1.0)
    assert (step.event, step.early) == (True, True)
    assert step.time == pytest.approx(0.5, abs=1e-9)
    assert instance.read("Boolean", HIGH) == (OK, [False])
    _event(instance)
    assert instance.read("Boolean", HIGH) == (OK, [True])
    instance.free()


@pytest.mark.parametrize(
    ("access", "words"),
    [
        (lambda i, update: i.set({TAU: 1.0}) if update.may_set else OK, "required intermediate variables"),
        (lambda i, update: i.read("Float64", HALF)[0] if update.may_get else OK, "required intermediate"),
        (lambda i, update: i.read("Float64", LAG_X)[0] if update.may_set else OK, "does not allow it"),
        (lambda i, update: i.set({LAG_U: 1.0}) if update.may_get else OK, "does not allow it"),
        (lambda i, update: i.set({LAG_U: math.nan}) if update.may_set else OK, '"u" cannot be nan'),
        (lambda i, update: i.call("fmi3Reset"), "not allowed in Intermediate Update Mode"),
        (lambda i, update: i.step(0.0, 1.0).status, "not allowed in Intermediate Update Mode"),
    ],
)
def test_what_an_intermediate_update_does_not_allow_ends_the_step(
    build3: Build, access: Callable[[Instance3, Update], int], words: str
) -> None:
    statuses: list[int] = []

    def drive(update: Update) -> None:
        statuses.append(access(instance, update))

    instance = Instance3(build3("lag"), intermediate=(LAG_U, LAG_X), on_update=drive)
    instance.initialize()
    assert instance.step(0.0, 1.0).status == ERROR
    assert statuses[-1] == ERROR
    assert words in instance.text
    assert instance.step(0.0, 1.0).status == ERROR
    assert "in the terminated state" in instance.text
    instance.expect("fmi3Reset")
    instance.free()


@pytest.mark.parametrize(
    ("variables", "has_function", "words"),
    [
        ((99,), True, "does not exist"),
        ((TAU,), True, "not a continuous input or output"),
        ((GEAR,), True, "not a continuous input or output"),
        ((LAG_U,), False, "no function for the intermediate update"),
    ],
)
def test_intermediate_variables_that_cannot_be_had(
    build3: Build, variables: tuple[int, ...], has_function: bool, words: str
) -> None:
    on_update = (lambda update: None) if has_function else None
    instance = Instance3(build3("lag"), intermediate=variables, on_update=on_update)
    assert instance.handle is None
    assert words in instance.text


def test_event_indicators_are_read_as_variables(build3: Build) -> None:
    """They follow the last variable: behind 13 of them, 1.5 - u of a relation that does not hold."""
    instance = Instance3(build3("lag"))
    assert instance.read("Float64", 13)[0] == ERROR, "none before the initialization"
    instance.expect("fmi3Reset")
    instance.initialize()
    for u in (1.0, 0.25):
        assert instance.set({LAG_U: u}) == OK
        assert instance.get(13, LAG_U, 13) == pytest.approx([1.5 - u, u, 1.5 - u], abs=1e-11)
    assert instance.read("Float64", 14)[0] == ERROR
    instance.free()


def test_no_step_is_longer_than_a_fiftieth_of_the_experiment(build3: Build) -> None:
    """The state rests, so that nothing else limits the steps, which intermediate updates tell of."""
    times: list[float] = []
    instance = Instance3(
        build3("growth"), intermediate=(0,), on_update=lambda update: times.append(update.time)
    )
    assert instance.set({1: 0.0}) == OK
    instance.initialize(stop=10.0)
    instance.advance(0.0, 10.0)
    assert times[-1] == pytest.approx(10.0)
    assert max(b - a for a, b in pairwise([0.0, *times])) <= 0.2 * (1.0 + 1e-2)
    instance.free()


def test_counts_and_what_no_model_has(build3: Build) -> None:
    """States and event indicators of the model "ball"; Binary variables are named as missing."""
    instance = Instance3(build3("ball"), MODEL_EXCHANGE)
    for function, expected in (("ContinuousStates", 2), ("EventIndicators", 1)):
        number = ctypes.c_size_t(99)
        instance.expect(f"fmi3GetNumberOf{function}", ctypes.byref(number))
        assert number.value == expected
    one = ctypes.c_size_t(1)
    for access in ("Get", "Set"):
        assert instance.call(f"fmi3{access}Binary", (ctypes.c_uint32 * 1)(H), one, None, None, one) == ERROR
        assert "Binary" in instance.messages[-1][2]
    instance.free()


@pytest.mark.parametrize("missing", range(4))
def test_a_step_needs_a_place_for_each_result(build3: Build, missing: int) -> None:
    instance = Instance3(build3("ball"))
    instance.initialize()
    places = [*(ctypes.byref(ctypes.c_bool()) for _ in range(3)), ctypes.byref(ctypes.c_double())]
    places[missing] = None
    assert instance.call("fmi3DoStep", 0.0, 0.1, True, *places) == ERROR
    assert "null pointer" in instance.text
    instance.free()
