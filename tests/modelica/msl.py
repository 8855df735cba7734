"""Locate the Modelica Standard Library, which is not part of this repository."""

from __future__ import annotations

import os
from pathlib import Path


def why_not() -> str:
    """Why models that use it cannot be built here; empty where they can."""
    folders = [Path(part) for part in os.environ.get("MODELICAPATH", "").split(os.pathsep) if part]
    if any((path / "package.mo").is_file() for folder in folders for path in folder.glob("Modelica*")):
        return ""
    return "the Modelica Standard Library was not found: MODELICAPATH names no folder that contains Modelica"
