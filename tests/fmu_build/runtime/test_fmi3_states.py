"""FMI 3 saved states and multiple instances, in one process and in threads of Python and C."""

from __future__ import annotations

import ctypes as c
import math
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from importlib import resources
from pathlib import Path

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import CO_SIMULATION, ERROR, MODEL_EXCHANGE, OK, TOKEN
from tests.fmu_build.runtime.library3 import Instance3, Update
from tests.fmu_build.runtime.saved_runs import SIZE, check_detours, steps

_THREADS = Path(__file__).with_name("threads.c")


@pytest.mark.parametrize("model", ["joystick", "ball", "oscillator"])
def test_restored_run_is_bit_identical(build3: Build, model: str) -> None:
    check_detours(Instance3(build3(model)), "fmi3Reset", 2)


def test_serialized_state_continues_in_another_instance(build3: Build) -> None:
    first, second = Instance3(build3("joystick")), Instance3(build3("joystick"))
    assert first.set({8: 0.012}) == OK
    first.initialize(1e-9, stop=2.0)
    steps(first, 0, 37)
    state = first.save()
    status, copy = second.deserialize(first.serialize(state))
    assert status == OK
    second.restore(copy)
    assert steps(first, 37, 200) == steps(second, 37, 200)
    for instance, saved in ((first, state), (second, copy)):
        instance.discard(saved)
        instance.free()


def test_a_state_saved_before_an_event_leads_to_the_event_again(build3: Build) -> None:
    instance = Instance3(build3("ball"), event_mode=True, early_return=True)
    instance.initialize()
    assert instance.update().status == OK
    instance.expect("fmi3EnterStepMode")
    first = instance.step(0.0, 1.0)
    assert first.event
    state = instance.save()

    def on() -> list[float]:
        instance.expect("fmi3EnterEventMode")
        assert instance.update().status == OK
        instance.expect("fmi3EnterStepMode")
        step = instance.step(first.time, 0.1)
        return [step.time, *instance.get(0, 1, 2)]

    expected = on()
    instance.restore(state)
    assert on() == expected
    instance.discard(state)
    instance.free()


def test_a_state_brings_an_instance_back_from_an_error(build3: Build) -> None:
    instance = Instance3(build3("joystick"))
    instance.initialize()
    expected = steps(instance, 0, 20)
    instance.expect("fmi3Reset")
    instance.initialize()
    assert steps(instance, 0, 10) == expected[:10]
    state = instance.save()
    assert instance.step(5.0, 0.1).status == ERROR
    assert instance.step(10 * SIZE, SIZE).status == ERROR, "it is terminated"
    instance.restore(state)
    assert steps(instance, 10, 20) == expected[10:]
    instance.discard(state)
    instance.free()


def test_inputs_that_are_asked_for_are_asked_again(build3: Build) -> None:
    def drive(update: Update) -> None:
        if update.may_set:
            assert instance.set({4: math.sin(3.0 * update.time)}) == OK

    instance = Instance3(build3("lag"), intermediate=(4,), on_update=drive)
    instance.initialize()
    assert instance.step(0.0, 0.5).status == OK
    state = instance.save()
    assert instance.step(0.5, 0.5).status == OK
    expected = instance.get(1, 4)
    instance.restore(state)
    assert instance.step(0.5, 0.5).status == OK
    assert instance.get(1, 4) == expected
    instance.discard(state)
    instance.free()


def test_model_exchange_state(build3: Build) -> None:
    instance = Instance3(build3("ball"), MODEL_EXCHANGE)
    instance.initialize()
    assert instance.update().status == OK
    instance.expect("fmi3EnterContinuousTimeMode")
    state = instance.save()
    instance.expect("fmi3SetTime", 3.0)
    instance.expect("fmi3SetContinuousStates", (c.c_double * 2)(5.0, 6.0), c.c_size_t(2))
    instance.expect("fmi3EnterEventMode")
    instance.restore(state)
    assert instance.get(0, 1) == [1.0, 0.0]
    instance.expect("fmi3CompletedIntegratorStep", True, c.byref(c.c_bool()), c.byref(c.c_bool()))
    instance.discard(state)
    instance.free()


def test_states_of_the_other_kind_are_refused(build3: Build) -> None:
    exchange, slave = (Instance3(build3("oscillator"), kind) for kind in (MODEL_EXCHANGE, CO_SIMULATION))
    state = exchange.save()
    assert slave.deserialize(exchange.serialize(state))[0] == ERROR
    assert "Model Exchange" in slave.text
    slave.expect("fmi3Reset")
    assert slave.call("fmi3SetFMUState", state) == ERROR
    exchange.discard(state)
    exchange.free()
    slave.free()


def test_instances_in_python_threads(build3: Build) -> None:
    """Free-running: ctypes lets the interpreter go during a call."""
    library = build3("joystick")
    angles = [-0.34, -0.2, 0.1, 0.3]

    def alone(angle: float) -> list[list[float]]:
        instance = Instance3(library)
        assert instance.set({0: angle}) == OK
        instance.initialize(stop=0.1)
        values = instance.run(0.1, 300, (0, 1))
        instance.free()
        return values

    expected = [alone(angle) for angle in angles]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(alone, angles * 5)) == expected * 5


@pytest.mark.skipif(sys.platform == "win32", reason="the program has POSIX threads")
def test_instances_in_c_threads(build3: Build, tmp_path: Path) -> None:
    """Eight threads with an instance each, and a ninth that goes through the same runs one by one."""
    program = tmp_path / "threads"
    headers = resources.files("fmpy") / "c-code"
    command = [sys.executable, "-m", "ziglang", "cc", "-std=c11", "-O2", "-isystem", str(headers)]
    subprocess.run([*command, str(_THREADS), "-o", str(program), "-lpthread", "-ldl"], check=True)
    done = subprocess.run(
        [program, build3("joystick")._name, TOKEN], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "8 runs in threads, 8 one by one: 0 differ\n"
