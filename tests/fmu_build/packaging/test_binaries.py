"""The C compiler: what it is given, what it makes, and how its failures read."""

from __future__ import annotations

import importlib.util
import os
import re
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from fmu_build.packaging import binaries
from fmu_build.packaging.binaries import compile_library, toolchain_version
from fmu_build.packaging.platforms import PLATFORMS
from fmu_build.support.errors import ToolchainError

_LINUX = PLATFORMS["x86_64-linux"]
_GOOD = {
    "a.c": b"""
        #include <math.h>
        #include <stdlib.h>
        #include "b.h"
        __attribute__((visibility("default"))) double *a(double x) {
            double *p = malloc(sizeof *p);
            if (p) *p = sin(x) * b(x);
            return p;
        }
    """,
    "b.h": b"double b(double);",
    "b.c": b'#include "b.h"\n#include <stdio.h>\ndouble b(double x) { puts(__FILE__); return x; }',
}


@pytest.fixture(autouse=True)
def own_temporary_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder that the compiler works in, to be found empty afterwards."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def test_library_is_reproducible_and_names_no_path(own_temporary_folder: Path) -> None:
    library, log = compile_library(_GOOD, "Model", _LINUX)
    assert library.startswith(b"\x7fELF")
    assert library == compile_library(_GOOD, "Model", _LINUX)[0]
    assert str(own_temporary_folder).encode() not in library
    assert str(Path.cwd()).encode() not in library
    assert "-target x86_64-linux-gnu.2.17" in log
    assert list(own_temporary_folder.iterdir()) == []


def test_library_needs_libc_and_libm_only() -> None:
    library, _ = compile_library(_GOOD, "Model", _LINUX)
    assert set(re.findall(rb"lib\w+\.so[.\d]*|ld-linux[\w-]*\.so[.\d]*", library)) == {
        b"libm.so.6",
        b"libc.so.6",
    }
    versions = {tuple(map(int, v.split(b"."))) for v in re.findall(rb"GLIBC_([\d.]+)", library)}
    assert versions
    assert max(versions) <= (2, 17)


def test_a_library_path_of_the_user_is_not_read(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "trap.h").write_text("#define TRAP 1\n")
    sources = {"a.c": b'#if __has_include("trap.h")\n#error found\n#endif\nint a;'}
    monkeypatch.setenv("CPATH", str(tmp_path))
    compile_library(sources, "Model", _LINUX)


@pytest.mark.parametrize("home", [None, "/proc/no-home"])
def test_a_cache_folder_of_its_own_where_the_user_has_none(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, home: str | None
) -> None:
    for name in ("ZIG_GLOBAL_CACHE_DIR", "XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    if home is not None:
        monkeypatch.setenv("HOME", home)
    monkeypatch.setattr(os, "access", lambda path, mode: str(path) != "/proc")
    assert binaries._environment(tmp_path)["ZIG_GLOBAL_CACHE_DIR"] == str(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "new"))
    assert "ZIG_GLOBAL_CACHE_DIR" not in binaries._environment(tmp_path)


def test_warnings_are_in_the_log() -> None:
    _, log = compile_library({"a.c": b"static int unused;"}, "Model", _LINUX)
    assert re.search(r"^a\.c:1:12: warning: .*unused", log, re.MULTILINE)


def test_an_error_carries_what_the_compiler_printed(own_temporary_folder: Path) -> None:
    with pytest.raises(
        ToolchainError, match=r"(?s)failed for x86_64-linux with exit code 1.*\na\.c:1:1: error: "
    ) as caught:
        compile_library({"a.c": b"nonsense;"}, "Model", _LINUX)
    assert str(own_temporary_folder) not in str(caught.value)
    assert list(own_temporary_folder.iterdir()) == []


def test_an_undefined_function_is_an_error() -> None:
    source = b'int missing(void); __attribute__((visibility("default"))) int a(void) { return missing(); }'
    with pytest.raises(ToolchainError, match="undefined symbol: missing"):
        compile_library({"a.c": source}, "Model", _LINUX)


def test_ziglang_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    find_spec = importlib.util.find_spec

    def without_ziglang(name: str, package: str | None = None) -> Any:
        return None if name == "ziglang" else find_spec(name, package)

    monkeypatch.setattr(importlib.util, "find_spec", without_ziglang)
    with pytest.raises(ToolchainError, match=r"pip install 'pyjoystick\[build\]'"):
        toolchain_version()
    with pytest.raises(ToolchainError, match=r"pip install 'pyjoystick\[build\]'"):
        compile_library(_GOOD, "Model", _LINUX)


def test_the_compiler_does_not_start(monkeypatch: pytest.MonkeyPatch, own_temporary_folder: Path) -> None:
    monkeypatch.setattr(sys, "executable", str(own_temporary_folder / "no-python"))
    with pytest.raises(ToolchainError, match=r"cannot start the C compiler .*no-python: No such file"):
        compile_library(_GOOD, "Model", _LINUX)
    assert list(own_temporary_folder.iterdir()) == []


def test_success_without_a_library_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    def arguments(files: Sequence[str], library: str, platform: object) -> list[str]:
        return ["version"]

    monkeypatch.setattr(binaries, "_arguments", arguments)
    with pytest.raises(ToolchainError, match="failed for x86_64-linux with exit code 0"):
        compile_library(_GOOD, "Model", _LINUX)
