"""The shared libraries of an FMU, compiled with the C compiler that `pip install ziglang` brings."""

from __future__ import annotations

import importlib.util
import os
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from importlib import metadata
from pathlib import Path

from fmu_build.packaging.platforms import PLATFORMS, Platform
from fmu_build.packaging.sources import c_files
from fmu_build.packaging.universal import universal_library
from fmu_build.support.errors import ToolchainError
from fmu_build.support.request import FmiVersion

# Floating point: no contraction to fused multiply-add and nothing of -ffast-math, so that every platform
# computes alike. -s and the relative paths keep this machine's names out of the library.
COMPILER_FLAGS = (
    "-std=c11",
    "-O2",
    "-fno-math-errno",
    "-ffp-contract=off",
    "-fomit-frame-pointer",
    "-fvisibility=hidden",
    "-DNDEBUG",
    "-Wall",
    "-Wextra",
)
LINKER_FLAGS = ("-shared", "-fPIC", "-s")
# Search paths of the user's own compilers, which clang would read too.
_FOREIGN_PATHS = ("CPATH", "C_INCLUDE_PATH", "LIBRARY_PATH", "SDKROOT")
# Where zig looks for its cache, in this order.
_CACHE_PLACES = ("ZIG_GLOBAL_CACHE_DIR", "XDG_CACHE_HOME", "HOME", "LOCALAPPDATA")


def toolchain_version() -> str:
    """Name and version of the C compiler; raises `ToolchainError` where it is not installed."""
    if importlib.util.find_spec("ziglang") is None:
        raise ToolchainError("the C compiler is missing: pip install 'pyjoystick[build]' (ziglang)")
    return f"ziglang {metadata.version('ziglang')}"


def compile_library(sources: Mapping[str, bytes], identifier: str, platform: Platform) -> tuple[bytes, str]:
    """The library for one platform, and the compiler's command and output.

    Raises `ToolchainError` with the compiler's output where it fails.
    """
    toolchain_version()
    library = identifier + platform.extension
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as folder:
        work = Path(folder)
        for name, content in sources.items():
            (work / name).write_bytes(content)
        command = [sys.executable, "-m", "ziglang", *_arguments(c_files(sources), library, platform)]
        environment = _environment(work / ".zig-cache")
        try:
            done = subprocess.run(
                command,
                cwd=work,
                env=environment,
                capture_output=True,
                text=True,
                errors="replace",
                check=False,
            )
        except OSError as error:
            raise ToolchainError(f"cannot start the C compiler {command[0]}: {error.strerror}") from error
        output = (done.stdout + done.stderr).replace(folder + os.sep, "")
        log = f"$ {shlex.join(command[1:])}\n{output}"
        if done.returncode != 0 or not (work / library).is_file():
            raise ToolchainError(
                f"the C compiler failed for {platform.name} with exit code {done.returncode}\n{log}".rstrip()
            )
        return (work / library).read_bytes(), log


def binary_entries(
    libraries: Mapping[Platform, bytes], identifier: str, fmi_version: FmiVersion
) -> dict[str, bytes]:
    """Archive name -> content of binaries/.

    Importers of FMI 2 on macOS look into darwin64, whatever the processor: where there are libraries for
    both, it holds the universal one.
    """
    content = dict(libraries)
    macos = [platform for platform in libraries if platform.extension == ".dylib"]
    if fmi_version == "2.0" and len(macos) > 1:
        content[PLATFORMS["x86_64-darwin"]] = universal_library([libraries[p] for p in macos])
    return {
        f"binaries/{platform.folder(fmi_version)}/{identifier}{platform.extension}": library
        for platform, library in content.items()
    }


def _environment(cache: Path) -> dict[str, str]:
    """This process's, with zig's cache of the build in `cache`.

    zig keeps the C library that it builds once in the user's cache folder. Where there is none that can be
    written, as in many containers, it builds it anew in `cache`.
    """
    environment = {name: value for name, value in os.environ.items() if name not in _FOREIGN_PATHS}
    environment["ZIG_LOCAL_CACHE_DIR"] = str(cache)
    user = next((environment[name] for name in _CACHE_PLACES if environment.get(name)), None)
    if user is None or not os.access(
        next(p for p in (Path(user), *Path(user).parents) if p.exists()), os.W_OK
    ):
        environment["ZIG_GLOBAL_CACHE_DIR"] = str(cache)
    return environment


def _arguments(files: list[str], library: str, platform: Platform) -> list[str]:
    target = ["-target", platform.target, "-mcpu=baseline"]
    own = {
        # A function that is missing is an error here, not when an importer first calls it. Optimizing across
        # files pays: the model's functions are short, and the runtime calls them thousands of times a run.
        # zig links that for Linux alone.
        ".so": ["-Wl,-z,defs", "-flto"],
        ".dll": [],
        # Without its own install name, a macOS library would carry the path that it was linked at.
        ".dylib": [f"-Wl,-install_name,@rpath/{library}"],
    }[platform.extension]
    return ["cc", *target, *COMPILER_FLAGS, *LINKER_FLAGS, "-o", library, *files, *own, "-lm"]
