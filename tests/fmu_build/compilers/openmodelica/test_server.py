"""Starting and contacting a server: everything that can fail before compilation."""

from __future__ import annotations

import logging
import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import zmq

from fmu_build.compilers.openmodelica.connection import connected, log_of_ompython
from fmu_build.compilers.openmodelica.options import Options
from fmu_build.compilers.openmodelica.server import RootRefusedError, local_server, read_port_file
from fmu_build.compilers.openmodelica.sessions import open_session
from fmu_build.support.errors import ToolchainError
from tests.fmu_build.compilers.openmodelica import recorded


def _program(path: Path, script: str) -> Path:
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return path


def test_root_is_refused(tmp_path: Path) -> None:
    omc = _program(tmp_path / "omc", f"cat <<'END'\n{recorded.ROOT_REFUSAL}END\nexit 1")
    with (
        pytest.raises(RootRefusedError, match="omc refuses to serve the root user"),
        local_server(omc, tmp_path, os.environ),
    ):
        pass


def test_a_server_that_does_not_start_is_not_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fmu_build.compilers.openmodelica.server._SECONDS_TO_START", 1e9)
    omc = _program(tmp_path / "omc", "echo no licence; exit 7")
    with (
        pytest.raises(ToolchainError, match=r"(?s)did not start a server \(exit code 7\).*no licence"),
        local_server(omc, tmp_path, os.environ),
    ):
        pass


def test_port_file(tmp_path: Path) -> None:
    file = tmp_path / "openmodelica.user.port.x"
    file.write_text("tcp://127.0.0.1:38171")
    assert read_port_file(file) == "tcp://127.0.0.1:38171"
    file.write_text("root:x:0:0\n")
    with pytest.raises(ToolchainError, match="not the port file of an omc server"):
        read_port_file(file)
    file.write_text("")
    with pytest.raises(ToolchainError, match="not the port file of an omc server"):
        read_port_file(file)
    with pytest.raises(ToolchainError, match=r"port-file=.*missing: cannot read it: .*No such file"):
        read_port_file(tmp_path / "missing")


class _Peer:
    """A ZeroMQ socket that gives fixed replies, or none; it keeps what it was asked."""

    def __init__(self, replies: list[str]) -> None:
        self.replies = replies
        self.asked: list[str] = []
        self.socket = zmq.Context.instance().socket(zmq.REP)
        self.address = f"tcp://127.0.0.1:{self.socket.bind_to_random_port('tcp://127.0.0.1')}"
        self.over = threading.Event()

    def serve(self) -> None:
        while not self.over.is_set():
            if self.socket.poll(20):
                self.asked.append(self.socket.recv_string())
                marker = self.asked[-1].split('"')[1] if '"' in self.asked[-1] else ""
                if self.replies:
                    self.socket.send_string(self.replies.pop(0).replace("MARK", marker))
        self.socket.close(linger=0)


@contextmanager
def _peer(*replies: str) -> Iterator[_Peer]:
    peer = _Peer(list(replies))
    thread = threading.Thread(target=peer.serve)
    thread.start()
    try:
        yield peer
    finally:
        peer.over.set()
        thread.join()


NO_MESSAGES = "{}\n"


def test_answers_through_ompython() -> None:
    replies = ('true\n"MARK"\n""\n"MARK"\n', NO_MESSAGES, recorded.NOT_PARSED)
    with _peer(*replies) as peer, connected(peer.address, 10.0) as connection:
        loaded, broken = connection.run(["loadFile(1)", "1+"])
    assert loaded.succeeded
    assert "Parser error" in broken.messages[-1].text
    assert peer.asked[0].startswith('loadFile(1); "')
    assert peer.asked[1] == "getMessagesStringInternal()"


def test_a_server_of_another_is_not_asked_to_quit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with _peer('"v"\n"MARK"\n""\n"MARK"\n', NO_MESSAGES) as peer:
        with connected(peer.address, 10.0) as connection:
            connection.run(["getVersion()"])
            made = list(tmp_path.iterdir())
        del connection
        time.sleep(0.2)
    assert [question for question in peer.asked if "quit" in question] == []
    assert [file.suffix for file in made] == [".log"]
    assert list(tmp_path.iterdir()) == []


def test_an_answer_that_does_not_come() -> None:
    with (
        _peer() as peer,
        pytest.raises(ToolchainError, match=r"omc did not answer within 0\.5 s \(option timeout\)"),
        connected(peer.address, 0.5) as connection,
    ):
        connection.run(["getVersion()"])


def test_a_server_that_dies_before_it_answers() -> None:
    def check() -> None:
        if peer.asked:
            raise ToolchainError("omc ended suddenly")

    with (
        _peer() as peer,
        pytest.raises(ToolchainError, match="omc ended suddenly"),
        connected(peer.address, 1000.0, check) as connection,
    ):
        connection.run(["getVersion()"])


def test_a_port_that_nobody_serves(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fmu_build.compilers.openmodelica.connection._SECONDS_TO_CONNECT", 0.3)
    file = tmp_path / "port"
    file.write_text("tcp://127.0.0.1:1")
    with (
        pytest.raises(ToolchainError, match=r"no omc server answers at tcp://127\.0\.0\.1:1"),
        open_session(Options(port_file=file), tmp_path) as opened,
    ):
        opened.session.run(["getVersion()"])


def test_no_ompython(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "OMPython", None)
    file = tmp_path / "port"
    file.write_text("tcp://127.0.0.1:1")
    with (
        pytest.raises(ToolchainError, match=r"pip install 'pyjoystick\[openmodelica\]'"),
        open_session(Options(port_file=file), tmp_path),
    ):
        pass


def test_what_ompython_logs_is_kept(capfd: pytest.CaptureFixture[str]) -> None:
    logger = logging.getLogger("OMPython.om_session_omc")
    with log_of_ompython() as log:
        logger.warning("killing %s", 7)
        logger.info("nothing of interest")
    assert log() == "OMPython: WARNING: killing 7\n"
    assert capfd.readouterr().err == ""
    assert logging.getLogger("OMPython").propagate
