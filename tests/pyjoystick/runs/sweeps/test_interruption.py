"""Processes stopped during a sweep: by Ctrl-C, by SIGTERM, or killed without warning."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

from pyjoystick.runs import Sweep, read_settings, read_sweep, run_sweep
from tests.pyjoystick.runs.sweeps.conftest import LONG, Write

_PATIENCE = 120.0  # s, for a machine with much else to do


def _started(settings: Path, target: Path) -> subprocess.Popen[str]:
    """A process that carries out the sweep."""
    command = [sys.executable, "-m", "pyjoystick", "sweep", str(settings), "--output", str(target)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def _wait_for_parts(process: subprocess.Popen[str], target: Path, count: int) -> None:
    folder = Path(f"{target}.parts")
    end = time.monotonic() + _PATIENCE
    while len(list(folder.glob("from-*.npz"))) < count:
        assert process.poll() is None, "the sweep came to its end before it was stopped"
        assert time.monotonic() < end, "the sweep did not begin"
        time.sleep(0.01)


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_stopped_sweep_goes_on_from_there(
    written: Write,
    tmp_path: Path,
    stop: signal.Signals,
    long_table: pd.DataFrame,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    settings = written(LONG)
    target = tmp_path / "a.parquet"
    place = tmp_path / "temporary"
    place.mkdir()
    monkeypatch.setenv("TMPDIR", str(place))
    process = _started(settings, target)
    try:
        _wait_for_parts(process, target, 3)
        process.send_signal(stop)
        out, err = process.communicate(timeout=_PATIENCE)
    finally:
        process.kill()
    if stop != signal.SIGKILL:
        assert process.returncode == 128 + stop
        assert list(place.iterdir()) == []
        assert "of 4096 runs of Joystick.fmu done" in out
        assert "the same command continues from here" in err
    else:
        assert process.returncode == -signal.SIGKILL
        assert len(list(place.iterdir())) == 1
        subprocess.run([sys.executable, "-m", "pyjoystick", "info", settings.parent / "no.fmu"], check=False)
        assert list(place.iterdir()) == [], "the next command deletes what was left"
    assert not target.exists()
    outcome = run_sweep(Sweep(read_settings(settings)), target)
    assert 0 < outcome.found < 4096
    assert (outcome.done, outcome.failed) == (4096, 0)
    pd.testing.assert_frame_equal(read_sweep(target), long_table, check_exact=True)
