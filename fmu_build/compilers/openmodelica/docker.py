"""Run omc in a Docker container that shares folders with the host."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Sequence
from pathlib import Path

from fmu_build.support.errors import ToolchainError

_SECONDS_TO_INSPECT = 60


def check_image(image: str) -> None:
    """Raise `ToolchainError` if Docker is not running or does not have the image.

    OMPython would wait for minutes in either case.
    """
    command = ["docker", "image", "inspect", "--format", "{{.Id}}", image]
    try:
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=_SECONDS_TO_INSPECT,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ToolchainError(f"docker={image}: Docker does not run: {error}") from error
    if done.returncode != 0:
        raise ToolchainError(
            f"docker={image}: {done.stderr.strip()} (docker pull {image} fetches an image; "
            "openmodelica/openmodelica:v1.26.3-minimal is one)"
        )


def mounts(folder: Path, libraries: Sequence[Path]) -> list[str]:
    """Return ``docker run`` arguments that mount `folder`, and `libraries` read-only, at the same paths."""
    shared = {str(path if path.is_dir() else path.parent): ":ro" for path in libraries}
    shared[str(folder)] = ""
    return [word for path, mode in shared.items() for word in ("--volume", f"{path}:{path}{mode}")]


def run_in_container(image: str, folder: Path, libraries: Sequence[Path]) -> list[str]:
    """Return the command that runs omc once in a container, as the current user and in `folder`."""
    user = ["--user", str(os.getuid())] if os.name == "posix" else []
    return [
        *("docker", "run", "--rm", *user, "--workdir", str(folder)),
        *mounts(folder, libraries),
        *(image, "omc"),
    ]
