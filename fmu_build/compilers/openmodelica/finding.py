"""Find OpenModelica's compiler, omc, on this machine."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from fmu_build.support.errors import ToolchainError

_NAME = "omc.exe" if sys.platform == "win32" else "omc"
_SECONDS_FOR_VERSION = 60
HOW_TO_GO_ON = (
    "Install OpenModelica (openmodelica.org/download), or name an installation with the option omc=PATH, a "
    "running server with port-file=FILE or a Docker image with docker=IMAGE. The default compiler, rumoca, "
    "needs none of this: it comes with pip install 'pyjoystick[build]'."
)


def find_omc(explicit: Path | None, environment: Mapping[str, str] = os.environ) -> Path:
    """Return the executable: `explicit` if given, else the one in OPENMODELICAHOME, else the first on PATH.

    `explicit` is the executable itself or an installation that contains ``bin/omc``. Raises `ToolchainError`,
    which lists the places searched and the alternatives.
    """
    if explicit is not None:
        found = _executable(explicit) or _executable(explicit / "bin" / _NAME)
        if found is None:
            raise ToolchainError(f"omc={explicit}: neither omc nor a folder with bin/{_NAME}. {HOW_TO_GO_ON}")
        return found
    home = environment.get("OPENMODELICAHOME")
    found = _executable(Path(home) / "bin" / _NAME) if home else None
    on_path = shutil.which(_NAME, path=environment.get("PATH", os.defpath))
    if found is None and on_path is not None:
        found = Path(on_path).absolute()
    if found is None:
        place = f"has no bin/{_NAME} ({home})" if home else "is not set"
        raise ToolchainError(
            f"OpenModelica's compiler was not found: OPENMODELICAHOME {place}, and there is no {_NAME} on "
            f"PATH. {HOW_TO_GO_ON}"
        )
    return found


def omc_version(executable: Path) -> str:
    """Return the version of omc, such as ``1.14.2``; raises `ToolchainError` if omc does not run."""
    try:
        done = subprocess.run(
            [str(executable), "--version"],
            capture_output=True,
            text=True,
            errors="replace",
            timeout=_SECONDS_FOR_VERSION,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ToolchainError(f"{executable} does not run: {error}") from error
    output = (done.stdout + done.stderr).strip()
    if done.returncode != 0 or not output:
        raise ToolchainError(
            f"{executable} --version failed with exit code {done.returncode}: {output or 'no output'}"
        )
    return plain_version(output.splitlines()[-1])


def plain_version(text: str) -> str:
    """Return the number in a version text such as ``OMCompiler v1.14.2`` or ``OpenModelica 1.26.3``."""
    number = re.search(r"\d+\.\d\S*", text)
    return number.group() if number is not None else text.strip()


def _executable(path: Path) -> Path | None:
    return path.absolute() if path.is_file() and os.access(path, os.X_OK) else None
