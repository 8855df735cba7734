"""Program start: fast, and without a traceback on immediate interruption."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from pyjoystick import cli

ROOT = Path(__file__).parents[3]
#: What takes long to load, and what a command therefore loads only when it is run.
HEAVY = ("fmpy", "asteval", "matplotlib", "numba", "pandas", "scipy")
#: Asks for the help of the program and of all commands, and says what heavy modules each of them loads.
HELP = f"""
import contextlib, io, sys, typer.main
from pyjoystick.cli import app, main

def commands(group, *before):
    for name, one in group.commands.items():
        yield (*before, name)
        yield from commands(one, *before, name) if hasattr(one, "commands") else ()

known = list(commands(typer.main.get_command(app)))
for arguments in (["--help"], ["--version"], *([*one, "--help"] for one in known), sys.argv[1:]):
    with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.redirect_stderr(io.StringIO()):
        code = main(arguments)
    heavy = sorted(set({HEAVY!r}) & set(sys.modules))
    print(code, bool(printed.getvalue()), *arguments, "loads", *heavy)
"""
#: Runs the program as `python -m pyjoystick` does, with Ctrl-C at the moment at which a module is looked for.
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
        [sys.executable, "-c", program, *arguments],
        cwd=ROOT,
        env=os.environ | {"COLUMNS": "80"},
        capture_output=True,
        text=True,
        check=False,
    )


def test_help_waits_for_nothing_heavy(tmp_path: Path) -> None:
    """The last command reads an FMU, which does load FMPy: what is loaded is seen."""
    done = _python(HELP, "info", str(tmp_path / "nowhere.fmu"))
    assert done.returncode == 0, done.stderr
    *helps, last = done.stdout.splitlines()
    assert {"0 True fit --help loads", "0 True import markers --help loads"} <= set(helps)
    assert [line for line in helps if not (line.startswith("0 True ") and line.endswith(" loads"))] == []
    assert last.startswith("1 False info ")
    assert "fmpy" in last


def test_the_lists_of_commands_load_no_command() -> None:
    program = """
import sys
from pyjoystick.cli import main
main(["--help"]), main(["import", "--help"])
print(*(name for name in sys.modules if name == "numpy" or name.startswith("pyjoystick.cli.")))
"""
    done = _python(program)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "pyjoystick.cli.invocation pyjoystick.cli.console"


def test_every_command_has_one_line_in_its_list() -> None:
    done = _python("from pyjoystick.cli import main; main(['--help']), main(['import', '--help'])")
    listed = [line for line in done.stdout.splitlines() if re.match("│ [a-z]", line)]
    assert len(listed) == len(cli._COMMANDS) + len(cli._IMPORTS)
    assert all(re.fullmatch(r"│ [a-z-]+ +[A-Z].*\. +│", line) for line in listed), listed


@pytest.mark.parametrize(
    "module",
    [
        "numpy",
        "typer",
        "pyjoystick.cli",
        "pyjoystick.cli.fmus",
        "pyjoystick.fmu.description",
        "fmpy",
    ],
)
def test_ctrl_c_while_it_loads_is_no_traceback(module: str, tmp_path: Path) -> None:
    done = _python(STOPPED, module, "info", str(tmp_path / "nowhere.fmu"))
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


@pytest.mark.parametrize(
    ("words", "completed"),
    [
        (["fr"], ["free-oscillation"]),
        (["free-oscillation", "--pl"], ["--plot"]),
        (["import", "lo"], ["load-curve"]),
        (["explore", "--damping", ""], ["constant", "power-law"]),
    ],
)
def test_the_shell_completes_commands_options_and_choices(words: list[str], completed: list[str]) -> None:
    """As bash asks for it."""
    asked = {"COMP_WORDS": " ".join(["pyjoystick", *words]), "COMP_CWORD": str(len(words))}
    env = {**os.environ, **asked, "_PYJOYSTICK_COMPLETE": "complete_bash"}
    command = [sys.executable, "-m", "pyjoystick"]
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=True)
    assert done.stdout.split() == completed
