"""Use a shared server and leave it as it was."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from fmu_build.compilers.openmodelica.messages import quoted
from fmu_build.compilers.openmodelica.sessions import Session
from fmu_build.support.errors import ToolchainError

_FLAGS = re.compile(r"--fmiFlags=[^\s\"]*")


@contextmanager
def left_as_found(session: Session, folder: Path, classes: Mapping[str, Path]) -> Iterator[None]:
    """On exit, restore what a build changes in a server: its classes, its working folder and its solver flag.

    `classes` are the top-level classes to be loaded, with their files. Raises `ToolchainError` if the server
    has loaded one of them from another file, which loading would replace, or if it cannot enter `folder` and
    would build elsewhere.
    """
    previous, names, flags = (answer.value for answer in session.run(_STATE))
    before = _names(names)
    for name in before & classes.keys():
        source = session.run([f"getSourceFile({name})"])[0].text
        if Path(source).resolve() != classes[name].resolve():
            raise ToolchainError(
                f"the server already has a class {name}, from {source or 'no file'}; the build would "
                f"replace it by that of {classes[name]}. Delete the class there, or use another server"
            )
    entered = session.run([f"cd({quoted(str(folder))})"])[0].text
    if Path(entered) != folder:
        raise ToolchainError(
            f"the server cannot work in {folder}: {entered.strip()}. It must run on this machine, as the "
            "same user (root may use anyone's)"
        )
    try:
        yield
    finally:
        added = _names(session.run(_STATE)[1].value) - before
        solver = _FLAGS.search(flags)
        session.run(
            [
                *(f"deleteClass({name})" for name in sorted(added)),
                f"setCommandLineOptions({quoted(solver.group() if solver else '--fmiFlags=none')})",
                f"cd({previous})",
            ]
        )


_STATE = ("cd()", "getClassNames()", "getCommandLineOptions()")


def _names(array: str) -> set[str]:
    return {name.strip() for name in array.strip().strip("{}").split(",") if name.strip()}
