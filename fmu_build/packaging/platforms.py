"""The platforms that have binaries: folder names, zig target and file extension."""

from __future__ import annotations

import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_build.support.errors import BuildError
from fmu_build.support.request import FmiVersion

ALL = "all"


@dataclass(frozen=True, slots=True)
class Platform:
    """A platform: `name` is the platform tuple of FMI 3, `target` the argument of `zig cc -target`."""

    name: str
    target: str
    extension: str
    fmi2_name: str

    def folder(self, fmi_version: FmiVersion) -> str:
        """Return the name of the folder in binaries/."""
        return self.fmi2_name if fmi_version == "2.0" else self.name


# glibc 2.17 is the oldest that manylinux2014 wheels support, and the first for aarch64; macOS 11 is the first
# for aarch64. FMI 2 itself defines names for x86 only; since 2.0.5 it uses FMI 3's platform tuples for all
# others.
PLATFORMS = {
    p.name: p
    for p in (
        Platform("x86_64-linux", "x86_64-linux-gnu.2.17", ".so", "linux64"),
        Platform("aarch64-linux", "aarch64-linux-gnu.2.17", ".so", "aarch64-linux"),
        Platform("x86_64-windows", "x86_64-windows-gnu", ".dll", "win64"),
        Platform("x86_64-darwin", "x86_64-macos.11.0", ".dylib", "darwin64"),
        Platform("aarch64-darwin", "aarch64-macos.11.0", ".dylib", "aarch64-darwin"),
    )
}
_BY_ANY_NAME = PLATFORMS | {p.fmi2_name: p for p in PLATFORMS.values()}
# Not a platform of FMI: the module goes to extra/, next to libraries for other platforms. The only C library
# that zig has for WebAssembly is the one for WASI; the module imports nothing from WASI.
WASM32 = Platform("wasm32", "wasm32-wasi", ".wasm", "wasm32")
PLATFORM_NAMES = (*PLATFORMS, WASM32.name, ALL)
_SYSTEMS = {"linux": "linux", "win32": "windows", "darwin": "darwin"}
_MACHINES = {"x86_64": "x86_64", "amd64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}


def host_platform() -> Platform | None:
    """Return the platform of this Python, or None if it is not in the table."""
    machine = _MACHINES.get(platform.machine().lower())
    return PLATFORMS.get(f"{machine}-{_SYSTEMS.get(sys.platform)}")


def find_platform(name: str) -> Platform:
    """Return the platform with this platform tuple or FMI 2 name; raises `BuildError` for any other name."""
    if name not in _BY_ANY_NAME:
        raise BuildError(f"unknown platform {name!r}; known platforms are {', '.join(PLATFORM_NAMES)}")
    return _BY_ANY_NAME[name]


def select_platforms(names: Sequence[str]) -> tuple[Platform, ...]:
    """Return the named platforms, without duplicates, in the order of the table; by default the host's.

    "all" selects the whole table. "wasm32" is not a platform for libraries, see `wants_module`. Raises
    `BuildError` for an unknown name.
    """
    named = {find_platform(name) for name in names if name not in (ALL, WASM32.name)}
    if ALL in names:
        return tuple(PLATFORMS.values())
    if named:
        return tuple(p for p in PLATFORMS.values() if p in named)
    host = host_platform()
    if host is None:
        raise BuildError(
            f"this machine ({sys.platform}, {platform.machine()}) is not a known platform; "
            f"name the platforms to build for: {', '.join([*PLATFORMS, ALL])}"
        )
    return (host,)


def wants_module(names: Sequence[str]) -> bool:
    """Return whether the WebAssembly module is among the named platforms; "all" does not include it."""
    return WASM32.name in names
