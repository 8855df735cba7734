"""Processes that end with their parent."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from fmu_build.compilers.openmodelica.process import read_log, run, running
from fmu_build.support.errors import ToolchainError

ENVIRONMENT = {"PATH": os.environ["PATH"]}
# Two processes: the one that is started, and one that it starts itself; it prints the id of the latter.
FAMILY = ["sh", "-c", "sleep 1000 & echo $!; wait"]


def _has_ended(pid: int) -> bool:
    """Within ten seconds; a process that nobody has waited for yet counts as ended."""
    for _ in range(200):
        try:
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(") ")[2][0]
        except (FileNotFoundError, ProcessLookupError):
            return True
        if state == "Z":
            return True
        time.sleep(0.05)
    return False


def _child(log: Path) -> int:
    while not read_log(log).strip():
        time.sleep(0.02)
    return int(read_log(log))


def test_code_and_output(tmp_path: Path) -> None:
    command = ["sh", "-c", "pwd; echo wrong >&2; exit 3"]
    log = tmp_path / "log"
    code, output = run(command, folder=tmp_path, log=log, environment=ENVIRONMENT, timeout=60.0)
    assert (code, output) == (3, f"{tmp_path}\nwrong\n")


def test_a_program_that_is_not_there(tmp_path: Path) -> None:
    missing = str(tmp_path / "missing")
    with pytest.raises(ToolchainError, match=f"cannot run {missing}: No such file"):
        run([missing], folder=tmp_path, log=tmp_path / "log", environment=ENVIRONMENT, timeout=1.0)


def test_out_of_time(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with pytest.raises(ToolchainError, match=r"sh did not end within 0\.5 s \(option timeout\)\n\d+"):
        run(FAMILY, folder=tmp_path, log=log, environment=ENVIRONMENT, timeout=0.5)
    assert _has_ended(_child(log))


@pytest.mark.parametrize("reason", [KeyboardInterrupt, ToolchainError, None])
def test_it_ends_with_the_context(tmp_path: Path, reason: type[BaseException] | None) -> None:
    log = tmp_path / "log"

    def use() -> None:
        with running(FAMILY, folder=tmp_path, log=log, environment=ENVIRONMENT) as process:
            pids.extend([process.pid, _child(log)])
            if reason is not None:
                raise reason

    pids: list[int] = []
    if reason is None:
        use()
    else:
        with pytest.raises(reason):
            use()
    assert all(_has_ended(pid) for pid in pids)


def test_it_ends_with_a_killed_parent(tmp_path: Path) -> None:
    """No handler runs then."""
    log = tmp_path / "log"
    program = (
        "import sys, time; from pathlib import Path\n"
        "from fmu_build.compilers.openmodelica.process import running\n"
        "folder = Path(sys.argv[1])\n"
        f"with running({FAMILY!r}, folder=folder, log=folder / 'log', environment={{'PATH': sys.argv[2]}}):\n"
        "    time.sleep(1000)\n"
    )
    with subprocess.Popen([sys.executable, "-c", program, str(tmp_path), os.environ["PATH"]]) as parent:
        child = _child(log)
        assert not Path(f"/proc/{child}/stat").read_text().rpartition(") ")[2].startswith("Z")
        parent.send_signal(signal.SIGKILL)
    assert _has_ended(child)
