"""Scripts that load the library of an FMU in a separate process, because a faulty one can crash it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

# Ends the script when its standard input ends, which the build keeps open until it ends itself.
_WATCHED = """
import os, runpy, sys, threading

def watch():
    os.read(0, 1)
    os._exit(1)

threading.Thread(target=watch, daemon=True).start()
del sys.argv[0]
runpy.run_path(sys.argv[0], run_name="__main__")
"""


def run_script(name: str, *arguments: str, seconds: float) -> subprocess.CompletedProcess[str]:
    """Run a script of this folder and return its output; the script never outlives this process.

    It is killed after this many seconds, and `subprocess.TimeoutExpired` is raised.
    """
    script = Path(__file__).with_name(name)
    held, ours = os.pipe()
    try:
        return subprocess.run(
            # -P excludes the working folder, and the modules in it, from the search path.
            [sys.executable, "-P", "-c", _WATCHED, str(script), *arguments],
            stdin=held,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=seconds,
            check=False,
        )
    finally:
        os.close(held)
        os.close(ours)
