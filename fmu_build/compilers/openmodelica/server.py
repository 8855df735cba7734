"""Start an omc server, or read the port file of a running one."""

from __future__ import annotations

import time
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from subprocess import Popen

from fmu_build.compilers.openmodelica.process import read_log, running
from fmu_build.support.errors import ToolchainError

_SECONDS_TO_START = 60.0
_REFUSAL = "as a server using the root user"


class RootRefusedError(ToolchainError):
    """omc refuses to serve the root user."""


@dataclass(frozen=True, slots=True)
class Server:
    """A server started by this process: its ZeroMQ address, process and log."""

    address: str
    process: Popen[bytes]
    log: Path

    def check(self) -> None:
        """Raise `ToolchainError` if the server has ended."""
        code = self.process.poll()
        if code is not None:
            raise ToolchainError(f"omc ended suddenly (exit code {code})\n{read_log(self.log)}".rstrip())


@contextmanager
def local_server(omc: Path, folder: Path, environment: Mapping[str, str]) -> Iterator[Server]:
    """Start omc as a server, and end it when the context exits.

    OMPython can also start a server, but it waits for its full timeout if omc refuses to serve, and loses
    track of the process if the wait is interrupted.

    Raises `RootRefusedError` or another `ToolchainError` with omc's output.
    """
    suffix = uuid.uuid4().hex
    log = folder / "omc.log"
    command = [str(omc), "--locale=C", "--interactive=zmq", f"-z={suffix}"]
    # omc writes its port file to the temporary folder.
    environment = {**environment, "TMPDIR": str(folder)}
    with running(command, folder=folder, log=log, environment=environment) as process:
        yield Server(_address(process, folder, suffix, log), process, log)


def read_port_file(file: Path) -> str:
    """Return the ZeroMQ address in the port file of a server; raises `ToolchainError` if there is none."""
    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ToolchainError(f"port-file={file}: cannot read it: {error}") from error
    if not lines or not lines[0].startswith("tcp://"):
        raise ToolchainError(
            f"port-file={file}: not the port file of an omc server; such a file has an address like "
            "tcp://127.0.0.1:38495, and omc --interactive=zmq prints where it is"
        )
    return lines[0].strip()


def _address(process: Popen[bytes], folder: Path, suffix: str, log: Path) -> str:
    deadline = time.monotonic() + _SECONDS_TO_START
    while time.monotonic() < deadline:
        for file in folder.glob(f"openmodelica*port.{suffix}"):
            address = file.read_text(encoding="utf-8").strip()
            if address:
                return address
        if process.poll() is not None:
            break
        time.sleep(0.02)
    output = read_log(log)
    if _REFUSAL in output:
        raise RootRefusedError("omc refuses to serve the root user")
    raise ToolchainError(f"omc did not start a server (exit code {process.poll()})\n{output}".rstrip())
