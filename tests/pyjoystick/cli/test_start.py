"""Starting the program: quickly, and without a traceback where it is stopped at once."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
#: What takes long to load, and what a command therefore loads only when it is run.
HEAVY = ("fmpy", "lmfit", "matplotlib", "numba", "pandas", "scipy")
#: Loads the program as `python -m pyjoystick` does, and says which heavy modules are there at the end.
WATCHED = f"""
import runpy, sys
try:
    runpy.run_module("pyjoystick", run_name="__main__", alter_sys=True)
finally:
    print(*sorted(set({HEAVY!r}) & set(sys.modules)), file=sys.stderr)
"""
#: The same, with Ctrl-C at the moment at which a module is looked for.
STOPPED = """
import runpy, sys

class Stop:
    def find_spec(self, name, path, target=None):
        if name == MODULE:
            raise KeyboardInterrupt

MODULE = sys.argv.pop(1)
sys.meta_path.insert(0, Stop())
runpy.run_module("pyjoystick", run_name="__main__", alter_sys=True)
"""


def _python(program: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", program, *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )


COMMANDS = ("info", "parameters", "peaks", "fit", "free-oscillation", "sweep", "compare")
IMPORTS = ("markers", "accelerometer", "load-curve", "swing", "parts")


@pytest.mark.parametrize(
    "arguments",
    [
        ("--help",),
        ("--version",),
        *((name, "--help") for name in COMMANDS),
        *(("import", name, "--help") for name in IMPORTS),
    ],
    ids=" ".join,
)
def test_help_waits_for_nothing_heavy(arguments: tuple[str, ...]) -> None:
    done = _python(WATCHED, *arguments)
    assert (done.returncode, done.stderr.strip()) == (0, "")
    assert done.stdout


def test_what_is_loaded_is_seen(tmp_path: Path) -> None:
    """The check above can fail: a command that reads an FMU loads pandas."""
    done = _python(WATCHED, "info", str(tmp_path / "nowhere.fmu"))
    assert done.returncode == 1
    assert "pandas" in done.stderr


@pytest.mark.parametrize(
    "module", ["numpy", "typer", "pyjoystick.cli", "pyjoystick.parameters", "pyjoystick.fmu.pool", "pandas"]
)
def test_ctrl_c_while_it_loads_is_no_traceback(module: str, tmp_path: Path) -> None:
    done = _python(STOPPED, module, "info", str(tmp_path / "nowhere.fmu"))
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")
