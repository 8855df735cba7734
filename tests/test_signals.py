"""Tests run even if Ctrl-C is ignored, as after ``nohup`` or in the background of a script."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

_ASK = "import signal; print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)"
_IGNORE = "import signal, subprocess, sys; signal.signal(signal.SIGINT, signal.SIG_IGN)\n"


def test_a_child_hears_ctrl_c() -> None:
    command = [sys.executable, "-c", _ASK]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "True\n"


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="no such signals")
def test_a_child_hears_ctrl_c_where_the_tests_do_not() -> None:
    test = f"{Path(__file__)}::{test_a_child_hears_ctrl_c.__name__}"
    program = f"{_IGNORE}sys.exit(subprocess.call([sys.executable, '-m', 'pytest', '-q', {test!r}]))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
