"""Run programs for other platforms: Windows through Wine, aarch64 through QEMU."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from fmu_build.packaging.platforms import Platform, host_platform

# Debian's libc6-arm64-cross puts the C library of aarch64 there.
_AARCH64_SYSTEM = Path("/usr/aarch64-linux-gnu")
# Debian's wine64 leaves its program out of the search path.
_DEBIANS_WINE = "/usr/lib/wine/wine64"


@dataclass(frozen=True, slots=True)
class Runner:
    """What is put before the command line of a program, and its environment beside this process's."""

    prefix: tuple[str, ...] = ()
    environment: Mapping[str, str] = field(default_factory=dict)

    def run(self, program: Path, arguments: list[str], text: str) -> str:
        """What the program prints for `text` as its standard input; it works in its own folder."""
        done = subprocess.run(
            [*self.prefix, f"./{program.name}", *arguments],
            cwd=program.parent,
            env=os.environ | self.environment,
            input=text,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout


def runner_for(platform: Platform, folder: Path) -> Runner | str:
    """What runs programs for the platform, with its files in `folder`; or why nothing does."""
    if platform == host_platform():
        return Runner()
    if platform.name == "aarch64-linux":
        return _qemu()
    if platform.name == "x86_64-windows":
        return _wine(folder)
    return f"nothing here runs programs for {platform.name}"


def _qemu() -> Runner | str:
    program = shutil.which("qemu-aarch64-static") or shutil.which("qemu-aarch64")
    if program is None:
        return "no QEMU for programs of aarch64 (Debian: qemu-user-static)"
    if not (_AARCH64_SYSTEM / "lib" / "libc.so.6").is_file():
        return "no C library for aarch64 (Debian: libc6-arm64-cross)"
    return Runner((program, "-L", str(_AARCH64_SYSTEM)))


def _wine(folder: Path) -> Runner | str:
    program = shutil.which("wine64") or shutil.which(_DEBIANS_WINE) or shutil.which("wine")
    if program is None:
        return "no Wine (Debian: wine64)"
    # Neither its messages nor its questions whether to install .NET and a browser.
    quiet = {"WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}
    return Runner((program,), {"WINEPREFIX": str(folder / "wine"), **quiet})
