"""Instances are put away when all are back, and left alone in a forked process."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.support import PyJoystickError

_FORK = """
import os, sys
from pyjoystick.fmu import Fmu
fmu = Fmu(sys.argv[1])
before = fmu.run([0.0, 0.1], parameters={"theta_start": 0.1})
child = os.fork()
same = fmu.run([0.0, 0.1], parameters={"theta_start": 0.1}).equals(before)
if child == 0:
    fmu.close()
    os._exit(0 if same else 1)
_, status = os.waitpid(child, 0)
print(status, same, fmu._pool.library.folder.is_dir())
fmu.close()
print(fmu._pool.library.folder.is_dir())
"""


def test_an_instance_at_work_keeps_the_library(joystick_path: Path, unpacking_folder: Path) -> None:
    fmu = Fmu(joystick_path)
    first, second = fmu._pool.take(), fmu._pool.take()
    fmu.close()
    with pytest.raises(PyJoystickError, match="has been closed"):
        fmu.run([0.0, 1.0])
    fmu._pool.give_back(first)
    assert len(list(unpacking_folder.iterdir())) == 1
    fmu._pool.give_back(second)
    assert list(unpacking_folder.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="no fork")
def test_a_forked_process_runs_on_and_deletes_nothing(joystick_path: Path) -> None:
    command = [sys.executable, "-c", _FORK, str(joystick_path)]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    assert lines == ["0 True True", "False"]
