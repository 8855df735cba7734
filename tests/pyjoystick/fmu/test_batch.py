"""Batches: independent of the number of threads; marked failures, interruption, and memory."""

from __future__ import annotations

import math
import os
import pickle
import threading
import time as clock
import tracemalloc
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import (
    Extremes,
    Final,
    Fmu,
    FmuFileError,
    FmuTimeLimitError,
    Loss,
    Peaks,
    plan as plan_module,
)
from pyjoystick.fmu.batch import Batch
from pyjoystick.support import ParameterError, UnknownVariableError
from tests.pyjoystick.fmu import awkward
from tests.pyjoystick.fmu.awkward import Trouble

TIME = np.linspace(0.0, 0.3, 61)
CLEARANCE = "forward.balanceSpring.x_0"
VARIED = ("theta_start", CLEARANCE)
OUTPUTS = ("theta", "omega", "E")
REDUCTIONS = (Final("omega"), Extremes("theta"), Peaks("theta", 2, "omega"), Peaks("omega", 2), Loss("E"))


def joysticks(runs: int) -> pd.DataFrame:
    """A table of parameters in which every eleventh run is one that the FMU cannot carry out."""
    random = np.random.default_rng(3)
    table = pd.DataFrame(
        {CLEARANCE: random.uniform(2e-3, 3e-3, runs), "theta_start": random.uniform(-0.35, 0.35, runs)},
        index=pd.RangeIndex(100, 100 + runs, name="run"),
    )
    table.loc[table.index[::11], CLEARANCE] = 0.0
    return table


def test_runs_are_those_of_the_plan(joystick: Fmu, loop: str) -> None:
    plan = joystick.plan(TIME, varied=VARIED, outputs=OUTPUTS)
    table = joysticks(12)
    batch = plan.run_batch(table)
    assert batch.values is not None
    assert batch.values.shape == (12, 61, 3)
    assert batch.reduced is None
    assert not batch.interrupted
    assert batch.done.all()
    np.testing.assert_array_equal(np.flatnonzero(batch.failed), [0, 11])
    pd.testing.assert_frame_equal(batch.parameters, table[list(VARIED)])
    for i, row in enumerate(batch.parameters.to_numpy()):
        if batch.failed[i]:
            assert np.isnan(batch.values[i]).all()
            assert batch.messages[i].startswith("Joystick.fmu at t = 0 s: ")
        else:
            np.testing.assert_array_equal(batch.values[i], plan.run(row))
            assert batch.messages[i] == ""


def test_threads_and_order_change_nothing(joystick: Fmu, loop: str) -> None:
    plan = joystick.plan(TIME, varied=VARIED, outputs=OUTPUTS)
    table = joysticks(40 if loop == "plain" else 300)
    shuffled = table.sample(frac=1.0, random_state=5)
    expected = plan.run_batch(table, threads=1)
    reduced = plan.run_batch(table, threads=1, reductions=REDUCTIONS).reduced
    assert expected.values is not None
    assert reduced is not None
    for threads in (1, 2, 3):
        batch = plan.run_batch(table, threads=threads)
        np.testing.assert_array_equal(batch.values, expected.values)
        assert batch.messages == expected.messages
        again = plan.run_batch(shuffled, threads=threads, reductions=REDUCTIONS)
        assert again.values is None
        assert again.reduced is not None
        pd.testing.assert_frame_equal(again.reduced.sort_index(), reduced, check_exact=True)
        by_run = dict(zip(shuffled.index, again.messages, strict=True))
        assert [by_run[run] for run in table.index] == expected.messages


def test_failures_of_every_kind_are_rows(awkward_fmu: Fmu, loop: str) -> None:
    """The library aborts at a call to an instance that has failed fatally."""
    troubles = [trouble for trouble in Trouble if trouble not in awkward.ROUGH] * 12
    plan = awkward_fmu.plan(TIME, varied=("trouble", "when", "gain"), inputs={"u": 1.0}, outputs="y")
    table = [(trouble, 0.0951, gain) for gain, trouble in enumerate(troubles)]
    fails = {Trouble.ERROR, Trouble.DISCARD, Trouble.FATAL, Trouble.NO_STATUS}
    fails |= {Trouble.REFUSED_START, Trouble.ENDS}
    for threads in (1, 2, 3):
        batch = plan.run_batch(table, threads=threads)
        assert batch.values is not None
        assert batch.failed.tolist() == [trouble in fails for trouble in troubles]
        for gain, trouble in enumerate(troubles):
            if trouble == Trouble.REFUSED_START:
                assert "at t = 0 s: 100 % refused" in batch.messages[gain]
            elif trouble == Trouble.ENDS:
                end = "awkward.fmu: the FMU ended the simulation at t = 0.1025 s"
                assert batch.messages[gain].startswith(end)
                np.testing.assert_allclose(batch.values[gain, :21, 0], gain * TIME[:21], rtol=1e-14)
                assert np.isnan(batch.values[gain, 21:]).all()
            elif trouble in fails:
                assert batch.messages[gain].startswith("awkward.fmu at t = 0.1 s: trouble at 0.1 (fmi2DoStep")
            else:
                assert batch.messages[gain] == ""
                np.testing.assert_allclose(batch.values[gain, :, 0], gain * TIME, rtol=1e-14)


@pytest.mark.parametrize("own_process", [False, True])
def test_samples_that_are_not_finite_are_failures(awkward_path: Path, own_process: bool, loop: str) -> None:
    """They are kept: what else the run has may be right."""
    instants = np.linspace(0.0, 3.0, 7)
    with Fmu(awkward_path, own_process=own_process) as fmu:
        plan = fmu.plan(instants, varied="gain", inputs={"u": 1.0}, outputs=["u", "y"])
        for threads in (1, 2):
            batch = plan.run_batch([[1.0], [1e308], [2.0]] * 40, threads=threads)
            assert batch.failed.tolist() == [False, True, False] * 40
            assert batch.messages == ["", "results are not finite: y is inf at t = 2 s", ""] * 40
            assert batch.done.all()
            assert batch.values is not None
            assert batch.values[1, :, 1].tolist() == [0.0, 0.5e308, 1e308, 1.5e308, *[math.inf] * 3]


def test_messages_belong_to_their_run(awkward_fmu: Fmu, loop: str) -> None:
    """Warnings of the runs before, in the same piece of work, are not told."""
    plan = awkward_fmu.plan(TIME, varied=("trouble", "when"), outputs="y")
    table = [(Trouble.WARNINGS, 0.29)] * 30 + [(Trouble.ERROR, 0.2)]
    batch = plan.run_batch(table, threads=1)
    assert (
        batch.messages[-1]
        == "awkward.fmu at t = 0.2 s: trouble at 0.2 (fmi2DoStep failed with status 3 (error))"
    )
    assert set(batch.messages[:-1]) == {""}


def test_a_second_instance_is_refused(awkward_library: Path, tmp_path: Path, loop: str) -> None:
    path = awkward.build(2, tmp_path / "lonely.fmu", awkward_library, guid="only-one")
    with Fmu(path) as fmu:
        plan = fmu.plan(TIME, varied="gain", inputs={"u": 1.0}, outputs="y")
        batch = plan.run_batch(np.arange(20.0)[:, None], threads=3)
    assert batch.values is not None
    assert not batch.failed.any()
    np.testing.assert_allclose(batch.values[:, -1, 0], 0.3 * np.arange(20.0))


def test_an_fmu_that_can_be_instantiated_once_has_one_thread(
    awkward_library: Path, tmp_path: Path, loop: str
) -> None:
    """Another thread waits for its turn instead of being refused."""
    attributes = 'canBeInstantiatedOnlyOncePerProcess="true"'
    path = awkward.build(2, tmp_path / "once.fmu", awkward_library, guid="only-one", attributes=attributes)
    with Fmu(path) as fmu:
        plan = fmu.plan(TIME, varied=("gain", "delay"), inputs={"u": 1.0}, outputs="y")
        ended: list[float] = []
        thread = threading.Thread(
            target=lambda: ended.append(plan.run_batch([(2.0, 1.0)] * 3).values[-1, -1, 0])  # type: ignore[index]
        )
        thread.start()
        while not plan._batches:
            clock.sleep(0.001)
        assert plan.run([1.0, 0.0])[-1, 0] == pytest.approx(0.3)
        thread.join()
    assert ended == [pytest.approx(0.6)]


def test_runs_without_an_instance_fail_with_the_reason(
    awkward_library: Path, tmp_path: Path, loop: str
) -> None:
    """After a fatal failure the old instance may not be freed, and this FMU refuses a second one."""
    path = awkward.build(2, tmp_path / "lonely.fmu", awkward_library, guid="only-one")
    with Fmu(path, own_process=False) as fmu:
        plan = fmu.plan(TIME, varied="trouble", outputs="y")
        batch = plan.run_batch([[0], [0], [Trouble.FATAL], [0], [0]], threads=2)
        with pytest.raises(FmuFileError, match="cannot be instantiated: a second instance"):
            plan.run([0])
    assert batch.done.all()
    assert batch.failed.tolist() == [False, False, True, True, True]
    assert "status 4 (fatal)" in batch.messages[2]
    assert all("cannot be instantiated: a second instance" in message for message in batch.messages[3:])


def test_instances_are_kept_for_the_next_batch(joystick: Fmu) -> None:
    plan = joystick.plan(TIME, varied=VARIED, outputs=OUTPUTS)
    table = joysticks(40)
    table = table[table[CLEARANCE] > 0.0]  # an instance whose run has failed is not kept
    plan.run_batch(table, threads=3)
    kept = {id(instance) for instance in joystick._pool._idle}
    assert len(kept) == 3
    plan.run_batch(table, threads=3)
    plan.run_batch(table, threads=2)
    assert {id(instance) for instance in joystick._pool._idle} == kept


def test_progress_is_told_in_the_calling_thread(awkward_fmu: Fmu, loop: str) -> None:
    plan = awkward_fmu.plan([0.0, 0.1, 0.2], varied=("delay", "trouble"), outputs="y")
    told: list[tuple[int, int, threading.Thread]] = []
    plan.run_batch(
        [(5.0, Trouble.NONE), (5.0, Trouble.ERROR)] * 30,
        threads=2,
        on_progress=lambda done, runs: told.append((done, runs, threading.current_thread())),
    )
    counts = [done for done, _, _ in told]
    assert counts == sorted(set(counts))
    assert counts[-1] == 60
    assert len(counts) > 2
    assert {(runs, thread) for _, runs, thread in told} == {(60, threading.current_thread())}


def test_an_exception_in_the_progress_stops_the_batch(awkward_fmu: Fmu, loop: str) -> None:
    plan = awkward_fmu.plan([0.0, 0.1], varied="delay", outputs="y")

    def refuse(done: int, runs: int) -> None:
        raise ZeroDivisionError(f"{done} of {runs}")

    with pytest.raises(ZeroDivisionError):
        plan.run_batch([[20.0]] * 1000, threads=2, on_progress=refuse)
    assert not awkward_fmu._pool._taken
    assert not plan._batches


def test_another_thread_may_stop_a_batch(awkward_fmu: Fmu, loop: str) -> None:
    plan = awkward_fmu.plan(
        np.linspace(0.0, 1.0, 6), varied=("gain", "delay"), inputs={"u": 1.0}, outputs="y"
    )
    is_under_way = threading.Event()

    def stop() -> None:
        is_under_way.wait()
        plan.stop()

    thread = threading.Thread(target=stop)
    thread.start()

    def tell(done: int, _: int) -> None:
        if done:
            is_under_way.set()

    table = [(2.0, 5.0)] * 1000
    batch = plan.run_batch(table, threads=2, reductions=[Final("y")], on_progress=tell)
    thread.join()
    assert batch.interrupted
    assert batch.reduced is not None
    done = batch.done
    assert 0 < done.sum() < 1000
    assert not batch.failed.any()
    np.testing.assert_allclose(batch.reduced["y.final"][done], 2.0, rtol=1e-14)
    assert batch.reduced["y.final"][~done].isna().all()
    assert not plan.run_batch([(2.0, 0.0)] * 10).interrupted


def test_a_batch_may_be_stopped_before_it_begins(
    awkward_fmu: Fmu, loop: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """While the compiler is loaded, which takes seconds."""
    plan = awkward_fmu.plan([0.0, 0.1], varied="gain", outputs="y")
    real = plan_module.loop

    def slow(*arguments: Any, **settings: Any) -> Any:
        plan.stop()
        return real(*arguments, **settings)

    monkeypatch.setattr(plan_module, "loop", slow)
    batch = plan.run_batch([[1.0]] * 1000)
    assert batch.interrupted
    assert not batch.done.any()
    monkeypatch.undo()
    assert plan.run_batch([[1.0]] * 10).done.all()


def test_a_run_that_takes_too_long_is_a_row(awkward_path: Path, loop: str) -> None:
    """Between two communication points; the others are as without a limit, whatever the threads."""
    table = [(1.0, 0.0), (2.0, 0.0), (1.0, 50.0), (3.0, 0.0), (1.0, 50.0), (4.0, 2.0)] * 2
    late = [delay > 10.0 for _, delay in table]
    with Fmu(awkward_path, own_process=False, time_limit=0.4) as fmu:
        plan = fmu.plan(TIME, varied=("gain", "delay"), inputs={"u": 1.0}, outputs="y")
        for threads in (1, 3):
            begin = clock.perf_counter()
            batch = plan.run_batch(table, threads=threads)
            # A late run would take 3 s.
            assert clock.perf_counter() - begin < 6.0
            assert batch.failed.tolist() == late
            assert batch.done.all()
            assert not batch.interrupted
            assert batch.values is not None
            for (gain, _), is_late, values, message in zip(
                table, late, batch.values[..., 0], batch.messages, strict=True
            ):
                if is_late:
                    assert np.isnan(values).all()
                    assert message.endswith("(the run took longer than the time limit of 0.4 s)")
                else:
                    np.testing.assert_allclose(values, gain * TIME, rtol=1e-14)


def test_a_single_run_that_takes_too_long(awkward_path: Path, loop: str) -> None:
    """Also one that is far slower than those of the same plan before it, and in any thread."""
    with Fmu(awkward_path, own_process=False, time_limit=0.3) as fmu:
        plan = fmu.plan(TIME, varied="delay", outputs="y")
        sound = plan.run([0.0])
        with ThreadPoolExecutor(1) as other:
            for submit in (plan.run, lambda values: other.submit(plan.run, values).result()):
                begin = clock.perf_counter()
                with pytest.raises(
                    FmuTimeLimitError, match=r"longer than the time limit of 0\.3 s"
                ) as raised:
                    submit([50.0])
                assert clock.perf_counter() - begin < 2.0
                assert 0.0 < raised.value.time < TIME[-1]
                np.testing.assert_array_equal(plan.run([0.0]), sound)
        with pytest.raises(FmuTimeLimitError):
            fmu.run(TIME, parameters={"delay": 50.0})
        again = pickle.loads(pickle.dumps(fmu))
        with again, pytest.raises(FmuTimeLimitError):
            again.run(TIME, parameters={"delay": 50.0})
    for limit in (0.0, -1.0, math.nan, "1"):
        with pytest.raises(ParameterError, match="time_limit = "):
            Fmu(awkward_path, time_limit=limit)  # type: ignore[arg-type]


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork")
def test_a_forked_process_keeps_to_the_limit(awkward_path: Path) -> None:
    with Fmu(awkward_path, own_process=False, time_limit=0.3) as fmu:
        fmu.run(TIME, parameters={"delay": 2.0})
        child = os.fork()
        if not child:
            try:
                fmu.run(TIME, parameters={"delay": 50.0})
            except FmuTimeLimitError:
                os._exit(7)
            finally:
                os._exit(1)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7


def test_a_step_that_never_ends_does_not_hold_the_batch(awkward_fmu: Fmu, loop: str) -> None:
    plan = awkward_fmu.plan([0.0, 0.1], varied=("trouble", "gain"), inputs={"u": 1.0}, outputs="y")
    table = [(Trouble.NONE, 1.0)] * 20 + [(Trouble.FOREVER, 1.0)] + [(Trouble.NONE, 1.0)] * 20

    def stop_when_the_rest_is_done(done: int, runs: int) -> None:
        if done == runs - 1:
            raise KeyboardInterrupt

    batch = plan.run_batch(table, threads=2, on_progress=stop_when_the_rest_is_done)
    assert batch.interrupted
    assert np.flatnonzero(~batch.done).tolist() == [20]
    assert batch.values is not None
    assert np.isnan(batch.values[20]).all()
    assert not np.isnan(np.delete(batch.values, 20, axis=0)).any()
    # The lost instance is not used again.
    assert not plan.run_batch([(Trouble.NONE, 1.0)] * 4, threads=2).interrupted


def test_ctrl_c_while_a_thread_starts_leaves_its_instance_to_it(
    joystick: Fmu, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An instance that the main thread gave back as well could be freed while it ran."""
    start, finish = threading.Thread.start, Batch._finish
    finished_by: list[threading.Thread] = []

    def interrupted(thread: threading.Thread) -> None:
        start(thread)
        monkeypatch.setattr(threading.Thread, "start", start)
        raise KeyboardInterrupt

    def counted(batch: Batch, runner: Any) -> None:
        finished_by.append(threading.current_thread())
        finish(batch, runner)

    monkeypatch.setattr(Batch, "_finish", counted)
    plan = joystick.plan(TIME, varied=VARIED, outputs=OUTPUTS)
    monkeypatch.setattr(threading.Thread, "start", interrupted)
    assert plan.run_batch(np.full((200, len(VARIED)), 0.1), threads=2).interrupted
    # The main thread gives back only the one that no thread has taken.
    assert len(finished_by) == 2
    assert finished_by.count(threading.main_thread()) == 1


def test_an_empty_table(joystick: Fmu) -> None:
    plan = joystick.plan(TIME, varied=VARIED, outputs=OUTPUTS)
    batch = plan.run_batch(np.empty((0, 2)))
    assert batch.values is not None
    assert batch.values.shape == (0, 61, 3)
    reduced = plan.run_batch(joysticks(0), reductions=[Final("theta")]).reduced
    assert reduced is not None
    assert reduced.shape == (0, 1)


def test_memory_does_not_grow_with_reduced_runs(awkward_fmu: Fmu) -> None:
    """Samples of one run take 80 kB; results, parameters and marks of one run below 200 bytes."""
    plan = awkward_fmu.plan(np.linspace(0.0, 1.0, 10_001), varied="gain", inputs={"u": 1.0}, outputs="y")

    def peak(runs: int) -> int:
        tracemalloc.start()
        plan.run_batch(np.ones((runs, 1)), threads=2, reductions=[Final("y"), Extremes("y")])
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    peak(10)
    few, many = peak(100), peak(2100)
    assert many - few < 2000 * 200
    assert few < 100 * 10_001 * 8 / 4


GOOD = pd.DataFrame({"J": [0.01, 0.02], "theta_start": [0.1, 0.2]})


@pytest.mark.parametrize(
    ("table", "settings", "error", "message"),
    [
        (
            [[0.1]],
            {},
            ParameterError,
            r"table = an array of shape \(1, 1\): must be of shape \(runs, 2\), for theta",
        ),
        ([0.1, 0.01], {}, ParameterError, r"table = an array of shape \(2,\)"),
        ([[0.1, 0.01], [0.1, -1.0]], {}, ParameterError, r"J\[1\] = -1\.0: must be"),
        ([[np.nan, 0.01]], {}, ParameterError, r"theta_start\[0\] = nan: must be a finite number"),
        (
            pd.DataFrame({"J": [0.01]}),
            {},
            ParameterError,
            "table = the columns J: must be the varied: theta_start, J",
        ),
        (
            pd.DataFrame({"J": ["a"], "theta_start": [1.0]}),
            {},
            ParameterError,
            "values = an object of type DataFrame: must be made of numbers",
        ),
        (GOOD.assign(x=1.0), {}, ParameterError, "table = the columns J, theta_start, x"),
        (GOOD, {"threads": 0}, ParameterError, "threads = 0: must be a whole number, 1 or more"),
        (GOOD, {"threads": 1.5}, ParameterError, r"threads = 1\.5"),
        (GOOD, {"reductions": []}, ParameterError, "reductions = an empty sequence"),
        (GOOD, {"reductions": ["theta"]}, ParameterError, "reductions = theta"),
        (GOOD, {"reductions": [Final("alpha")]}, UnknownVariableError, "alpha"),
        (GOOD, {"reductions": [Peaks("theta", 1, "alpha")]}, UnknownVariableError, "alpha"),
        (GOOD, {"reductions": [Final("E"), Final("E")]}, ParameterError, "a second column E.final"),
    ],
)
def test_batches_that_are_refused(
    joystick: Fmu, table: Any, settings: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        joystick.plan(TIME, varied=("theta_start", "J"), outputs=OUTPUTS).run_batch(table, **settings)


def test_a_wrong_value_is_named_by_the_index_of_the_table(joystick: Fmu) -> None:
    table = pd.DataFrame({"theta_start": [0.1, 0.2, 0.3], "J": [0.01, np.nan, 0.01]}, index=[7, 103, 9])
    with pytest.raises(ParameterError, match=r"J\[103\] = nan"):
        joystick.plan(TIME, varied=("theta_start", "J"), outputs=OUTPUTS).run_batch(table)


def test_samples_that_do_not_fit_into_memory(joystick: Fmu, monkeypatch: pytest.MonkeyPatch) -> None:
    empty = np.empty

    def limited(shape: tuple[int, ...], *settings: Any, **named: Any) -> Any:
        if np.prod(shape) > 1e9:
            raise MemoryError
        return empty(shape, *settings, **named)

    monkeypatch.setattr("pyjoystick.fmu.plan.np.empty", limited)
    plan = joystick.plan(np.linspace(0.0, 1.0, 10_001), varied=VARIED)
    with pytest.raises(ParameterError, match=r"table = 149 GiB of samples: must be smaller, or reduced"):
        plan.run_batch(np.full((200_000, 2), 2e-3))
