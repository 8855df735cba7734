"""Limits on the unpacked size and the contents of archives, against ZIP bombs and mistakes."""

from __future__ import annotations

import os
import zipfile
from pathlib import Path
from typing import Final

from pyjoystick.fmu.errors import FmuFileError
from pyjoystick.support import ParameterError

#: Environment variable with a factor for all limits.
LIMITS_VARIABLE: Final = "PYJOYSTICK_FMU_LIMITS"
MOST_FILES: Final = 20_000
LARGEST_UNPACKED: Final = 2**30
LARGEST_DESCRIPTION: Final = 2**26
MOST_VARIABLES: Final = 100_000


def require_modest(path: Path, archive: zipfile.ZipFile) -> None:
    """Raise FmuFileError for an archive with too many files or too much data."""
    files = archive.infolist()
    require_at_most(path, "contains {} files", len(files), MOST_FILES)
    size = sum(file.file_size for file in files)
    require_at_most(path, "would take {} bytes unpacked", size, LARGEST_UNPACKED)
    size = sum(file.file_size for file in files if file.filename == "modelDescription.xml")
    require_at_most(path, "has a modelDescription.xml of {} bytes", size, LARGEST_DESCRIPTION)


def require_at_most(path: Path, what: str, number: int, limit: int) -> None:
    """Raise FmuFileError if the number is above the limit.

    Args:
        path: the FMU
        what: text with a placeholder for the number
        number: the number
        limit: the limit, before the factor from the environment
    """
    most = int(allowed(limit))
    if number > most:
        advice = f"{LIMITS_VARIABLE}=10 in the environment allows ten times as much"
        raise FmuFileError(path, f"{what.format(number)}: at most {most} are allowed ({advice})")


def allowed(limit: float) -> float:
    """The limit times the factor from the environment; raises ParameterError if that is not a number."""
    return limit * _factor()


def _factor() -> float:
    text = os.environ.get(LIMITS_VARIABLE, "1")
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not 0.0 < factor < 1e9:
        raise ParameterError(LIMITS_VARIABLE, text, "a number above 0")
    return factor
