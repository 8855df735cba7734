"""Ctrl-C, for real: a process of its own is sent SIGINT while it runs.

Starting the process takes longer than anything that it does, so that one for each loop does everything.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from pyjoystick.fmu.stepping.engine import PLAIN_LOOP_VARIABLE

# Without xdist's grouping each of its workers would have processes of its own.
pytestmark = pytest.mark.xdist_group("interruption")

_SCRIPT = """
import json, sys, threading
import numpy as np
from pyjoystick.fmu import Fmu

def progress(done, runs):
    print("going", flush=True)

def batch(trouble, in_a_thread):
    table = [(20.0, 0.0)] * 10000
    table[4] = (0.0, trouble)
    found = []
    finished = threading.Event()
    def work():
        found.append(plan.run_batch(table, threads=2, on_progress=progress))
        finished.set()
    if in_a_thread:
        threading.Thread(target=work).start()
        try:
            finished.wait()
        except KeyboardInterrupt:
            plan.stop()
            finished.wait()
    else:
        work()
    batch = found[0]
    return {
        "interrupted": batch.interrupted,
        "done": int(batch.done.sum()),
        "last": sorted(set(batch.values[batch.done & ~batch.failed, -1, 0])),
        "left": bool(np.isnan(batch.values[~batch.done]).all()),
    }

def single():
    long = fmu.plan([0.1 * i for i in range(1000)], varied="delay", inputs={"u": 1.0}, outputs="y")
    sound = [long.run([0.0]) for _ in range(20)][0]
    print("going", flush=True)
    try:
        long.run([20.0])
    except KeyboardInterrupt:
        return {"stopped": True, "sound": bool((long.run([0.0]) == sound).all())}
    return {"stopped": False}

with Fmu(sys.argv[1], own_process=False) as fmu:
    plan = fmu.plan([0.0, 0.25, 0.5], varied=("delay", "trouble"), inputs={"u": 1.0}, outputs="y")
    plan.run([0.0, 0])  # compiles, where it is to
    for line in sys.stdin:
        name, *arguments = json.loads(line)
        print(json.dumps({"batch": batch, "single": single}[name](*arguments)), flush=True)
"""


class Interrupted:
    """The process that carries out jobs, each of which is interrupted."""

    def __init__(self, fmu: Path, loop: str) -> None:
        environment = os.environ | ({PLAIN_LOOP_VARIABLE: "1"} if loop == "plain" else {})
        self._process = subprocess.Popen(
            [sys.executable, "-c", _SCRIPT, str(fmu)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=environment,
        )

    def __call__(self, *job: object) -> tuple[dict[str, Any], float]:
        """Interrupts a job half a second after it begins; what came of it and how long that took (s)."""
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(json.dumps(job) + "\n")
        process.stdin.flush()
        assert process.stdout.readline() == "going\n", self.close()
        time.sleep(0.5)
        start = time.perf_counter()
        process.send_signal(signal.SIGINT)
        line = next((line for line in process.stdout if line != "going\n"), None)
        took = time.perf_counter() - start
        assert line is not None, self.close()
        result: dict[str, Any] = json.loads(line)
        return result, took

    def close(self) -> tuple[int, str]:
        """End the process; its return code and what it said of errors."""
        try:
            _, errors = self._process.communicate(timeout=60.0)
        finally:
            self.kill()
        return self._process.returncode, errors

    def kill(self) -> None:
        """End the process, whatever it is at."""
        self._process.kill()
        self._process.wait()


@pytest.fixture(scope="module", params=["compiled", "plain"])
def interrupted(request: pytest.FixtureRequest, awkward_path: Path) -> Iterator[Interrupted]:
    """With the one loop and the other."""
    process = Interrupted(awkward_path, request.param)
    try:
        yield process
        assert process.close() == (0, ""), (
            "with steps under way that never end it comes to its end all the same"
        )
    finally:
        process.kill()


@pytest.mark.parametrize("in_a_thread", [False, True], ids=["main thread", "another thread"])
@pytest.mark.parametrize("trouble", [0, 5], ids=["short steps", "a step without end"])
def test_a_batch_returns_what_is_done(trouble: int, in_a_thread: bool, interrupted: Interrupted) -> None:
    result, took = interrupted("batch", trouble, in_a_thread)
    assert result["interrupted"]
    assert 0 < result["done"] < 10_000
    assert result["last"] == [0.5]
    assert result["left"]
    # The whole batch would take more than three minutes.
    assert took < 30.0


def test_a_single_run_can_be_interrupted(interrupted: Interrupted) -> None:
    """It would take twenty seconds, and those before took none; the instance is sound afterwards."""
    result, took = interrupted("single")
    assert result == {"stopped": True, "sound": True}
    assert took < 10.0
