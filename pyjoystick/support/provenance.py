"""Which versions a result was made with."""

from __future__ import annotations

import platform
from importlib import metadata

_PACKAGES = ("pyjoystick", "fmpy", "numpy", "scipy", "pandas")


def version_of(package: str) -> str:
    """The version of an installed package, or ``not installed``, as when run from a bare checkout."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def versions() -> dict[str, str]:
    """Versions by name of what a result depends on."""
    return {"Python": platform.python_version()} | {package: version_of(package) for package in _PACKAGES}
