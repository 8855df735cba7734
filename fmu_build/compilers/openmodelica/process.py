"""Processes that end with the one that started them, together with all that they started themselves."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from fmu_build.support.errors import ToolchainError

# Reads until this process closes the pipe, be it because it was killed, then kills its own group.
_GUARD = "read -r _; kill -s KILL 0"


@contextmanager
def running(
    command: Sequence[str], *, folder: Path, log: Path, environment: Mapping[str, str]
) -> Iterator[subprocess.Popen[bytes]]:
    """Runs a program in a folder; its output goes to `log`. It has ended when the context is left.

    Raises `ToolchainError` where it cannot be started.
    """
    with log.open("wb") as sink, _guard() as group:
        try:
            process = subprocess.Popen(
                command,
                cwd=folder,
                env=dict(environment),
                stdin=subprocess.DEVNULL,
                stdout=sink,
                stderr=subprocess.STDOUT,
                process_group=group,
            )
        except OSError as error:
            raise ToolchainError(f"cannot run {command[0]}: {error.strerror or error}") from error
        try:
            yield process
        finally:
            _end(process, group)


def run(
    command: Sequence[str], *, folder: Path, log: Path, environment: Mapping[str, str], timeout: float
) -> tuple[int, str]:
    """Exit code and output of a program; raises `ToolchainError` where it takes longer than `timeout` (s)."""
    with running(command, folder=folder, log=log, environment=environment) as process:
        try:
            code = process.wait(timeout)
        except subprocess.TimeoutExpired as error:
            raise ToolchainError(
                f"{command[0]} did not end within {timeout:g} s (option timeout)\n{read_log(log)}".rstrip()
            ) from error
    return code, read_log(log)


def read_log(log: Path) -> str:
    """What a program has printed so far."""
    return log.read_bytes().decode(errors="replace") if log.exists() else ""


@contextmanager
def _guard() -> Iterator[int | None]:
    """A process group, None on Windows, that ends with this process even where that runs no handler.

    The guard is there before anything that it guards, so that there is no moment without it.
    """
    if os.name != "posix":
        yield None
        return
    with subprocess.Popen(
        ["sh", "-c", _GUARD],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        process_group=0,
    ) as guard:
        try:
            yield guard.pid
        finally:
            guard.kill()


def _end(process: subprocess.Popen[bytes], group: int | None) -> None:
    if group is not None:
        # Of a compilation that is cut short, make and the C compiler are left in the group.
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(group, signal.SIGKILL)
    elif process.poll() is None:
        process.kill()
    process.wait()
