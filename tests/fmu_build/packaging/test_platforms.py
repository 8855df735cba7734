"""Which platforms a request means."""

from __future__ import annotations

import platform
import sys

import pytest

from fmu_build.errors import BuildError
from fmu_build.packaging.platforms import PLATFORMS, host_platform, select_platforms


def test_named_platforms_come_once_and_in_order() -> None:
    chosen = select_platforms(["darwin64", "linux64", "darwin64"])
    assert [p.name for p in chosen] == ["linux64", "darwin64"]


def test_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(BuildError, match=f"unknown platform 'beos32'.*{', '.join(PLATFORMS)}"):
        select_platforms(["linux64", "beos32"])


@pytest.mark.parametrize(
    ("system", "machine", "name"),
    [("linux", "x86_64", "linux64"), ("win32", "AMD64", "win64"), ("darwin", "x86_64", "darwin64")],
)
def test_default_is_the_host(monkeypatch: pytest.MonkeyPatch, system: str, machine: str, name: str) -> None:
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    assert select_platforms(()) == (PLATFORMS[name],)


def test_a_host_that_fmi_2_has_no_name_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert host_platform() is None
    with pytest.raises(BuildError, match=r"no platform name for this machine.*riscv64"):
        select_platforms(())
