"""The C compiler: its arguments, its output, and the messages of its failures."""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

import pytest

from fmu_build.packaging import binaries
from fmu_build.packaging.binaries import compile_library, toolchain_version
from fmu_build.packaging.platforms import PLATFORMS
from fmu_build.support.cache import PLACES, Store
from fmu_build.support.errors import ToolchainError

_LINUX = PLATFORMS["x86_64-linux"]
_GOOD = {
    "model.c": b"""
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


@pytest.fixture
def stored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache of compiled runtimes; zig's own cache, with the C library, stays the user's."""
    monkeypatch.setattr(Store, "folder", lambda store: tmp_path / store.name)
    return tmp_path / binaries.STORE.name


@pytest.mark.parametrize("name", PLATFORMS)
def test_a_stored_runtime_gives_the_same_library(name: str, stored: Path) -> None:
    library, log = compile_library(_GOOD, "Model", PLATFORMS[name])
    (archive,) = stored.iterdir()
    again, short_log = compile_library(_GOOD, "Model", PLATFORMS[name])
    assert again == library
    assert "build-lib" in log
    assert "build-lib" not in short_log
    archive.unlink()
    assert compile_library(_GOOD, "Model", PLATFORMS[name])[0] == library
    assert list(stored.iterdir()) == [archive]


def test_a_damaged_runtime_is_compiled_anew(stored: Path) -> None:
    library, _ = compile_library(_GOOD, "Model", _LINUX)
    (archive,) = stored.iterdir()
    content = archive.read_bytes()
    for damaged in (b"", content[:-1], content[:200] + b"?" + content[201:]):
        archive.write_bytes(damaged)
        again, log = compile_library(_GOOD, "Model", _LINUX)
        assert again == library
        assert "build-lib" in log
        assert "build-lib" not in compile_library(_GOOD, "Model", _LINUX)[1]


def test_another_runtime_or_platform_is_stored_beside_it(stored: Path) -> None:
    compile_library(_GOOD, "Model", _LINUX)
    compile_library(_GOOD | {"model.c": _GOOD["model.c"] + b"\n", "token.h": b""}, "Other", _LINUX)
    assert len(list(stored.iterdir())) == 1
    compile_library(_GOOD | {"b.h": _GOOD["b.h"] + b"\n"}, "Model", _LINUX)
    assert len(list(stored.iterdir())) == 2
    compile_library(_GOOD, "Model", PLATFORMS["aarch64-linux"])
    assert len(list(stored.iterdir())) == 3


def test_what_is_kept_is_made_once_of_the_same(stored: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    library, log = compile_library(_GOOD, "Model", _LINUX, keep=True)
    assert "$ -m ziglang cc" in log
    assert compile_library(_GOOD, "Model", _LINUX, keep=True) == (library, "")
    assert "$ -m ziglang cc" in compile_library(_GOOD, "Model", _LINUX)[1]  # this one is not to be kept
    for sources, identifier in (
        (_GOOD | {"model.c": _GOOD["model.c"] + b"\n"}, "Model"),
        (_GOOD | {"token.h": b""}, "Model"),
        (_GOOD | {"b.c": _GOOD["b.c"] + b"\n"}, "Model"),
        (_GOOD, "Other"),
    ):
        assert "$ -m ziglang cc" in compile_library(sources, identifier, _LINUX, keep=True)[1]
    monkeypatch.setattr(binaries, "COMPILER_FLAGS", (*binaries.COMPILER_FLAGS, "-DMORE"))
    assert "$ -m ziglang cc" in compile_library(_GOOD, "Model", _LINUX, keep=True)[1]


def test_of_many_runtimes_those_that_were_used_last_are_kept(
    stored: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(binaries, "STORE", Store(binaries.STORE.name, most=3))
    stored.mkdir()
    for number, name in enumerate(("left.a-123-ab", "unused.a", "other.a")):
        (stored / name).write_bytes(b"")
        os.utime(stored / name, (number, number))
    compile_library(_GOOD, "Model", _LINUX)
    (archive,) = {*stored.iterdir()} - {stored / "unused.a", stored / "other.a"}
    os.utime(archive, (0, 0))
    compile_library(_GOOD, "Model", _LINUX)  # uses it
    compile_library(_GOOD | {"b.h": _GOOD["b.h"] + b"\n"}, "Model", _LINUX)
    compile_library(_GOOD, "Model", PLATFORMS["aarch64-linux"])
    kept = {*stored.iterdir()}
    assert len(kept) == 3
    assert archive in kept


def test_a_cache_that_cannot_be_written_is_no_failure(stored: Path) -> None:
    stored.write_bytes(b"no folder")
    library, _ = compile_library(_GOOD, "Model", _LINUX)
    assert library.startswith(b"\x7fELF")
    assert stored.read_bytes() == b"no folder"


def test_library_is_reproducible_and_names_no_path(own_temporary_folder: Path, stored: Path) -> None:
    library, log = compile_library(_GOOD, "Model", _LINUX)
    # In another folder, of a longer name, and with nothing from the cache.
    shutil.rmtree(stored)
    elsewhere = own_temporary_folder.with_name("elsewhere under a longer name")
    elsewhere.mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tempfile, "tempdir", str(elsewhere))
        again, log_again = compile_library(_GOOD, "Model", _LINUX)
    assert again == library
    assert "build-lib" in log_again
    assert library.startswith(b"\x7fELF")
    assert str(own_temporary_folder).encode() not in library
    assert str(Path.cwd()).encode() not in library
    assert "-target x86_64-linux-gnu.2.17" in log
    assert list(own_temporary_folder.iterdir()) == []


@pytest.mark.usefixtures("stored")
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
    sources = {"model.c": b'#if __has_include("trap.h")\n#error found\n#endif\nint a;'}
    monkeypatch.setenv("CPATH", str(tmp_path))
    compile_library(sources, "Model", _LINUX)


@pytest.mark.parametrize("home", [None, "/proc/no-home"])
def test_a_cache_folder_of_its_own_where_the_user_has_none(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, home: str | None
) -> None:
    for name in PLACES:
        monkeypatch.delenv(name, raising=False)
    if home is not None:
        monkeypatch.setenv("HOME", home)
    monkeypatch.setattr(os, "access", lambda path, mode: str(path) != "/proc")
    assert binaries._environment(tmp_path)["ZIG_GLOBAL_CACHE_DIR"] == str(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "new"))
    assert binaries._environment(tmp_path)["ZIG_GLOBAL_CACHE_DIR"] == str(tmp_path / "new" / "zig")


def test_warnings_are_in_the_log() -> None:
    _, log = compile_library({"model.c": b"static int unused;"}, "Model", _LINUX)
    assert re.search(r"^model\.c:1:12: warning: .*unused", log, re.MULTILINE)


def test_an_error_carries_what_the_compiler_printed(own_temporary_folder: Path) -> None:
    with pytest.raises(
        ToolchainError, match=r"(?s)failed for x86_64-linux with exit code 1.*\nmodel\.c:1:1: error: "
    ) as caught:
        compile_library({"model.c": b"nonsense;"}, "Model", _LINUX)
    assert str(own_temporary_folder) not in str(caught.value)
    assert list(own_temporary_folder.iterdir()) == []


def test_an_undefined_function_is_an_error() -> None:
    source = b'int missing(void); __attribute__((visibility("default"))) int a(void) { return missing(); }'
    with pytest.raises(ToolchainError, match="undefined symbol: missing"):
        compile_library({"model.c": source}, "Model", _LINUX)


def test_ziglang_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    find_spec = importlib.util.find_spec

    def without_ziglang(name: str, package: str | None = None) -> Any:
        return None if name == "ziglang" else find_spec(name, package)

    monkeypatch.setattr(importlib.util, "find_spec", without_ziglang)
    with pytest.raises(ToolchainError, match=r"pip install 'pyjoystick\[build\]'"):
        toolchain_version()
    with pytest.raises(ToolchainError, match=r"pip install 'pyjoystick\[build\]'"):
        compile_library(_GOOD, "Model", _LINUX)


@pytest.mark.usefixtures("stored")
def test_the_compiler_does_not_start(monkeypatch: pytest.MonkeyPatch, own_temporary_folder: Path) -> None:
    monkeypatch.setattr(sys, "executable", str(own_temporary_folder / "no-python"))
    with pytest.raises(ToolchainError, match=r"cannot start the C compiler .*no-python: No such file"):
        compile_library(_GOOD, "Model", _LINUX)
    assert list(own_temporary_folder.iterdir()) == []


def test_success_without_a_library_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    def arguments(files: object, library: str, platform: object) -> list[str]:
        return ["version"]

    monkeypatch.setattr(binaries, "_library_arguments", arguments)
    with pytest.raises(ToolchainError, match="failed for x86_64-linux with exit code 0"):
        compile_library(_GOOD, "Model", _LINUX)
