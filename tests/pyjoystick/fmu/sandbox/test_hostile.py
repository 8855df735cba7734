"""Hostile modules: each causes an error that names the attack, never a crash or a hang."""

from __future__ import annotations

import _thread
import threading
import time

import pytest

from pyjoystick.fmu import (
    Fmu,
    FmuFileError,
    FmuFuelError,
    FmuMemoryError,
    FmuRunError,
    FmuTimeLimitError,
    FmuTrapError,
)
from pyjoystick.fmu.sandbox import machine, module as sandbox_module
from tests.pyjoystick.fmu.sandbox.hostile import Smuggle, module

_TIME = [0.0, 0.5, 1.0]
_FOREVER = "(loop $again (br $again)) (unreachable)"
_START = '(func (export "_initialize") {})'
_OUTSIDE = "(i32.const -16)"  # the last bytes that 32 bits can address


def test_a_tame_module_runs(smuggle: Smuggle) -> None:
    with Fmu(smuggle(module()), sandbox=True) as fmu:
        table = fmu.run(_TIME)
        assert (table.to_numpy(dtype=float) == 0.0).all()
        assert len(table) == 3


@pytest.mark.parametrize(
    ("bodies", "kind", "message"),
    [
        ({"explore_record": "(unreachable)"}, FmuTrapError, "it trapped: .*unreachable"),
        ({"explore_record": "(i32.div_s (i32.const 1) (i32.const 0))"}, FmuTrapError, "divide by zero"),
        ({"explore_record": "(i32.load (i32.const -4))"}, FmuTrapError, "out of bounds memory access"),
        ({"explore_begin": "(call 2 (f64.const 0) (f64.const 0) (f64.const 0))"}, FmuTrapError, "stack"),
        ({"explore_begin": _FOREVER}, FmuFuelError, "more than 1e[+]06 instructions"),
        ({"malloc": _OUTSIDE}, FmuTrapError, "an address outside its memory: 4294967280 for"),
        ({"malloc": "(i32.const 131064)"}, FmuTrapError, "an address outside its memory: 131064 for"),
        ({"malloc": "(i32.const 0)"}, FmuMemoryError, "no memory for .* bytes .at most 256 MiB."),
        ({"explore_record": "(i32.const 4)"}, FmuTrapError, "filled 4 rows of 3"),
        ({"explore_record": "(i32.const -1)"}, FmuTrapError, "filled -1 rows of 3"),
        ({"explore_record": "(i32.const 2)"}, FmuRunError, "t = 0.5 s: .*status 0 .not a status."),
        (
            {"explore_begin": "(i32.const 3)", "explore_message": _OUTSIDE},
            FmuTrapError,
            "an address outside its memory",
        ),
        ({"explore_begin": "(i32.const 99)"}, FmuRunError, "set-up of the experiment failed with status 99"),
    ],
)
def test_a_broken_rule_is_an_error_and_the_next_run_has_a_new_machine(
    smuggle: Smuggle,
    monkeypatch: pytest.MonkeyPatch,
    bodies: dict[str, str],
    kind: type[FmuRunError],
    message: str,
) -> None:
    monkeypatch.setattr(machine, "MOST_FUEL", 1e6)
    with Fmu(smuggle(module(**bodies)), sandbox=True) as fmu:
        for _ in range(2):
            with pytest.raises(kind, match=message) as caught:
                fmu.run(_TIME)
            assert type(caught.value) is kind


@pytest.mark.parametrize(
    ("output", "value"), [("steps", "1e300"), ("steps", "0.5"), ("above", "2"), ("above", "nan")]
)
def test_numbers_that_a_type_does_not_have_are_refused(smuggle: Smuggle, output: str, value: str) -> None:
    body = f"(f64.store (local.get 5) (f64.const {value})) (local.get 3)"
    refused = pytest.raises(FmuTrapError, match=f"{output} is not a number of its type")
    with Fmu(smuggle(module(explore_record=body)), sandbox=True) as fmu, refused:
        fmu.run(_TIME, outputs=[output])


def test_the_end_of_a_run_lies_within_the_step_whatever_the_module_says(smuggle: Smuggle) -> None:
    bodies = {"explore_record": "(i32.const 1)", "explore_status": "(i32.const 2)"}
    for value, end in (("nan", 0.0), ("inf", 0.0), ("-5", 0.0), ("0.25", 0.25), ("7", 0.5)):
        with Fmu(smuggle(module(**bodies, explore_time=f"(f64.const {value})")), sandbox=True) as fmu:
            with pytest.raises(FmuRunError, match="the FMU ended the simulation") as caught:
                fmu.run(_TIME)
            assert caught.value.time == end


def test_memory_does_not_grow_beyond_the_limit(smuggle: Smuggle) -> None:
    # Pages of 64 KiB, as many as there are, then as many rows as could be had.
    grow = "(loop $more (br_if $more (i32.ne (memory.grow (i32.const 64)) (i32.const -1)))) (memory.size)"
    most = machine.LARGEST_MEMORY // 65536 - 62  # it began with 2, and grows by 64
    refused = pytest.raises(FmuTrapError, match=f"filled {most} rows of 3")
    with Fmu(smuggle(module(explore_record=grow)), sandbox=True) as fmu, refused:
        fmu.run(_TIME)


def test_an_endless_loop_ends_with_the_time_limit(smuggle: Smuggle) -> None:
    with Fmu(smuggle(module(explore_record=_FOREVER)), sandbox=True, time_limit=0.1) as fmu:
        for _ in range(2):
            with pytest.raises(FmuTimeLimitError, match=r"longer than the time limit of 0\.1 s"):
                fmu.run(_TIME)


def test_a_batch_of_endless_loops_can_be_stopped(smuggle: Smuggle) -> None:
    with Fmu(smuggle(module(explore_record=_FOREVER)), sandbox=True) as fmu:
        plan = fmu.plan(_TIME, varied=["start"], outputs=["y"])
        stopper = threading.Timer(0.2, plan.stop)
        stopper.start()
        batch = plan.run_batch([[0.0]] * 4, threads=2)
        stopper.join()
        assert batch.interrupted
        assert not batch.done.any()


def test_ctrl_c_ends_an_endless_loop(smuggle: Smuggle) -> None:
    timer = threading.Timer(0.2, _thread.interrupt_main)
    with Fmu(smuggle(module(explore_record=_FOREVER)), sandbox=True) as fmu:
        with pytest.raises(KeyboardInterrupt):  # noqa: PT012 - the signal may come before the run
            timer.start()
            fmu.run(_TIME)
        left = [thread.name for thread in threading.enumerate() if thread.name.startswith("sandbox")]
        for _ in range(100):  # the threads of earlier tests, and this one's, come to their ends
            if not left:
                break
            time.sleep(0.05)
            left = [thread.name for thread in threading.enumerate() if thread.name.startswith("sandbox")]
        assert not left


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"no module", "cannot be compiled"),
        (
            module(more='(import "wasi" "fd_write" (func))'),
            "imports functions that the sandbox does not provide: wasi.fd_write",
        ),
        (module(memory="(memory 1)"), "does not export what a run needs: memory"),
        (module(malloc="", explore_record=""), "needs: malloc, explore_record"),
        (module(more=_START.format("(unreachable)")), "cannot be started: it trapped: .*unreachable"),
        (module(more=_START.format("(loop $again (br $again))")), "cannot be started: it took more than"),
        (module(memory='(memory (export "memory") 8192)'), "cannot be started: .*memory"),
        (module(more="(table 100000 funcref)"), "cannot be started: .*table"),
        (module(memory='(memory (export "memory") i64 1)'), "cannot be compiled"),
    ],
)
def test_modules_that_cannot_be_used_are_refused_when_they_are_opened(
    smuggle: Smuggle, monkeypatch: pytest.MonkeyPatch, content: bytes, message: str
) -> None:
    monkeypatch.setattr(machine, "MOST_FUEL", 1e6)
    with pytest.raises(FmuFileError, match=message):
        Fmu(smuggle(content), sandbox=True)


def test_large_modules_are_refused_before_they_are_compiled(
    smuggle: Smuggle, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sandbox_module, "LARGEST_MODULE", 100)
    with pytest.raises(FmuFileError, match=r"a WebAssembly module of \d+ bytes: at most 100 are allowed"):
        Fmu(smuggle(module()), sandbox=True)


def test_a_function_of_another_type_counts_as_missing(smuggle: Smuggle) -> None:
    other = '(func (export "explore_time") (result i32) (i32.const 0))'
    with pytest.raises(FmuFileError, match="needs: explore_time"):
        Fmu(smuggle(module(explore_time="", more=other)), sandbox=True)
