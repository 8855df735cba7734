"""Connect to an omc server through OMPython."""

from __future__ import annotations

import io
import logging
import subprocess
import time
import uuid
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from OMPython import OMCSessionABC, OMCSessionDocker, OMCSessionPort, OMSessionException

from fmu_build.compilers.openmodelica.messages import Answer, read_answers, watched
from fmu_build.support.errors import ToolchainError

_SECONDS_TO_CONNECT = 10.0
_SECONDS_TO_START = 120.0
_MILLISECONDS = 200


class _PatientSocket:
    """The part of a socket that OMPython uses, with a check while waiting.

    OMPython waits for an answer forever, even if the server has died; this class calls `check`, which may
    raise, five times a second. Because it is not a `zmq.Socket`, OMPython does not ask the server to quit
    when the session is garbage-collected, so a server that was already running keeps running.
    """

    def __init__(self, socket: Any, check: Callable[[], None]) -> None:
        self._socket = socket
        self._check = check

    def send_string(self, text: str, flags: int = 0) -> None:
        self._check()
        self._socket.send_string(text, flags=flags)

    def recv_string(self) -> str:
        while not self._socket.poll(_MILLISECONDS):
            self._check()
        return bytes(self._socket.recv()).decode(errors="replace")

    def close(self) -> None:
        self._socket.close()


class Connection:
    """A session of OMPython with a time limit for each answer."""

    def __init__(self, session: OMCSessionABC, timeout: float, check: Callable[[], None]) -> None:
        self._session = session
        self._timeout = timeout
        self._check_server = check
        self._deadline = 0.0
        self._socket = _PatientSocket(session._omc_zmq, self._check)
        session._omc_zmq = self._socket  # type: ignore[assignment]

    def run(self, statements: Sequence[str]) -> list[Answer]:
        """Return the answers; if there are fewer than statements, the last one contains the reason.

        Raises `ToolchainError` if there is no server, it has ended or it does not answer in time.
        """
        answers: list[Answer] = []
        for statement in statements:
            marker = uuid.uuid4().hex
            self._deadline = time.monotonic() + self._timeout
            try:
                # This fetches the messages with the value; OMPython then fetches messages itself and finds
                # none.
                output = self._session.sendExpression(watched(statement, marker), parsed=False)
            except OMSessionException as error:
                output = str(error)
                if output.startswith("No connection"):
                    raise ToolchainError(f"no omc server answers at {self._session.get_port()}") from error
            answers += read_answers(output, marker, 1)
        return answers

    def quit(self) -> None:
        """Ask the server to quit."""
        self._deadline = time.monotonic() + self._timeout
        self._session.sendExpression("quit()")

    def close(self) -> None:
        """Close the connection, leave the server running, and remove OMPython's log file."""
        self._socket.close()
        self._session._omc_zmq = None
        if self._session._omc_loghandle is not None:
            self._session._omc_loghandle.close()
        self._session._omc_logfile.unlink(missing_ok=True)

    def _check(self) -> None:
        self._check_server()
        if time.monotonic() > self._deadline:
            raise ToolchainError(f"omc did not answer within {self._timeout:g} s (option timeout)")


@contextmanager
def connected(address: str, timeout: float, check: Callable[[], None] = lambda: None) -> Iterator[Connection]:
    """Connect to the server at a ZeroMQ address; `check` raises if that server has ended."""
    connection = Connection(OMCSessionPort(address, timeout=_SECONDS_TO_CONNECT), timeout, check)
    try:
        yield connection
    finally:
        connection.close()


@contextmanager
def container(image: str, arguments: Sequence[str], timeout: float) -> Iterator[Connection]:
    """Connect to a server in a new container of a Docker image; kill the container on exit.

    `arguments` are added to ``docker run``. Raises `ToolchainError` if the server does not start.
    """
    try:
        session = OMCSessionDocker(docker=image, dockerExtraArgs=list(arguments), timeout=_SECONDS_TO_START)
    except (OMSessionException, OSError, subprocess.SubprocessError) as error:
        raise ToolchainError(f"no omc server in a container of {image}: {error}") from error
    connection = Connection(session, timeout, lambda: None)
    try:
        yield connection
    finally:
        identifier = session.get_docker_container_id()
        connection.close()
        subprocess.run(["docker", "kill", identifier], capture_output=True, check=False)


@contextmanager
def log_of_ompython() -> Iterator[Callable[[], str]]:
    """Redirect OMPython's log away from standard error; yield a function that returns it."""
    sink = io.StringIO()
    handler = logging.StreamHandler(sink)
    handler.setFormatter(logging.Formatter("OMPython: %(levelname)s: %(message)s"))
    logger = logging.getLogger("OMPython")
    propagate, level = logger.propagate, logger.level
    logger.addHandler(handler)
    logger.propagate = False
    logger.setLevel(logging.WARNING)
    try:
        yield sink.getvalue
    finally:
        logger.removeHandler(handler)
        logger.propagate, logger.level = propagate, level
