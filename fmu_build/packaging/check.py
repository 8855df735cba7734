"""The final checks of a new FMU before it replaces the old one."""

from __future__ import annotations

import signal
import subprocess
import zipfile
from collections.abc import Sequence
from pathlib import Path

from fmpy.model_description import ValidationError, read_model_description

from fmu_build.packaging.scripts import run_script
from fmu_build.support.errors import BuildError
from fmu_build.support.request import FmiType
from fmu_build.support.temporary import temporary_folder

_SECONDS_TO_LOAD = 300  # so that a library that hangs cannot hang the build


def check_fmu(path: Path, *, fmi_types: Sequence[FmiType], load: bool) -> str:
    """Read the archive back, validate it and, with `load`, instantiate it on this machine.

    The library is loaded in a separate process, because a faulty one can crash it. Returns the output of the
    checks; raises `BuildError` if one fails.
    """
    check_archive(path)
    try:
        # The names were checked with the description (`consistency`).
        read_model_description(str(path), validate_variable_names=False, validate_model_structure=True)
    except ValidationError as error:
        problems = "\n".join(f"- {problem}" for problem in error.problems)
        raise BuildError(f"internal error: the FMU is not valid:\n{problems}") from error
    if not load:
        return "The FMU has no binary for this machine; it was validated but not loaded.\n"
    return check_loads(path, fmi_types)


def check_archive(path: Path) -> None:
    """Read every file of the archive; raises `BuildError` if one is damaged."""
    with zipfile.ZipFile(path) as archive:
        damaged = archive.testzip()
    if damaged is not None:
        raise BuildError(f"the archive was damaged while it was written: {damaged} has a wrong checksum")


def check_loads(path: Path, fmi_types: Sequence[FmiType]) -> str:
    """Instantiate the FMU on this machine as each of the types; return the output.

    Raises `BuildError` if that fails.
    """
    with temporary_folder() as folder:
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        try:
            done = run_script("load_fmu.py", str(folder), *fmi_types, seconds=_SECONDS_TO_LOAD)
        except subprocess.TimeoutExpired as error:
            raise BuildError(f"the FMU did not load within {_SECONDS_TO_LOAD} s") from error
    output = done.stdout + done.stderr
    if done.returncode != 0:
        raise BuildError(
            f"the FMU does not load on this machine: {_reason(done.returncode)}\n{output}".rstrip()
        )
    return output


def _reason(code: int) -> str:
    if code >= 0:
        return f"exit code {code}"
    try:
        return f"its process was killed by {signal.Signals(-code).name}"
    except ValueError:
        return f"its process was killed by signal {-code}"
