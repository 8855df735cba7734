"""The program as a whole: help, version, exit codes, faults."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from pyjoystick.support import version_of
from tests.pyjoystick.cli.conftest import Command

ROOT = Path(__file__).parents[3]


def test_help_names_the_commands_in_the_order_of_work(command: Command) -> None:
    outcome = command("--help")
    assert outcome.code == 0
    listed = [line.split()[1] for line in outcome.out.splitlines() if line.startswith("│ ")]
    wanted = ["info", "parameters", "import", "peaks", "fit", "free-oscillation", "sweep", "compare"]
    assert [name for name in listed if name in wanted] == wanted


@pytest.mark.parametrize(
    ("name", "example"),
    [
        ("free-oscillation", "pyjoystick free-oscillation --csv run.csv --plot run.png"),
        ("compare", "pyjoystick compare --damping power-law"),
        ("info", "pyjoystick info Joystick"),
    ],
)
def test_help_of_a_command_has_examples(command: Command, name: str, example: str) -> None:
    outcome = command(name, "--help")
    assert outcome.code == 0
    assert example in outcome.out


def test_version(command: Command) -> None:
    assert command("--version").out == f"pyjoystick {version_of('pyjoystick')}\n"


@pytest.mark.parametrize(
    "arguments", [("swing",), ("info",), ("compare", "--nonsense"), ("free-oscillation", "-d", "long")]
)
def test_wrong_usage_is_exit_code_2(command: Command, arguments: tuple[str, ...]) -> None:
    outcome = command(*arguments)
    assert (outcome.code, outcome.out) == (2, "")
    assert "Usage: pyjoystick" in outcome.err


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
@pytest.mark.parametrize("arguments", [("parameters",), ("parameters", "--json", "-")])
def test_a_full_disk_behind_standard_output_is_no_fault(arguments: tuple[str, ...]) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        call = [sys.executable, "-m", "pyjoystick", *arguments]
        ended = subprocess.run(call, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert ended.returncode == 1
    message = "error: cannot write standard output or a temporary file: No space left on device"
    assert ended.stderr.splitlines()[-1] == message


@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
@pytest.mark.parametrize(
    ("arguments", "redirection", "reason"),
    [
        (("parameters", "--json", "-"), ">&-", "standard output: it is closed"),
        (("parameters",), ">&-", "standard output: it is closed"),
        (("--version",), ">&-", "standard output: it is closed"),
        (("info", "--help"), ">&-", "standard output: it is closed"),
        (("parameters",), "1</dev/null", ".*: Bad file descriptor"),
    ],
)
def test_a_standard_output_that_takes_nothing_is_no_success(
    arguments: tuple[str, ...], redirection: str, reason: str
) -> None:
    call = shlex.join([sys.executable, "-m", "pyjoystick", *arguments])
    ended = subprocess.run(
        ["sh", "-c", f"{call} {redirection}"], stderr=subprocess.PIPE, text=True, check=False
    )
    assert ended.returncode == 1
    assert re.fullmatch(f"error: cannot write {reason}", ended.stderr.splitlines()[-1])


@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
def test_no_file_takes_the_place_of_a_closed_standard_output(tmp_path: Path) -> None:
    """What a library prints would end up in it."""
    program = (
        "import sys; from pyjoystick.cli import main; main(['--version']); "
        f"sys.exit(open({str(tmp_path / 'file')!r}, 'w').fileno() == 1)"
    )
    call = shlex.join([sys.executable, "-c", program])
    assert subprocess.run(["sh", "-c", f"{call} >&-"], check=False).returncode == 0


def test_a_fault_of_the_program_is_one_message(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(path: Path) -> None:
        raise ZeroDivisionError("[red]")

    monkeypatch.setattr("pyjoystick.fmu.read_description", breaks)
    outcome = command("info", "Joystick")
    assert (outcome.code, outcome.out) == (1, "")
    expected = "internal error: ZeroDivisionError: [red] (pyjoystick --debug COMMAND shows where)"
    assert outcome.message == expected


def test_debug_shows_where(
    command: Command, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from pyjoystick.cli import main

    def breaks(path: Path) -> None:
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr("pyjoystick.fmu.read_description", breaks)
    assert main(["--debug", "info", "Joystick"]) == 1
    assert "Traceback" in capsys.readouterr().err
    assert "Traceback" not in command("info", "Joystick").err  # the next call begins anew


def test_an_interrupt_ends_the_program_quietly(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("pyjoystick.runs.compare_with_reference", interrupted)
    outcome = command("compare", "-d", "0.1")
    assert (outcome.code, outcome.out) == (130, "")


IN_A_CALLBACK = """
import signal, sys, time, weakref
import pyjoystick.cli
from pyjoystick.__main__ import main

class Thing:
    pass

def run():
    thing = Thing()
    guard = weakref.ref(thing, lambda _: signal.raise_signal(signal.{name}))
    del thing
    time.sleep(60.0)
    return 0

pyjoystick.cli.main = run
sys.exit(main())
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGTERM to be caught")
@pytest.mark.parametrize(("name", "code"), [("SIGINT", 130), ("SIGTERM", 143)])
def test_an_interrupt_in_a_callback_is_not_lost(name: str, code: int) -> None:
    """Python discards what a weak reference's callback raises."""
    done = subprocess.run(
        [sys.executable, "-c", IN_A_CALLBACK.replace("{name}", name)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    assert (done.returncode, done.stdout, done.stderr) == (code, "", "")


def test_python_m_pyjoystick_works() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "pyjoystick", "--help"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "Usage: pyjoystick" in done.stdout


def test_the_exit_code_reaches_the_shell(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "pyjoystick", "info", str(tmp_path / "nowhere.fmu")],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("error: there is no FMU ")
    assert done.stderr.count("\n") == 1


def test_a_current_folder_that_has_gone_is_named(tmp_path: Path) -> None:
    gone = (
        "import os, sys; from pyjoystick.cli import main; os.rmdir(os.getcwd()); "
        "sys.exit(main(['free-oscillation']))"
    )
    done = subprocess.run(
        [sys.executable, "-c", gone], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stderr == "error: the current folder cannot be used: No such file or directory\n"


@pytest.mark.parametrize(
    "arguments",
    [
        ("compare", "{}.fmu"),
        ("new", "{}"),
        ("import", "record", "{}.csv", "-o", "{}.csv"),
        ("export", "-o", "{}"),
    ],
)
def test_a_name_that_no_file_can_have(arguments: tuple[str, ...], command: Command) -> None:
    message = command(*(one.format("x" * 300) for one in arguments)).message
    assert message.startswith("cannot use the path xxx")
    assert message.endswith(": File name too long")
