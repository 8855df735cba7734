"""The platforms that binaries are built for: FMI 2 folder name, zig target, file extension."""

from __future__ import annotations

import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_build.errors import BuildError


@dataclass(frozen=True, slots=True)
class Platform:
    """`name` is the folder in binaries/, `target` what `zig cc -target` takes."""

    name: str
    target: str
    extension: str


# glibc 2.17 is the oldest that current distributions' wheels (manylinux2014) reckon with.
PLATFORMS = {
    p.name: p
    for p in (
        Platform("linux64", "x86_64-linux-gnu.2.17", ".so"),
        Platform("win64", "x86_64-windows-gnu", ".dll"),
        Platform("darwin64", "x86_64-macos", ".dylib"),
    )
}
_HOSTS = {
    ("linux", "x86_64"): "linux64",
    ("win32", "amd64"): "win64",
    ("darwin", "x86_64"): "darwin64",
}


def host_platform() -> Platform | None:
    """The platform that this Python runs on, or None where FMI 2 has no name for it."""
    name = _HOSTS.get((sys.platform, platform.machine().lower()))
    return None if name is None else PLATFORMS[name]


def select_platforms(names: Sequence[str]) -> tuple[Platform, ...]:
    """The named platforms, each once and in the order of the table; the host's where none is named.

    Raises `BuildError` for a name that is not in the table.
    """
    unknown = [name for name in names if name not in PLATFORMS]
    if unknown:
        raise BuildError(f"unknown platform {unknown[0]!r}; known platforms are {', '.join(PLATFORMS)}")
    if names:
        return tuple(p for p in PLATFORMS.values() if p.name in names)
    host = host_platform()
    if host is None:
        raise BuildError(
            f"FMI 2 has no platform name for this machine ({sys.platform}, {platform.machine()}); "
            f"name the platforms to build for: {', '.join(PLATFORMS)}"
        )
    return (host,)
