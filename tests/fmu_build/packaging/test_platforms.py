"""Selection of platforms by a request."""

from __future__ import annotations

import platform
import sys

import pytest

from fmu_build.packaging.platforms import PLATFORMS, host_platform, select_platforms, wants_module
from fmu_build.support.errors import BuildError


def test_named_platforms_come_once_and_in_order() -> None:
    chosen = select_platforms(["darwin64", "aarch64-linux", "x86_64-darwin"])
    assert [p.name for p in chosen] == ["aarch64-linux", "x86_64-darwin"]


def test_all_platforms() -> None:
    assert select_platforms(["win64", "all"]) == tuple(PLATFORMS.values())
    with pytest.raises(BuildError, match="unknown platform 'win16'"):
        select_platforms(["all", "win16"])


def test_a_module_is_beside_the_libraries_and_not_among_all() -> None:
    assert select_platforms(["wasm32"]) == select_platforms(())
    assert select_platforms(["wasm32", "win64"]) == (PLATFORMS["x86_64-windows"],)
    assert wants_module(["win64", "wasm32"])
    assert not wants_module(["all"])


def test_folders_in_binaries() -> None:
    assert [p.folder("2.0") for p in PLATFORMS.values()] == [
        "linux64",
        "aarch64-linux",
        "win64",
        "darwin64",
        "aarch64-darwin",
    ]
    assert [p.folder("3.0") for p in PLATFORMS.values()] == list(PLATFORMS)


def test_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(BuildError, match=f"unknown platform 'beos32'.*{', '.join(PLATFORMS)}, wasm32, all"):
        select_platforms(["linux64", "beos32"])


@pytest.mark.parametrize(
    ("system", "machine", "name"),
    [
        ("linux", "x86_64", "x86_64-linux"),
        ("linux", "aarch64", "aarch64-linux"),
        ("win32", "AMD64", "x86_64-windows"),
        ("darwin", "x86_64", "x86_64-darwin"),
        ("darwin", "arm64", "aarch64-darwin"),
    ],
)
def test_default_is_the_host(monkeypatch: pytest.MonkeyPatch, system: str, machine: str, name: str) -> None:
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    assert select_platforms(()) == (PLATFORMS[name],)


def test_a_host_that_is_not_in_the_table(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert host_platform() is None
    with pytest.raises(BuildError, match=r"this machine \(.*riscv64\) is not a known platform; name"):
        select_platforms(())
