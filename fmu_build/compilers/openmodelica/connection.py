"""The connection to an omc server, through OMPython."""

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
    """What OMPython uses of its socket.

    OMPython waits for an answer for ever, also for one of a server that has died meanwhile; this calls
    `check`, which may raise, every fifth of a second. Since it is no `zmq.Socket`, OMPython does not ask the
    server to quit when the session is collected: a server that was there before stays.
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
    """A session of OMPython in which no answer is waited for without end."""

    def __init__(self, session: OMCSessionABC, timeout: float, check: Callable[[], None]) -> None:
        self._session = session
        self._timeout = timeout
        self._check_server = check
        self._deadline = 0.0
        self._socket = _PatientSocket(session._omc_zmq, self._check)
        session._omc_zmq = self._socket  # type: ignore[assignment]

    def run(self, statements: Sequence[str]) -> list[Answer]:
        """The answers; the last one has the reason where there are fewer of them than statements.

        Raises `ToolchainError` where there is no server, or it has ended or does not answer in time.
        """
        answers: list[Answer] = []
        for statement in statements:
            marker = uuid.uuid4().hex
            self._deadline = time.monotonic() + self._timeout
            try:
                # The messages are fetched with the value: OMPython, which fetches them next, finds none.
                output = self._session.sendExpression(watched(statement, marker), parsed=False)
            except OMSessionException as error:
                output = str(error)
                if output.startswith("No connection"):
                    raise ToolchainError(f"no omc server answers at {self._session.get_port()}") from error
            answers += read_answers(output, marker, 1)
        return answers

    def quit(self) -> None:
        """Asks the server to end."""
        self._deadline = time.monotonic() + self._timeout
        self._session.sendExpression("quit()")

    def close(self) -> None:
        """Ends the connection; the server stays. What OMPython leaves behind is removed."""
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
    """A connection to the server at a ZeroMQ address; `check` raises where that server has ended."""
    connection = Connection(OMCSessionPort(address, timeout=_SECONDS_TO_CONNECT), timeout, check)
    try:
        yield connection
    finally:
        connection.close()


@contextmanager
def container(image: str, arguments: Sequence[str], timeout: float) -> Iterator[Connection]:
    """A connection to a server in a container of a Docker image, which has ended when this is left.

    `arguments` are added to ``docker run``. Raises `ToolchainError` where it does not start.
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
    """Keeps what OMPython logs off the standard error; yields a function that reads it."""
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
