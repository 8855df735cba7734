"""Foreign FMUs: a separate process that survives whatever they do, and a new instance per run."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import (
    Final,
    Fmu,
    FmuCrashError,
    FmuEndedError,
    FmuFileError,
    FmuRunError,
    FmuTimeLimitError,
    read_description,
    run_model_exchange,
    stepped,
)
from pyjoystick.fmu.own_process.pool import ProcessPool
from pyjoystick.fmu.own_process.process import OwnProcess
from pyjoystick.support import ParameterError, PyJoystickError
from tests.pyjoystick.fmu import awkward
from tests.pyjoystick.fmu.awkward import Trouble
from tests.pyjoystick.fmu.doctored import doctored

TIME = [0.0, 0.1, 0.2, 0.3]
#: How a run of each ends that ends badly.
CRASHES = {
    Trouble.EXITS: r"t = 0.1 s: .*its process ended with exit code 0",
    Trouble.ABORTS: r"t = 0.1 s: .*its process was ended by SIGABRT",
    Trouble.CRASHES: r"t = 0.1 s: .*its process was ended by SIGSEGV",
    Trouble.ABORTS_AFTERWARDS: r"t = 0.3 s: .*its process was ended by SIGABRT",
}

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the awkward FMU needs POSIX")


@pytest.fixture(scope="module", params=[2, 3])
def foreign(request: pytest.FixtureRequest, awkward_path: Path, awkward3_path: Path) -> Iterator[Fmu]:
    """An FMU that nobody says to have made."""
    with Fmu(awkward_path if request.param == 2 else awkward3_path, time_limit=1.0) as fmu:
        yield fmu


def run(fmu: Fmu, trouble: Trouble, when: float = 0.1, gain: float = 1.0) -> list[float]:
    parameters = {"trouble": int(trouble), "when": when, "gain": gain}
    table = fmu.run(TIME, parameters=parameters, inputs={"u": 1.0}, outputs="y")
    return [float(y) for y in table["y"]]


def test_which_fmus_have_a_process(joystick_path: Path, awkward_path: Path) -> None:
    """Those of this project run in the caller's unless the caller wants otherwise, with the same numbers."""
    settings = {"parameters": {"theta_start": 0.1}}
    with Fmu(joystick_path) as here, Fmu(joystick_path, own_process=True) as apart:
        assert not isinstance(here._pool, ProcessPool)
        assert isinstance(apart._pool, ProcessPool)
        pd.testing.assert_frame_equal(
            apart.run([0.0, 0.1, 0.2], **settings), here.run([0.0, 0.1, 0.2], **settings), check_exact=True
        )
        for a, b in zip(vars(apart.linearize(0.1)).values(), vars(here.linearize(0.1)).values(), strict=True):
            np.testing.assert_array_equal(a, b)
        again = pickle.loads(pickle.dumps(apart))
        assert isinstance(again._pool, ProcessPool)
        again.close()
    with Fmu(awkward_path, own_process=False) as here:
        assert not isinstance(here._pool, ProcessPool)


def test_what_runs_in_such_a_process_loads_no_tables(awkward_path: Path) -> None:
    """It starts with every process, and pandas takes longer to load than all the rest."""
    script = (
        "import sys\n"
        "from pyjoystick.fmu import Fmu\n"
        "from pyjoystick.fmu.own_process import child\n"
        "with Fmu(sys.argv[1], own_process=False) as fmu:\n"
        "    fmu.plan([0.0, 0.1], varied=['gain'], inputs={'u': 1.0}).run([2.0])\n"
        "    fmu.start(inputs={'u': 1.0}).step(0.1)\n"
        "    print('pandas' in sys.modules)\n"
        "    fmu.run([0.0, 0.1])\n"
        "print('pandas' in sys.modules)"
    )
    command = [sys.executable, "-c", script, str(awkward_path)]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "False\nTrue\n"


@pytest.mark.parametrize("trouble", CRASHES)
def test_a_crash_is_an_error_and_the_next_run_goes_on(foreign: Fmu, trouble: Trouble) -> None:
    with pytest.raises(FmuCrashError, match=CRASHES[trouble]):
        run(foreign, trouble)
    assert run(foreign, Trouble.NONE) == pytest.approx(TIME)


def test_a_run_without_end_is_ended(foreign: Fmu) -> None:
    begin = time.monotonic()
    with pytest.raises(FmuTimeLimitError, match=r"t = 0.1 s: .*longer than the time limit of 1 s"):
        run(foreign, Trouble.FOREVER)
    assert time.monotonic() - begin < 20.0


def test_what_it_prints_is_kept_apart(foreign: Fmu, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(foreign, Trouble.PRINTS, when=0.25) == pytest.approx(TIME)
    assert capfd.readouterr() == ("", "")


def test_a_crash_is_not_blamed_on_what_earlier_runs_printed(foreign: Fmu) -> None:
    run(foreign, Trouble.PRINTS)
    with pytest.raises(FmuCrashError, match=CRASHES[Trouble.ABORTS]) as caught:
        run(foreign, Trouble.ABORTS)
    assert "printed" not in str(caught.value)


def test_an_fmu_may_close_the_standard_streams(foreign: Fmu) -> None:
    for trouble in (Trouble.CLOSES_STREAMS, Trouble.NONE, Trouble.CLOSES_STREAMS, Trouble.NONE):
        assert run(foreign, trouble) == pytest.approx(TIME)
    with pytest.raises(FmuCrashError, match=CRASHES[Trouble.ABORTS]):
        run(foreign, Trouble.ABORTS)


@pytest.mark.parametrize("own_process", [False, True], ids=["here", "apart"])
@pytest.mark.parametrize("version", [2, 3])
def test_every_run_is_that_of_a_new_instance(
    version: int, own_process: bool, awkward_path: Path, awkward3_path: Path
) -> None:
    """The reset of this one keeps the state."""
    path = awkward_path if version == 2 else awkward3_path
    with Fmu(path, own_process=own_process) as fmu:
        for _ in range(2):
            assert run(fmu, Trouble.KEEPS_STATE) == pytest.approx(TIME)
        plan = fmu.plan(TIME, varied="gain", parameters={"trouble": 16}, inputs={"u": 1.0}, outputs="y")
        batches = [plan.run_batch([[1.0]] * 9, threads=threads).values for threads in (1, 2)]
        for values in batches:
            assert values is not None
            np.testing.assert_allclose(values[:, :, 0], np.tile(TIME, (9, 1)), rtol=1e-14)
        np.testing.assert_array_equal(*batches)


def test_a_failed_or_ended_instance_is_not_used_again(
    awkward_library: Path, tmp_path: Path, loop: str
) -> None:
    """Not even of an FMU that is trusted to reset."""
    path = awkward.build(2, tmp_path / "ours.fmu", awkward_library, tool="pyjoystick 1.0")
    with Fmu(path) as fmu:
        run(fmu, Trouble.NONE)
        (kept,) = fmu._pool._idle
        run(fmu, Trouble.NONE)
        assert fmu._pool._idle == [kept]
        for trouble in (Trouble.ERROR, Trouble.DISCARD, Trouble.ENDS):
            with pytest.raises(FmuRunError):
                run(fmu, trouble)
            assert not fmu._pool._idle
        assert run(fmu, Trouble.NONE) == pytest.approx(TIME)


@pytest.mark.parametrize("own_process", [False, True], ids=["here", "apart"])
@pytest.mark.parametrize("version", [2, 3])
def test_the_samples_of_a_run_that_the_fmu_ends(
    version: int, own_process: bool, awkward_path: Path, awkward3_path: Path, loop: str
) -> None:
    path = awkward_path if version == 2 else awkward3_path
    with Fmu(path, own_process=own_process) as fmu:
        settings = {"trouble": int(Trouble.ENDS), "when": 0.1}
        message = "the FMU ended the simulation at t = 0.15 s"
        with pytest.raises(FmuEndedError, match=message) as caught:
            fmu.run(TIME, parameters=settings, inputs={"u": 1.0}, outputs=["y", "negated", "said"])
        table = caught.value.samples
        assert table.index.tolist() == pytest.approx([0.0, 0.1, 0.15])
        assert table["y"].tolist() == pytest.approx([0.0, 0.1, 0.15])
        assert table["negated"].dtype == np.bool_
        assert table["said"].tolist() == ["label"] * 3  # the other samples have no text that could be read
        plan = fmu.plan(TIME, varied="gain", parameters=settings, inputs={"u": 1.0}, outputs="y")
        with pytest.raises(FmuEndedError, match=message) as caught:
            plan.run([2.0])
        assert caught.value.samples[:, 0] == pytest.approx([0.0, 0.2, 0.3])
        batch = plan.run_batch([[2.0]])
        assert message in batch.messages[0]
        assert batch.failed.all()
        np.testing.assert_allclose(batch.values[0, :, 0], [0.0, 0.2, np.nan, np.nan])  # type: ignore[index]


def test_a_batch_survives_everything(foreign: Fmu) -> None:
    troubles = [trouble for trouble in Trouble if trouble != Trouble.WARNINGS]
    plan = foreign.plan(TIME, varied=("trouble", "gain"), inputs={"u": 1.0}, outputs="y")
    table = [(trouble, gain) for gain, trouble in enumerate(troubles)]
    table[:0] = [(Trouble.NONE, 2.0)] * 20
    batch = plan.run_batch(table, threads=2, reductions=[Final("y")])
    assert batch.done.all()
    assert batch.reduced is not None
    fails = {*CRASHES, Trouble.FOREVER, Trouble.ERROR, Trouble.DISCARD, Trouble.FATAL, Trouble.NO_STATUS}
    fails |= {Trouble.REFUSED_START, Trouble.ENDS}
    if foreign.description.fmi_version == "3.0":
        fails |= {Trouble.COMES_BACK_EARLY, Trouble.STOPS_SHORT}
    assert batch.failed.tolist() == [trouble in fails for trouble, _ in table]
    finals = batch.reduced["y.final"].to_numpy()
    expected = [np.nan if trouble in fails else 0.3 * gain for trouble, gain in table]
    np.testing.assert_allclose(finals, expected, rtol=1e-14)
    for (trouble, _), message in zip(table, batch.messages, strict=True):
        if trouble in CRASHES:
            assert CRASHES[trouble].rpartition("*")[2] in message
        assert bool(message) == (trouble in fails)


def test_an_interrupted_batch_returns_what_is_done(awkward_path: Path) -> None:
    """One of the runs never ends."""

    def interrupt(done: int, runs: int) -> None:
        if done >= runs - 5:
            raise KeyboardInterrupt

    table = [(Trouble.NONE, 1.0)] * 40
    table[7] = Trouble.FOREVER, 1.0
    with Fmu(awkward_path, time_limit=20.0) as fmu:
        plan = fmu.plan(TIME, varied=("trouble", "gain"), inputs={"u": 1.0}, outputs="y")
        batch = plan.run_batch(table, threads=2, on_progress=interrupt)
        assert batch.interrupted
        assert not batch.done[7]
        assert not batch.failed.any()
        assert batch.values is not None
        np.testing.assert_array_equal(np.isnan(batch.values).all(axis=(1, 2)), ~batch.done)
        assert run(fmu, Trouble.NONE) == pytest.approx(TIME)


def test_an_fmu_for_one_instance_a_process_has_one_each_time(awkward_library: Path, tmp_path: Path) -> None:
    attributes = 'canBeInstantiatedOnlyOncePerProcess="true"'
    path = awkward.build(2, tmp_path / "once.fmu", awkward_library, attributes=attributes)
    with Fmu(path) as fmu:
        first = fmu._pool._idle[0]
        assert run(fmu, Trouble.NONE) == pytest.approx(TIME)
        assert not first.is_alive  # type: ignore[union-attr]
        assert run(fmu, Trouble.NONE) == pytest.approx(TIME)


def test_an_fmu_that_ends_the_process_when_it_is_loaded(awkward_library: Path, tmp_path: Path) -> None:
    path = awkward.build(2, tmp_path / "exits.fmu", awkward_library, guid="exits")
    with pytest.raises(FmuFileError, match=r"exits\.fmu: cannot be loaded: .* ended with exit code 0"):
        Fmu(path)


def test_settings(awkward_path: Path) -> None:
    with pytest.raises(ParameterError, match="time_limit = 0"):
        Fmu(awkward_path, time_limit=0.0)
    fmu = Fmu(awkward_path)
    with pytest.raises(ParameterError, match="trouble = 20"):
        fmu.run(TIME, parameters={"trouble": 20})
    fmu.close()
    with pytest.raises(PyJoystickError, match="has been closed"):
        fmu.run(TIME)


def test_nothing_is_left(awkward_path: Path, unpacking_folder: Path) -> None:
    with Fmu(awkward_path) as fmu:
        process = fmu._pool._idle[0]._process  # type: ignore[union-attr]
        with pytest.raises(FmuCrashError):
            run(fmu, Trouble.ABORTS)
        run(fmu, Trouble.NONE)
    assert process.poll() is not None
    assert list(unpacking_folder.iterdir()) == []


_PARENT = """
import sys
from pyjoystick.fmu import Fmu
fmu = Fmu(sys.argv[1])
print(fmu._pool._idle[0]._process.pid, flush=True)
fmu.run([0.0, 0.1], parameters={"trouble": 5, "when": 0.0})
"""


@pytest.mark.parametrize("way", [signal.SIGINT, signal.SIGKILL], ids=["Ctrl-C", "killed"])
def test_the_process_does_not_outlive_its_parent(awkward_path: Path, way: signal.Signals) -> None:
    """It hangs in a step when the parent is interrupted or killed."""
    command = [sys.executable, "-c", _PARENT, str(awkward_path)]
    parent = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert parent.stdout is not None
    child = int(parent.stdout.readline())
    time.sleep(0.3)
    begin = time.monotonic()
    parent.send_signal(way)
    _, errors = parent.communicate(timeout=30.0)
    assert ("KeyboardInterrupt" in errors) == (way == signal.SIGINT)
    while _is_running(child):
        assert time.monotonic() - begin < 10.0
        time.sleep(0.05)


def _is_running(process: int) -> bool:
    try:
        os.kill(process, 0)
        state = Path(f"/proc/{process}/stat")
        return not state.exists() or state.read_text().rpartition(")")[2].split()[0] != "Z"
    except ProcessLookupError:
        return False


def test_model_exchange_too(mixed_path: Path) -> None:
    """The numbers are those of a run here."""
    settings = {"inputs": {"u": 1.0}, "outputs": ["y", "integral"]}
    here, apart = (
        run_model_exchange(mixed_path, np.linspace(0.0, 1.0, 5), own_process=own, **settings)
        for own in (False, True)
    )
    pd.testing.assert_frame_equal(apart, here, check_exact=True)
    with pytest.raises(FmuTimeLimitError, match=r"longer than the time limit of 0\.01 s"):
        run_model_exchange(mixed_path, [0.0, 1.0], own_process=True, time_limit=0.01)


def test_stepped_from_outside_it_is_the_same(joystick_path: Path, tmp_path: Path) -> None:
    """With saved states, whoever is said to have made it."""
    other = doctored(
        joystick_path, tmp_path / "other.fmu", description=lambda text: text.replace("pyjoystick", "other")
    )
    found = []
    for path in (joystick_path, other):
        description = read_description(path)
        theta, torque = (description.variables[name] for name in ("theta", "T"))
        with stepped(description) as one, one.reporting(0.0):
            one.initialize(0.0, 1e-8, {"theta_start": 0.1})
            state = one.save()
            one.set([torque], [0.2])
            one.set_input_derivatives([torque], [0.1])
            one.step(0.0, 0.1)
            found.append(one.get([theta]))
            one.restore(state)
            found.append(one.get([theta]))
            one.forget(state)
    assert found[:2] == found[2:]


def test_stepped_from_outside_it_may_crash(awkward_path: Path) -> None:
    with stepped(read_description(awkward_path)) as one:
        one.initialize(0.0, 1e-8, {"trouble": int(Trouble.ABORTS), "when": 0.1})
        one.step(0.0, 0.1)
        with pytest.raises(FmuCrashError, match=r"t = 0.1 s: .*SIGABRT"), one.reporting(0.1):
            one.step(0.1, 0.1)
        one.forget(0)


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_forked_process_keeps_and_ends_processes_of_its_own(awkward_path: Path) -> None:
    """It made one for each run, and none of them ended."""
    with Fmu(awkward_path) as fmu:
        run(fmu, Trouble.NONE)
        child = os.fork()
        if not child:
            code = 1
            try:
                for _ in range(3):
                    run(fmu, Trouble.NONE)
                (own,) = fmu._pool._idle
                fmu.close()
                code = 7 if isinstance(own, OwnProcess) and not own.is_alive else 2
            finally:
                os._exit(code)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
        run(fmu, Trouble.NONE)  # the parent's process is still there
