from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest
from filelock import FileLock, Timeout

from fmu_build.packaging import scripts

_SLEEPS = """
import sys, time
from filelock import FileLock
with FileLock(sys.argv[1]):
    print("sleeps", file=open(sys.argv[2], "w"), flush=True)
    time.sleep(float(sys.argv[3]))
print("awake", *sys.argv[1:])
"""
_BUILD = """
import sys
from fmu_build.packaging import scripts
scripts.__file__, *arguments = sys.argv[1:]
scripts.run_script("sleeps.py", *arguments, seconds=600.0)
"""


@pytest.fixture
def script(tmp_path: Path) -> Path:
    path = tmp_path / "sleeps.py"
    path.write_text(_SLEEPS)
    return path


def test_a_script_gets_its_arguments(script: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scripts, "__file__", str(script))
    arguments = (str(script.with_name("lock")), str(script.with_name("started")), "0")
    done = scripts.run_script(script.name, *arguments, seconds=600.0)
    assert (done.returncode, done.stdout.split(), done.stderr) == (0, ["awake", *arguments], "")
    with pytest.raises(subprocess.TimeoutExpired):
        scripts.run_script(script.name, *arguments[:2], "600", seconds=0.5)


def test_a_script_ends_with_a_build_that_is_killed(script: Path) -> None:
    lock, started = script.with_name("lock"), script.with_name("started")
    command = [sys.executable, "-c", _BUILD, str(script), str(lock), str(started), "600"]
    with subprocess.Popen(command) as build:
        while not started.exists():
            assert build.poll() is None
            time.sleep(0.02)
        with pytest.raises(Timeout):
            FileLock(lock, timeout=0.0).acquire()
        build.kill()
    with FileLock(lock, timeout=60.0):  # as soon as the script has ended
        pass
