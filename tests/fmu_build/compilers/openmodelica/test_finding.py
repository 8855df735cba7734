"""The search for omc."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.compilers.openmodelica.finding import find_omc, omc_version, plain_version
from fmu_build.support.errors import ToolchainError


def _program(path: Path, script: str = "exit 0") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return path


@pytest.fixture
def everywhere(tmp_path: Path) -> dict[str, Path]:
    """Executables at all places."""
    return {place: _program(tmp_path / place / "bin" / "omc") for place in ("asked", "home", "path")}


def test_the_order(everywhere: dict[str, Path], tmp_path: Path) -> None:
    environment = {"OPENMODELICAHOME": str(tmp_path / "home"), "PATH": str(tmp_path / "path" / "bin")}
    assert find_omc(everywhere["asked"], environment) == everywhere["asked"]
    assert find_omc(tmp_path / "asked", environment) == everywhere["asked"]
    assert find_omc(None, environment) == everywhere["home"]
    del environment["OPENMODELICAHOME"]
    assert find_omc(None, environment) == everywhere["path"]


def test_a_home_without_omc_leaves_the_path(everywhere: dict[str, Path], tmp_path: Path) -> None:
    environment = {"OPENMODELICAHOME": str(tmp_path), "PATH": str(tmp_path / "path" / "bin")}
    assert find_omc(None, environment) == everywhere["path"]


@pytest.mark.parametrize(
    ("home", "reason"), [(None, "OPENMODELICAHOME is not set"), ("/nowhere", "has no bin/omc (/nowhere)")]
)
def test_nowhere(home: str | None, reason: str, tmp_path: Path) -> None:
    environment = {"PATH": str(tmp_path)} | ({"OPENMODELICAHOME": home} if home else {})
    with pytest.raises(ToolchainError) as caught:
        find_omc(None, environment)
    message = str(caught.value)
    assert reason in message
    assert "no omc on PATH" in message
    assert "openmodelica.org" in message
    assert "default compiler, rumoca, needs none of this" in message


def test_what_is_asked_for_is_not_there(everywhere: dict[str, Path], tmp_path: Path) -> None:
    """It is not replaced by another one."""
    environment = {"PATH": str(tmp_path / "path" / "bin")}
    for wrong in (tmp_path / "omc", tmp_path):
        with pytest.raises(ToolchainError, match=rf"omc={wrong}: neither omc nor a folder with bin/omc"):
            find_omc(wrong, environment)


def test_a_file_that_may_not_be_run(tmp_path: Path) -> None:
    file = _program(tmp_path / "omc")
    file.chmod(0o644)
    with pytest.raises(ToolchainError, match="neither omc nor a folder"):
        find_omc(file, {})


@pytest.mark.parametrize(
    ("text", "version"),
    [
        ("OMCompiler v1.14.2", "1.14.2"),
        ("OpenModelica 1.26.3", "1.26.3"),
        ("OpenModelica 1.25.0~dev-133-ga5470be", "1.25.0~dev-133-ga5470be"),
        ("v1.22.0", "1.22.0"),
        ("unknown", "unknown"),
    ],
)
def test_versions(text: str, version: str) -> None:
    assert plain_version(text) == version


def test_an_omc_that_does_not_run(tmp_path: Path) -> None:
    broken = _program(tmp_path / "omc", "echo libfoo.so: cannot open shared object file >&2; exit 127")
    with pytest.raises(ToolchainError, match=r"exit code 127: libfoo\.so: cannot open"):
        omc_version(broken)
    with pytest.raises(ToolchainError, match="does not run"):
        omc_version(tmp_path / "missing")
