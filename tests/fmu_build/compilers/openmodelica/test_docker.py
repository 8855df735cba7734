"""omc in a Docker image: the commands, and the errors if Docker or the image is missing."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from fmu_build import build_fmu
from fmu_build.compilers.openmodelica.docker import check_image, mounts, run_in_container
from fmu_build.support.errors import ToolchainError


def test_the_same_paths_inside(tmp_path: Path) -> None:
    library = tmp_path / "Lib"
    library.mkdir()
    (library / "package.mo").touch()
    single = tmp_path / "own" / "M.mo"
    assert mounts(tmp_path / "work", [library / "package.mo", single]) == [
        *("--volume", f"{library}:{library}:ro"),
        *("--volume", f"{single.parent}:{single.parent}:ro"),
        *("--volume", f"{tmp_path}/work:{tmp_path}/work"),
    ]


def test_the_command_of_the_script_form(tmp_path: Path) -> None:
    assert run_in_container("image:1", tmp_path, []) == [
        *("docker", "run", "--rm", "--user", str(os.getuid()), "--workdir", str(tmp_path)),
        *("--volume", f"{tmp_path}:{tmp_path}", "image:1", "omc"),
    ]


def test_no_docker(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ToolchainError, match=r"docker=image: Docker does not run: .*docker"):
        check_image("image")


def test_no_image(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    docker = tmp_path / "docker"
    docker.write_text("#!/bin/sh\necho 'Error: No such image: om:9' >&2\nexit 1\n")
    docker.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    with pytest.raises(ToolchainError, match=r"No such image: om:9 \(docker pull om:9 fetches"):
        build_fmu(
            "PreloadedSprings.Joystick.Joystick",
            tmp_path / "out",
            compiler="openmodelica",
            options={"docker": "om:9"},
        )
    assert not (tmp_path / "out").exists()
