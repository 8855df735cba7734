"""Processes that are terminated, with all their descendants, when their parent ends."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from fmu_build.support.errors import ToolchainError

# Waits until this process closes the pipe, even by being killed, then kills its own group.
_GUARD = "read -r _; kill -s KILL 0"


@contextmanager
def running(
    command: Sequence[str], *, folder: Path, log: Path, environment: Mapping[str, str]
) -> Iterator[subprocess.Popen[bytes]]:
    """Run a program in a folder, with its output in `log`; end it when the context exits.

    Raises `ToolchainError` if it cannot be started.
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
    """Return exit code and output of a program; raises `ToolchainError` after `timeout` (s)."""
    with running(command, folder=folder, log=log, environment=environment) as process:
        try:
            code = process.wait(timeout)
        except subprocess.TimeoutExpired as error:
            raise ToolchainError(
                f"{command[0]} did not end within {timeout:g} s (option timeout)\n{read_log(log)}".rstrip()
            ) from error
    return code, read_log(log)


def read_log(log: Path) -> str:
    """Return what a program has printed so far."""
    return log.read_bytes().decode(errors="replace") if log.exists() else ""


@contextmanager
def _guard() -> Iterator[int | None]:
    """Yield a process group (None on Windows) that ends with this process even if no handler runs.

    The guard process starts first, so that its group is guarded at all times.
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
        # An interrupted compilation leaves make and the C compiler in the group.
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(group, signal.SIGKILL)
    elif process.poll() is None:
        process.kill()
    process.wait()
