"""Other tools run in processes of their own: what they load stays loaded, and a crash is one test's."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import pytest


def require(module: str) -> None:
    """Skip, with the reason, where a Python module cannot be imported."""
    command = [sys.executable, "-c", f"import {module}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f"{module} cannot be imported: {done.stderr.strip().splitlines()[-1]}")


def run(program: str, **settings: Any) -> Any:
    """What a Python program prints last, as JSON; its `settings` are global variables.

    Anything it writes before, and everything that a tool writes, is passed over unless it fails.
    """
    source = f"import json\nglobals().update(json.loads({json.dumps(json.dumps(settings))}))\n{program}"
    done = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout.splitlines()[-1])
