"""The licences of the parts of an FMU."""

from __future__ import annotations

import pytest

from fmu_build.packaging.licenses_text import license_text
from fmu_build.packaging.platforms import PLATFORMS, WASM32
from fmu_build.support.request import FmiVersion

_LINUX, _WINDOWS = PLATFORMS["x86_64-linux"], PLATFORMS["x86_64-windows"]


@pytest.mark.parametrize("fmi_version", ["2.0", "3.0"])
def test_all_licences_are_given_in_full(fmi_version: FmiVersion) -> None:
    text = license_text(fmi_version, [_LINUX])
    assert f"fmi{fmi_version[0]}Functions.h" in text
    assert "Apache License" in text
    assert "END OF TERMS AND CONDITIONS" in text
    assert "Modelica Association Project" in text
    assert "Redistributions in binary form must reproduce" in text
    assert "ADVISED OF THE POSSIBILITY OF SUCH DAMAGE" in text
    assert "Zig contributors" in text


def test_what_is_in_windows_libraries_alone() -> None:
    assert "by the mingw-w64 project" in license_text("2.0", [_LINUX, _WINDOWS])
    assert "mingw" not in license_text("2.0", [_LINUX])


def test_what_is_in_webassembly_modules_alone() -> None:
    text = license_text("2.0", [_LINUX, WASM32])
    assert "wasi-libc" in text
    assert "musl as a whole is licensed under" in text
    assert "musl" not in license_text("2.0", [_LINUX])
