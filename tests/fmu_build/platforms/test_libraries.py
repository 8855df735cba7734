"""The binaries for all platforms: their dependencies, exports, and what they reveal."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
import zipfile
from importlib import resources
from pathlib import Path

import pytest

from fmu_build import FmiVersion, build_fmu
from fmu_build.packaging.platforms import PLATFORMS, Platform
from fmu_build.support.cache import Store
from tests.shared_fmus import SharedFmus

from .conftest import MODEL
from .libraries import library_in, read_library
from .mach_o import split_universal

pytestmark = pytest.mark.xdist_group("platforms")

# The C library of each system, and nothing else; on Windows it comes in parts.
_NEEDED = {
    ".so": r"lib[cm]\.so\.6",
    ".dll": r"kernel32\.dll|api-ms-win-crt-(heap|math|private|runtime|stdio|string)-l1-1-0\.dll",
    ".dylib": r"/usr/lib/libSystem\.B\.dylib",
}
_OLDEST_SYSTEM = {".so": (2, 17), ".dll": (6, 0), ".dylib": (11, 0)}  # glibc, Windows, macOS
# zig's linker exports these two of its own in every library for macOS.
_OF_THE_LINKER = {".so": set(), ".dll": set(), ".dylib": {"__dso_handle", "_mh_dylib_header"}}
_SYSTEM_PATHS = {b"/usr/lib/dyld", b"/usr/lib/libSystem.B.dylib"}


@pytest.fixture(params=PLATFORMS.values(), ids=list(PLATFORMS))
def platform(request: pytest.FixtureRequest) -> Platform:
    """Each of the platforms."""
    found: Platform = request.param
    return found


@pytest.fixture
def library(fmu: Path, platform: Platform, fmi_version: FmiVersion) -> bytes:
    """The library for one processor."""
    content = library_in(fmu, platform, fmi_version)
    if fmi_version == "2.0" and platform.name == "x86_64-darwin":
        return split_universal(content)[0]
    return content


def _functions(fmi_version: FmiVersion) -> set[str]:
    """All functions that the version's header declares."""
    number = fmi_version[0]
    header = (resources.files("fmpy") / "c-code" / f"fmi{number}Functions.h").read_text("utf-8")
    return set(re.findall(rf"FMI{number}_Export\s+\w+\s+(fmi{number}\w+)\s*;", header))


def test_names_of_the_folders(fmu: Path, fmi_version: FmiVersion) -> None:
    with zipfile.ZipFile(fmu) as archive:
        binaries = {name for name in archive.namelist() if name.startswith("binaries/")}
    folders = {
        "2.0": ("linux64", "aarch64-linux", "win64", "darwin64", "aarch64-darwin"),
        "3.0": ("x86_64-linux", "aarch64-linux", "x86_64-windows", "x86_64-darwin", "aarch64-darwin"),
    }[fmi_version]
    extensions = ("so", "so", "dll", "dylib", "dylib")
    expected = zip(folders, extensions, strict=True)
    assert binaries == {f"binaries/{folder}/Joystick.{extension}" for folder, extension in expected}


def test_processor_and_oldest_system(library: bytes, platform: Platform) -> None:
    found = read_library(library, platform)
    assert found.processor == platform.name.partition("-")[0]
    assert () < found.oldest_system <= _OLDEST_SYSTEM[platform.extension]


def test_needs_the_c_library_alone(library: bytes, platform: Platform) -> None:
    found = read_library(library, platform)
    assert found.needed
    assert [name for name in found.needed if not re.fullmatch(_NEEDED[platform.extension], name)] == []
    assert found.search_paths == ()


def test_exports_the_functions_of_the_standard(
    library: bytes, platform: Platform, fmi_version: FmiVersion
) -> None:
    found = read_library(library, platform)
    assert found.exports == _functions(fmi_version) | _OF_THE_LINKER[platform.extension]


def test_names_no_path_and_nothing_for_debuggers(library: bytes, platform: Platform) -> None:
    assert read_library(library, platform).debug_information == ()
    paths = set(re.findall(rb"(?:/[\w.+-]{2,}){2,}|[A-Za-z]:\\\w{3,}|\w+\.pdb", library))
    assert paths <= _SYSTEM_PATHS
    for folder in (Path.cwd(), Path.home(), Path(tempfile.gettempdir())):
        assert bytes(folder) + os.sep.encode() not in library
    assert b".zig-cache" not in library


def test_aarch64_macos_has_the_signature_that_it_demands(fmu: Path, fmi_version: FmiVersion) -> None:
    platform = PLATFORMS["aarch64-darwin"]
    library = library_in(fmu, platform, fmi_version)
    assert read_library(library, platform).signed
    changed = bytearray(library)
    changed[5000] ^= 1
    assert not read_library(bytes(changed), platform).signed


def test_universal_library_has_both_processors(fmu: Path, fmi_version: FmiVersion) -> None:
    intel, arm = (PLATFORMS[f"{processor}-darwin"] for processor in ("x86_64", "aarch64"))
    library = library_in(fmu, intel, fmi_version)
    if fmi_version == "3.0":
        assert read_library(library, intel).processor == "x86_64"
        return
    libraries = split_universal(library)
    assert [read_library(each, intel).processor for each in libraries] == ["x86_64", "aarch64"]
    assert libraries[1] == library_in(fmu, arm, fmi_version)


@pytest.mark.parametrize("platforms", [("all",), ()], ids=["all platforms", "this machine's"])
def test_two_builds_in_different_places_give_the_same_bytes(
    platforms: tuple[str, ...],
    shared_fmus: SharedFmus,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    fmi_version: FmiVersion = "2.0" if platforms else "3.0"  # the compilers are the same for both
    fmu = shared_fmus.fmu(MODEL, fmi_version=fmi_version, platforms=platforms, as_shipped=True)
    temporary = tmp_path / "elsewhere with a longer name"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    monkeypatch.setattr(Store, "folder", lambda _: None)  # model and runtime are made anew as well
    monkeypatch.chdir(tmp_path)
    again = build_fmu(MODEL, "out", fmi_version=fmi_version, platforms=platforms).path
    assert hashlib.sha256(again.read_bytes()).digest() == hashlib.sha256(fmu.read_bytes()).digest()


def test_all_platforms_together_stay_below_a_megabyte(fmu: Path) -> None:
    assert fmu.stat().st_size < 1_000_000


@pytest.mark.parametrize(
    ("name", "command", "needed"),
    [
        ("x86_64-linux", ("readelf", "--dynamic"), r"\(NEEDED\).*\[(.*)\]"),
        ("aarch64-linux", ("readelf", "--dynamic"), r"\(NEEDED\).*\[(.*)\]"),
        ("x86_64-windows", ("objdump", "--private-headers"), r"DLL Name: (.*)"),
    ],
)
def test_other_readers_agree(
    fmu: Path, fmi_version: FmiVersion, tmp_path: Path, name: str, command: tuple[str, ...], needed: str
) -> None:
    if shutil.which(command[0]) is None:
        pytest.skip(f"no {command[0]} (binutils)")
    platform = PLATFORMS[name]
    file = tmp_path / f"library{platform.extension}"
    file.write_bytes(library_in(fmu, platform, fmi_version))
    printed = subprocess.run([*command, file], capture_output=True, text=True, check=True).stdout
    found = read_library(file.read_bytes(), platform).needed
    assert {match.lower() for match in re.findall(needed, printed)} == found
