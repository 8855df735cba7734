"""A real OpenModelica for the tests that need one, where it is installed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fmu_build.compilers.openmodelica.finding import find_omc
from fmu_build.compilers.openmodelica.messages import Answer, errors, quoted
from fmu_build.compilers.openmodelica.options import Options
from fmu_build.compilers.openmodelica.sessions import Session, open_session
from fmu_build.support.errors import ToolchainError
from pyjoystick.fmu import MODELS

#: Those with an interface by contract; in the others OpenModelica writes units of derivatives otherwise.
JOYSTICKS = {name: model for name, model in MODELS.items() if ".Joystick." in model}


def why_not() -> str:
    """Why there is no OpenModelica to test with; empty where there is one."""
    try:
        find_omc(None)
    except ToolchainError as error:
        return str(error).partition(". ")[0]
    return ""


class Omc:
    """An open session that works in a folder, with its library path."""

    def __init__(self, session: Session, folder: Path) -> None:
        self.session = session
        self.folder = folder

    def ask(self, *statements: str) -> list[Answer]:
        """The answers; fails where one of them is missing."""
        answers = self.session.run([f"cd({quoted(str(self.folder))})", *statements])[1:]
        assert len(answers) == len(statements), [str(m) for answer in answers for m in answer.messages]
        return answers

    def load(self, *files: Path) -> list[str]:
        """The statements that load files."""
        return [f"loadFile({quoted(str(file))})" for file in files]


@contextmanager
def opened(folder: Path) -> Iterator[Omc]:
    """A session in a folder."""
    with open_session(Options(timeout=600.0), folder) as session:
        yield Omc(session.session, folder)


def error_texts(answers: list[Answer]) -> list[str]:
    """All errors, with their places."""
    return [str(error) for answer in answers for error in errors(answer.messages)]
