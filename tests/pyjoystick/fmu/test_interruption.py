"""Ctrl-C, for real: a process of its own is sent SIGINT while it runs."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

_BATCH = """
import json, sys, threading, time
import numpy as np
from pyjoystick.fmu import Fmu

def progress(done, runs):
    print("going", flush=True)

with Fmu(sys.argv[1]) as fmu:
    plan = fmu.plan([0.0, 0.25, 0.5], varied=("delay", "trouble"), inputs={"u": 1.0}, outputs="y")
    plan.run([0.0, 0])  # compiles, where it is to
    table = [(20.0, 0.0)] * 10000
    table[4] = (0.0, TROUBLE)
    batch = BODY
    print(json.dumps({
        "interrupted": batch.interrupted,
        "done": int(batch.done.sum()),
        "last": sorted(set(batch.values[batch.done & ~batch.failed, -1, 0])),
        "left": bool(np.isnan(batch.values[~batch.done]).all()),
    }), flush=True)
"""
_HERE = "plan.run_batch(table, threads=2, on_progress=progress)"
_IN_A_THREAD = """None
    finished = threading.Event()
    def work():
        global batch
        batch = plan.run_batch(table, threads=2, on_progress=progress)
        finished.set()
    threading.Thread(target=work).start()
    try:
        finished.wait()
    except KeyboardInterrupt:
        plan.stop()
        finished.wait()
"""
_SINGLE = """
import sys
from pyjoystick.fmu import Fmu

with Fmu(sys.argv[1]) as fmu:
    plan = fmu.plan([0.1 * i for i in range(1000)], varied="delay", inputs={"u": 1.0}, outputs="y")
    sound = plan.run([0.0])
    print("going", flush=True)
    try:
        plan.run([20.0])
    except KeyboardInterrupt:
        print("stopped", (plan.run([0.0]) == sound).all(), flush=True)
"""


def interrupted(script: str, fmu: Path) -> tuple[str, float]:
    """Interrupts a script half a second after it says it is going; its last line and how long it took."""
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(fmu)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "going\n", process.communicate()
    time.sleep(0.5)
    start = time.perf_counter()
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=60.0)
    took = time.perf_counter() - start
    assert process.returncode == 0, errors
    return out.splitlines()[-1], took


@pytest.mark.parametrize("body", [_HERE, _IN_A_THREAD], ids=["main thread", "another thread"])
@pytest.mark.parametrize("trouble", [0, 5], ids=["short steps", "a step without end"])
def test_a_batch_returns_what_is_done(body: str, trouble: int, awkward_path: Path, loop: str) -> None:
    script = _BATCH.replace("BODY", body).replace("TROUBLE", str(trouble))
    line, took = interrupted(script, awkward_path)
    result: dict[str, Any] = json.loads(line)
    assert result["interrupted"]
    assert 0 < result["done"] < 10_000
    assert result["last"] == [0.5]
    assert result["left"]
    # The whole batch would take more than three minutes.
    assert took < 30.0


def test_a_single_run_can_be_interrupted(awkward_path: Path, loop: str) -> None:
    """It would take twenty seconds; the instance is sound afterwards."""
    line, _ = interrupted(_SINGLE, awkward_path)
    assert line == "stopped True"
