"""What the README prints is run as it is printed."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PROGRAMS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
COMMANDS = re.findall(r"^    ((?:pyjoystick|python -m fmu_build) .*?)(?:\s+#.*)?$", README, re.MULTILINE)
MODULES = {"pyjoystick": ["-m", "pyjoystick"], "python": []}


@pytest.fixture
def checkout(tmp_path: Path, fmus_by_name: Path) -> Path:
    """A folder in which the paths of the README lead to the FMUs and scenarios."""
    (tmp_path / "build").mkdir()
    (tmp_path / "build" / "fmi2").symlink_to(fmus_by_name)
    (tmp_path / "scenarios").symlink_to(ROOT / "scenarios")
    return tmp_path


def test_the_readme_shows_how() -> None:
    assert len(PROGRAMS) == 2
    assert len(COMMANDS) == 5


@pytest.mark.parametrize("program", PROGRAMS)
def test_python(program: str, fmus_by_name: Path) -> None:
    exec(compile(program, "README.md", "exec"), {})


@pytest.mark.parametrize("command", COMMANDS)
def test_command(command: str, checkout: Path) -> None:
    program, *arguments = shlex.split(command)
    if "fmu_build" in arguments:
        arguments[arguments.index("--output") + 1] = str(checkout / "built")
    done = subprocess.run(
        [sys.executable, *MODULES[program], *arguments],
        cwd=checkout,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip()
