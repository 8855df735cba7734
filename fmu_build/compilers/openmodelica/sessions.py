"""Sessions with omc, of the kind that the options request and the user's rights permit."""

from __future__ import annotations

import os
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from fmu_build.compilers.openmodelica.docker import check_image, mounts, run_in_container
from fmu_build.compilers.openmodelica.finding import find_omc
from fmu_build.compilers.openmodelica.messages import Answer, read_answers, watched
from fmu_build.compilers.openmodelica.options import Options
from fmu_build.compilers.openmodelica.process import run
from fmu_build.compilers.openmodelica.server import RootRefusedError, local_server, read_port_file
from fmu_build.support.errors import ToolchainError

ROOT_NOTE = (
    "omc refuses to serve the root user: it runs a script instead, with the same FMU as a result (for a "
    "session, build as another user)"
)


class Session(Protocol):
    """Runs statements of OpenModelica's scripting language."""

    def run(self, statements: Sequence[str]) -> list[Answer]:
        """Return the answers; if there are fewer than statements, the last one contains the reason."""
        ...


@dataclass(frozen=True, slots=True)
class Opened:
    """A session, and the omc at its other end."""

    session: Session
    what: str
    shared: bool = False
    """Whether the server was already running and must be left as it was."""
    log: Callable[[], str] = field(default=lambda: "")
    """Returns the remarks logged so far."""


@contextmanager
def open_session(
    options: Options,
    folder: Path,
    libraries: Sequence[Path] = (),
    tell: Callable[[str], None] = lambda stage: None,
) -> Iterator[Opened]:
    """Open a session that can write to `folder` and read `libraries`; end the processes that it starts.

    Raises `ToolchainError`. If omc refuses the root user, the session runs scripts instead and reports this
    through `tell`.
    """
    if options.docker is not None:
        opened = _in_docker(options.docker, options, folder, libraries, tell)
    elif options.port_file is not None:
        opened = _running_already(options.port_file, options, folder)
    else:
        opened = _local(find_omc(options.omc), options, folder, tell)
    with opened as session:
        yield session


@contextmanager
def _local(omc: Path, options: Options, folder: Path, tell: Callable[[str], None]) -> Iterator[Opened]:
    environment = dict(os.environ)
    if options.omc is not None:
        environment.pop("OPENMODELICAHOME", None)  # it may belong to another installation
    with ExitStack() as stack:
        try:
            server = stack.enter_context(local_server(omc, folder, environment))
        except RootRefusedError:
            tell(ROOT_NOTE)
            script = ScriptSession([str(omc)], folder, environment, options.timeout)
            yield Opened(script, f"{omc} in its script form", log=lambda: ROOT_NOTE)
            return
        _require_ompython()
        from fmu_build.compilers.openmodelica.connection import connected, log_of_ompython

        log = stack.enter_context(log_of_ompython())
        connection = stack.enter_context(connected(server.address, options.timeout, server.check))
        yield Opened(connection, f"{omc} as a server", log=log)
        connection.quit()


@contextmanager
def _running_already(port_file: Path, options: Options, folder: Path) -> Iterator[Opened]:
    address = read_port_file(port_file)
    if os.name == "posix" and os.geteuid() == 0:
        # The server runs as another user, because omc refuses root, and needs write access to this folder.
        os.chown(folder, port_file.stat().st_uid, -1)
    _require_ompython()
    from fmu_build.compilers.openmodelica.connection import connected, log_of_ompython

    with log_of_ompython() as log, connected(address, options.timeout) as connection:
        yield Opened(connection, f"the omc server at {address}", shared=True, log=log)


@contextmanager
def _in_docker(
    image: str, options: Options, folder: Path, libraries: Sequence[Path], tell: Callable[[str], None]
) -> Iterator[Opened]:
    check_image(image)
    if os.name == "posix" and os.geteuid() == 0:
        # OMPython would run the container as the current user: root, which omc refuses.
        tell(ROOT_NOTE)
        command = run_in_container(image, folder, libraries)
        script = ScriptSession(command, folder, os.environ, options.timeout)
        yield Opened(script, f"omc of the Docker image {image} in its script form", log=lambda: ROOT_NOTE)
        return
    _require_ompython()
    from fmu_build.compilers.openmodelica.connection import container, log_of_ompython

    with log_of_ompython() as log, container(image, mounts(folder, libraries), options.timeout) as connection:
        yield Opened(connection, f"omc of the Docker image {image} as a server", log=log)


def _require_ompython() -> None:
    try:
        from OMPython import OMCSessionPort  # noqa: F401
    except ImportError as error:
        raise ToolchainError(
            f"OMPython 4.1 or newer, which talks to OpenModelica, is missing ({error}): "
            "pip install 'pyjoystick[openmodelica]'. The default compiler, rumoca, does not need it."
        ) from error


@dataclass(frozen=True, slots=True)
class ScriptSession:
    """Runs each list of statements in a new omc process; no state is kept between lists.

    `command` runs omc; scripts are written to and run in `folder`.
    """

    command: Sequence[str]
    folder: Path
    environment: Mapping[str, str]
    timeout: float

    def run(self, statements: Sequence[str]) -> list[Answer]:
        """Return the answers; if there are fewer than statements, the last one contains the reason.

        Raises `ToolchainError` if omc cannot be run or does not end in time.
        """
        marker = uuid.uuid4().hex
        script = self.folder / f"{marker}.mos"
        script.write_text("".join(f"{watched(s, marker)};\n" for s in statements), encoding="utf-8")
        code, output = run(
            [*self.command, "--locale=C", str(script)],
            folder=self.folder,
            log=self.folder / f"{marker}.log",
            environment=self.environment,
            timeout=self.timeout * len(statements),
        )
        if code != 0:
            output = f"{output.rstrip()}\nError: omc ended with exit code {code}"
        return read_answers(output, marker, len(statements))
