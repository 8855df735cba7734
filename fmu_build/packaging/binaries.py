"""Compile the shared libraries of an FMU with zig, the C compiler in the package ziglang.

The runtime is the same for every model. It is compiled once per platform into a static library in zig's cache
folder; a build then compiles only the model and links both. WebAssembly modules for FMUs without one are
cached whole.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import shlex
import struct
import subprocess
import sys
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path

from fmu_build.packaging.platforms import PLATFORMS, WASM32, Platform
from fmu_build.packaging.sources import MODEL_FILE, TOKEN_FILE, c_files
from fmu_build.support.cache import Store, cache_folder
from fmu_build.support.errors import ToolchainError
from fmu_build.support.request import FmiVersion
from fmu_build.support.temporary import temporary_folder

# No contraction to fused multiply-add and no -ffast-math: every platform must compute the same floating-point
# results. -s and relative paths keep this machine's names out of the library.
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
# Link-time optimization pays: the model's functions are short, and the runtime calls them thousands of times
# a run. zig supports it for Linux and WebAssembly only.
OPTIMIZED_WHEN_LINKED = (".so", ".wasm")
# Search paths for the user's other compilers, which clang would honour.
_FOREIGN_PATHS = ("CPATH", "C_INCLUDE_PATH", "LIBRARY_PATH", "SDKROOT")
_RUNTIME = "runtime.a"
# Enough for the runtimes of two versions, for all platforms and both FMI versions, of up to 1 MB each, and
# some modules of 0.1 MB.
STORE = Store("runtimes", most=64)
# Callers of the module need malloc and free to pass arrays. The deepest call, which formats a message, needs
# a few kB of stack.
_MODULE_LINKER_FLAGS = ("-Wl,--export=malloc", "-Wl,--export=free", "-Wl,-z,stack-size=65536")


def toolchain_version() -> str:
    """Return name and version of the C compiler; raises `ToolchainError` if it is not installed."""
    if importlib.util.find_spec("ziglang") is None:
        raise ToolchainError("the C compiler is missing: pip install 'pyjoystick[build]' (ziglang)")
    return f"ziglang {metadata.version('ziglang')}"


def compile_library(
    sources: Mapping[str, bytes], identifier: str, platform: Platform, *, keep: bool = False
) -> tuple[bytes, str]:
    """Return the library for one platform, and the compiler's commands and output.

    All files except model.c and token.h count as the runtime, which is cached; with `keep`, so is the
    library. Raises `ToolchainError` with the compiler's output if it fails.
    """
    toolchain_version()
    runtime = {name: content for name, content in sources.items() if name not in (MODEL_FILE, TOKEN_FILE)}
    log, files = "", dict(sources)
    if c_files(runtime):
        archive, log = _made_once(runtime, _archive_arguments(c_files(runtime), platform), _RUNTIME, platform)
        files = {name: content for name, content in sources.items() if name not in c_files(runtime)}
        files[_RUNTIME] = archive
    library = identifier + platform.extension
    make = _made_once if keep else _compiled
    content, printed = make(files, _library_arguments(files, library, platform), library, platform)
    return content, log + printed


def binary_entries(
    libraries: Mapping[Platform, bytes], identifier: str, fmi_version: FmiVersion
) -> dict[str, bytes]:
    """Return archive name -> content of binaries/.

    FMI 2 importers on macOS look in darwin64, whatever the processor: with libraries for both, it contains a
    universal one.
    """
    content = dict(libraries)
    macos = [platform for platform in libraries if platform.extension == ".dylib"]
    if fmi_version == "2.0" and len(macos) > 1:
        content[PLATFORMS["x86_64-darwin"]] = universal_library([libraries[p] for p in macos])
    return {
        f"binaries/{platform.folder(fmi_version)}/{identifier}{platform.extension}": library
        for platform, library in content.items()
    }


def _made_once(
    files: Mapping[str, bytes], arguments: list[str], result: str, platform: Platform
) -> tuple[bytes, str]:
    """Return the result of `_compiled`, from the cache, without output, if the inputs are the same."""
    digest = hashlib.sha256(repr([toolchain_version(), arguments, sorted(files.items())]).encode())
    key = f"{digest.hexdigest()}{Path(result).suffix}"
    if (content := STORE.read(key)) is not None:
        return content, ""
    content, log = _compiled(files, arguments, result, platform)
    STORE.write(key, content)
    return content, log


def _compiled(
    files: Mapping[str, bytes], arguments: list[str], result: str, platform: Platform
) -> tuple[bytes, str]:
    """Run zig on these files in an empty folder; return the resulting file, the command and its output."""
    with temporary_folder() as work:
        for name, content in files.items():
            (work / name).write_bytes(content)
        command = [sys.executable, "-m", "ziglang", *arguments]
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
        output = (done.stdout + done.stderr).replace(f"{work}{os.sep}", "")
        log = f"$ {shlex.join(command[1:])}\n{output}"
        if done.returncode != 0 or not (work / result).is_file():
            raise ToolchainError(
                f"the C compiler failed for {platform.name} with exit code {done.returncode}\n{log}".rstrip()
            )
        return (work / result).read_bytes(), log


def _environment(local: Path) -> dict[str, str]:
    """Return this process's environment, with zig's cache for this build in the folder `local`.

    zig keeps the C library, which it builds once, in the user's cache folder. If that is not writable, it
    builds the C library in `local` each time.
    """
    environment = {name: value for name, value in os.environ.items() if name not in _FOREIGN_PATHS}
    environment["ZIG_LOCAL_CACHE_DIR"] = str(local)
    environment["ZIG_GLOBAL_CACHE_DIR"] = str(cache_folder() or local)
    return environment


def _archive_arguments(files: list[str], platform: Platform) -> list[str]:
    # zig cc cannot build a static library. These settings correspond to COMPILER_FLAGS and LINKER_FLAGS.
    shared = [] if platform == WASM32 else ["-fPIC"]
    settings = ["-OReleaseFast", "-fstrip", *shared, *_link_time_optimization(platform)]
    # Unrolled loops would make a module 3 kB larger and no faster.
    flags = [*COMPILER_FLAGS, *(["-fno-unroll-loops"] if platform == WASM32 else [])]
    made = ["-static", "-lc", "--name", "runtime", f"-femit-bin={_RUNTIME}"]
    return ["build-lib", *_target(platform), *settings, *made, "-cflags", *flags, "--", *files]


def _library_arguments(files: Mapping[str, bytes], library: str, platform: Platform) -> list[str]:
    whole = ["-Wl,--whole-archive", _RUNTIME, "-Wl,--no-whole-archive"] if _RUNTIME in files else []
    own = {
        # A missing function becomes an error now instead of on its first call by an importer.
        ".so": ["-Wl,-z,defs"],
        ".dll": [],
        # Without an install name, a macOS library would contain the path at which it was linked.
        ".dylib": [f"-Wl,-install_name,@rpath/{library}"],
        ".wasm": ["-fno-unroll-loops", "-Wl,--export-dynamic", *_MODULE_LINKER_FLAGS],
    }[platform.extension]
    own = [*_link_time_optimization(platform), *own]
    linked = ["-mexec-model=reactor", "-s"] if platform == WASM32 else LINKER_FLAGS
    sources = [*c_files(files), *whole]
    return ["cc", *_target(platform), *COMPILER_FLAGS, *linked, "-o", library, *sources, *own, "-lm"]


def _link_time_optimization(platform: Platform) -> list[str]:
    return ["-flto"] if platform.extension in OPTIMIZED_WHEN_LINKED else []


def _target(platform: Platform) -> list[str]:
    return ["-target", platform.target, "-mcpu=baseline"]


_MAGIC = 0xCAFEBABE
_HEADER = struct.Struct(">II")  # magic number, number of libraries
_ENTRY = struct.Struct(">IIIII")  # processor, its subtype, offset, size, alignment as a power of two
_ALIGNMENT = 14  # pages of 16 kB, those of aarch64


def universal_library(libraries: Sequence[bytes]) -> bytes:
    """Return one file with all libraries, one per processor; macOS loads the one that fits the process."""
    page = 1 << _ALIGNMENT
    content = bytearray(_HEADER.pack(_MAGIC, len(libraries)))
    offset = page
    for library in libraries:
        processor, subtype = struct.unpack_from("<II", library, 4)
        content += _ENTRY.pack(processor, subtype, offset, len(library), _ALIGNMENT)
        offset += -(-len(library) // page) * page
    for library in libraries:
        content += bytes(-len(content) % page) + library
    return bytes(content)
